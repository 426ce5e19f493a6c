// The panel of a single cell: the engine solves it, and its motion is shown.

const MOST_STARTS = 60;

// A row of the panel's list.
function numbered(name, value) {
  const [term, detail] = [document.createElement("dt"), document.createElement("dd")];
  [term.textContent, detail.textContent] = [name, value];
  return [term, detail];
}

class CellPanel {
  constructor(element, workers) {
    this.element = element;
    this.workers = workers;
    this.charts = new Charts(element);
    this.stage = new Stage(element("stage"), (now) => this.charts.point(now));
    this.starts = [];
    this.view = "steady";
    this.#listen();
  }
  // cell: all numbers; inFile: the file's contents there; stored: the same, null for a different rig, place or start. Until it is
  // solved, the panel tells what the file has.
  show(cell, inFile, stored) {
    this.inFile = inFile;
    this.data = null; // the newest answer for this cell
    this.home = null; // the one to which kicks are applied
    this.starts = [];
    this.#basinOff();
    this.#showKnock(0);
    this.#setView("steady");
    this.element("numbers").replaceChildren();
    this.#say("", null);
    if (stored) this.#tellFile("");
    else this.#headline(null);
    this.#solve(cell, stored);
  }
  // The same cell from another start at forcing phase 0.
  startFrom(u, v, words) {
    this.#setView("way");
    this.#solve(startingAt(this.cell, u, v), null, { u, v, words });
  }
  #solve(cell, stored, start = null) {
    Object.assign(this, { cell, stored, start });
    const refusal = whyNot(cell);
    if (refusal) return this.#cannot(refusal, this.inFile);
    this.element("cell").classList.remove("cannot");
    this.element("spent").textContent = "";
    this.element("cell").dataset.state = "solving";
    this.workers.lookAt(cell, (data) => (data.answer ? this.#take(data) : this.#wait(data.spent)), start !== null);
  }
  #wait(spent) {
    this.element("spent").textContent = `solving: ${spent.toLocaleString("en")} cycles so far`;
  }
  // Shows the file's contents, and the reason why there is no motion.
  showFile(inFile, refusal) {
    this.workers.giveUp();
    Object.assign(this, { inFile, data: null, home: null });
    this.#basinOff();
    this.element("cell").dataset.state = "empty";
    this.#cannot(refusal, inFile);
  }
  // Tells why there is no motion, and what the file has, if this is its cell.
  #cannot(refusal, inFile) {
    this.element("cell").classList.add("cannot");
    if (inFile) return this.#tellFile(refusal);
    this.#headline(null);
    this.element("proof").textContent = refusal;
  }
  #tellFile(refusal) {
    const { regime, impacts, period, peak_force_ratio: force } = this.inFile;
    this.#headline({ regime, impacts, period, peak_force_ratio: force, weight_n: content.newtons });
    this.element("proof").textContent = refusal;
    this.#tellOutcomes(this.inFile);
  }
  #take(data) {
    const { answer } = data;
    this.element("cell").dataset.state = "solved";
    this.element("cell").dataset.milliseconds = data.milliseconds.toFixed(1);
    this.element("spent").textContent = "";
    if (answer.regime === NOT_COMPUTED) {
      if (this.data) { // of a start: the motion shown stays
        this.#setView(this.shownView);
        return this.#say(`${this.start.words}: ${BEYOND}`, null);
      }
      return this.#cannot(BEYOND, this.stored);
    }
    this.data = data;
    if (!this.start) this.home = data;
    this.#headline(answer);
    this.element("proof").textContent = proof(answer, data.multipliers);
    if (this.stored) this.#tellOutcomes(this.stored);
    this.#compare(answer);
    this.#numbers(answer);
    if (this.stored) this.#tellProof(this.stored);
    if (this.start) this.#keepStart(answer);
    this.#showMotion();
    if (this.element("basin").checked && !this.charts.basin) this.#basinOn();
  }
  // The motion shown is that of the job's own rig; the drawn ones may end in others.
  #tellOutcomes({ row, column }) {
    const outcomes = outcomeWords(row, column);
    if (outcomes) this.element("proof").append(` That is the job’s own rig. Of those drawn around it: ${outcomes}.`);
  }
  // null: nothing is known.
  #headline(told) {
    if (told === null) {
      for (const name of ["z", "newtons", "meaning", "proof"]) this.element(name).textContent = "";
      this.element("swatch").style.background = "";
      return;
    }
    const { regime, impacts, period, peak_force_ratio: force, weight_n: weight, chatter } = told;
    const kind = classOf(regime, impacts, period);
    this.element("swatch").style.background = content.classes[kind].colour;
    this.element("z").textContent = labelWords(regime, impacts, period);
    this.element("newtons").textContent = force > 0 ? number(force * weight, "N") : "";
    this.element("meaning").textContent = meaning({ regime, impacts, period }) + (chatter ? "; chatters to rest on the stop" : "");
  }
  #compare(answer) {
    if (this.start) return this.#say(`${this.start.words}: ${endWords(answer, this.home.answer)}`, null);
    const { same, words } = this.stored ? agreement(answer, this.stored) : { same: null, words: "" };
    this.#say(words, same);
  }
  #say(words, same) {
    const badge = this.element("agreement");
    badge.textContent = words;
    badge.dataset.same = String(same);
  }
  #numbers(answer) {
    const force = answer.peak_force_ratio;
    const rows = [
      ["peak force", force > 0 ? inOrder(number(force * answer.weight_n, "N"), number(force, "m g")).join(" = ") : number(force, "m g")],
      ["impact speed", number(1000 * answer.impact_speed, "mm/s")],
      ["impulse", amount(answer.impulse, "N s")],
      ["time pressed", timeWords(answer.contact_time)],
      ["power into the stop", amount(answer.contact_power_w, "W")],
      ["largest |u|", number(1000 * answer.max_displacement, "mm")],
      ["impacts per cycle", number(answer.impact_rate, "")],
      ["Lyapunov exponent", number(answer.lyapunov, "per cycle", 3)],
    ];
    this.element("numbers").replaceChildren(...rows.flatMap(([name, value]) => numbered(name, value)));
  }
  async #tellProof(stored) {
    const proof = await file.proof(stored.row, stored.column);
    if (proof && this.stored === stored && this.data) this.element("numbers").append(...numbered(...proofWords(proof, this.data.answer, this.cell)));
  }
  #keepStart(answer) {
    const colour = content.classes[classOf(answer.regime, answer.impacts, answer.period)].colour;
    this.starts = [...this.starts, { ...this.start, colour }].slice(-MOST_STARTS);
  }
  #showMotion() {
    const { data, cell } = this;
    const { answer, steady, way } = data;
    const steadyView = this.view === "steady";
    this.shownView = this.view;
    const motion = steadyView ? steady : way;
    if (!this.start) this.window = this.#windowOf(data);
    else if (!this.charts.basin) this.window = this.#widened(this.#windowOf(data));
    this.charts.show({
      motion, gap: cell.gap_ratio, scales: answer, pulse: data.pulse, touch: data.touch, multipliers: data.multipliers,
      points: steadyView ? data.points : way.points, starts: this.starts, window: this.window,
    });
    this.stage.length = answer.length_m;
    const period = 2 * Math.PI / cell.frequency_ratio;
    this.stage.show(motion, { gap: cell.gap_ratio, period });
    const hertz = (cell.frequency_ratio * answer.frequency_rad_per_s) / (2 * Math.PI);
    this.element("slowed").textContent = `slowed ${digits(SECONDS_PER_CYCLE * hertz, 2)} ×`;
    const most = 4 * 1000 * answer.length_m * answer.frequency_rad_per_s;
    Object.assign(this.element("knock"), { min: -most, max: most, step: most / 200 });
  }
  // Adds a margin around both motions, so that there is space to click.
  #windowOf({ steady, way }) {
    let [u, v] = [Math.max(1, Math.abs(this.cell.gap_ratio)), 1];
    for (const { samples } of [steady, way]) {
      for (let i = 0; i < samples.length; i += 5) {
        u = Math.max(u, Math.abs(samples[i + 2]));
        v = Math.max(v, Math.abs(samples[i + 3]));
      }
    }
    return { x: [-1.4 * u, Math.min(1.4 * u, this.cell.gap_ratio + 0.2 * u)], y: [-1.4 * v, 1.4 * v] };
  }
  #widened({ x, y }) {
    const both = ([from, to], [low, high]) => [Math.min(from, low), Math.max(to, high)];
    return { x: both(this.window.x, x), y: both(this.window.y, y) };
  }
  #setView(view) {
    this.view = view;
    this.element(`view-${view}`).checked = true;
  }
  #basinOff() {
    this.charts.basin?.end();
    this.charts.basin = null;
    this.element("basin").checked = false;
    this.element("basin-state").textContent = "";
    this.element("basin-legend").replaceChildren();
  }
  #basinOn() {
    if (!this.data || whyNot(this.cell)) return;
    const state = this.element("basin-state");
    this.charts.basin = liveBasin(this.workers, this.cell, this.window, (plane) => {
      const part = Math.floor((100 * plane.done) / plane.count);
      state.textContent = plane.finished ? `${BASIN_SIZE} × ${BASIN_SIZE} starts` : `${part} %`;
      state.dataset.finished = String(plane.finished);
      this.element("basin-legend").replaceChildren();
      entriesInto(this.element("basin-legend"), plane.motions.entries(this.data.answer));
      this.charts.drawPhase();
    });
  }
  #listen() {
    const listen = (name, event, act) => this.element(name).addEventListener(event, act);
    for (const view of ["steady", "way"]) {
      listen(`view-${view}`, "change", () => {
        this.view = view;
        if (this.data) this.#showMotion();
      });
    }
    listen("play", "click", () => this.togglePlay());
    listen("cancel", "click", () => this.cancel());
    listen("knock", "input", () => this.#knock(Number(this.element("knock").value)));
    listen("basin", "change", (event) => (event.target.checked ? this.#basinOn() : this.#basinOff() ?? this.charts.drawPhase()));
    listen("chart-phase", "click", (event) => {
      const at = this.data && this.charts.phase.valuesAt(event);
      if (!at) return;
      if (at[0] > this.cell.gap_ratio && this.cell.contact_law === 1) return; // no start inside a rigid stop
      this.startFrom(at[0], at[1], "from the start clicked");
    });
  }
  #showKnock(speed) {
    this.element("knock").value = speed;
    this.element("knock-value").textContent = `${speed > 0 ? "+" : ""}${digits(speed, 3)} mm/s`;
  }
  #knock(speed) {
    this.#showKnock(speed);
    if (!this.home) return;
    const { answer } = this.home;
    const unit = 1000 * answer.length_m * answer.frequency_rad_per_s;
    this.startFrom(answer.orbit_displacement, answer.orbit_velocity + speed / unit, `knocked by ${digits(speed, 3)} mm/s`);
  }
  togglePlay() {
    this.element("play").textContent = this.stage.toggle() ? "Pause" : "Play";
  }
  cancel() {
    this.workers.giveUp();
    this.element("cell").dataset.state = "given-up";
    this.element("cell").classList.toggle("cannot", this.data === null);
    this.element("spent").textContent = "given up";
  }
}
