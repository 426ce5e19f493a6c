// The page of a map or a basin: its cells, and sliders of the rig for which the window shown is recomputed.

const USUAL_AXES = ["frequency_ratio", "gap_ratio", "displacement_ratio", "velocity_ratio"];
const Z_LAYER = { name: "z", title: "z = p/q" };
const REGIME_LAYER = { name: "regime", title: "regime" };
const COMMONEST_LAYER = { name: "commonest", title: "commonest outcome" };
const OF_OUTCOMES = /^outcome_(regime|impacts|period)\[/; // parts of what is told as a whole

function painterOf(layer) {
  if (layer === Z_LAYER) return classPainter();
  if (layer === REGIME_LAYER) return classPainter(REGIME_COLOURS);
  if (layer === COMMONEST_LAYER) return kindPainter(commonestKinds());
  return isWords(layer) ? wordPainter(layer, wordEntries(layer)) : numberPainter(layer);
}

class MapPage extends Page {
  layers = [Z_LAYER, REGIME_LAYER, ...(file.layer("outcome_regime[0]") ? [COMMONEST_LAYER] : []), ...file.layers.filter(({ name }) => !OF_OUTCOMES.test(name))];
  place = null; // [across, up] of the selected cell

  async load() {
    await super.load();
    await file.loadOutcomes();
  }
  makeView(tell) {
    return new MapView(element("map"), element("map-top"), tell);
  }
  beginMarks() {
    this.#edge();
  }
  beginRig() {
    this.rig = new Rig(element("sliders"), (kind) => this.#rigChanged(kind));
    element("as-file").addEventListener("click", () => this.#asFile());
    element("live").addEventListener("change", (event) => this.#setLive(event.target.checked));
    addEventListener("resize", () => (element("legend").style.minHeight = ""));
  }
  // While a live map is computed its classes appear one by one: the legend only grows, so that what lies below it stays where it is.
  drawLegend() {
    const legend = element("legend");
    const grows = this.liveWanted && this.legendOf === this.layer;
    legend.style.minHeight = grows ? `${legend.offsetHeight}px` : "";
    this.legendOf = this.layer;
    super.drawLegend();
    linesInto(legend, this.view.lines);
  }
  sizeWords() {
    return `${file.rows.values.length.toLocaleString("en")} × ${file.columns.values.length.toLocaleString("en")} cells`;
  }
  paint(layer) {
    this.view.paint = painterOf(layer);
  }

  pick({ row, column }) {
    this.pickPlace(file.columns.values[column], file.rows.values[row], { row, column });
  }
  // The cell nearest to a place of the map, or the place itself if set by the sliders.
  pickPlace(x, y, cell = null) {
    this.place = [x, y];
    this.view.setPicked(file.columns.place(x), file.rows.place(y));
    this.writeAddress();
    if (!this.panel) return;
    this.rig.setPlace([x, y]);
    element("cell").hidden = false;
    const inside = (axis, value) => Math.max(axis.cell(Math.min(Math.max(axis.place(value), axis.edges[0]), axis.edges.at(-1))), 0);
    const inFile = file.value(inside(file.rows, y), inside(file.columns, x));
    element("place").textContent = this.#placeWords(this.rig.cell);
    this.panel.show(this.rig.cell, inFile, cell && !this.rig.differs ? inFile : null);
  }
  #placeWords({ hertz, amplitude_m: amplitude, frequency_ratio: frequency, gap_ratio: gap, displacement_ratio: x, velocity_ratio: v }) {
    const parts = [bothUnits({ name: "frequency_ratio", symbol: "Ω/ω", factor: hertz, unit: "Hz" }, frequency),
      bothUnits({ name: "gap_ratio", symbol: "gap/A₀", factor: amplitude && 1000 * amplitude, unit: "mm" }, gap, 4)];
    for (const axis of [file.columns, file.rows]) {
      if (USUAL_AXES.includes(axis.name)) continue;
      const value = this.rig.place[axis === file.columns ? 0 : 1];
      parts.push(`${axis.about} ${digits(value * (axis.factor ?? 1), 4)} ${axis.unit}`.trim());
    }
    if (file.isBasin) parts.push(`from ${bothUnits(file.columns, x, 4)}, ${bothUnits(file.rows, v, 4)}`);
    return parts.filter(Boolean).join(" · ");
  }
  readOut(cell) {
    const out = element("readout");
    if (!cell) return (out.textContent = this.invitation);
    const { regime, impacts, period, peak_force_ratio: force } = file.value(cell.row, cell.column);
    const parts = [bothUnits(file.columns, file.columns.values[cell.column]), bothUnits(file.rows, file.rows.values[cell.row]),
      labelWords(regime, impacts, period), this.forceWords(force)];
    if (this.layer.blob !== undefined && this.layer.name !== "peak_force_ratio") parts.push(this.layerWords(cell.row, cell.column));
    const outcomes = outcomeWords(cell.row, cell.column);
    if (outcomes) parts.push(`drawn rigs: ${outcomes}`);
    if (this.view.patch) parts.unshift("in the file:");
    out.textContent = parts.filter(Boolean).join("   ");
  }
  get invitation() {
    const solves = content.cell !== null && content.engine !== null && whyNot(content.cell) === null;
    return `Point at a cell for its values${solves ? "; click it and the engine solves it" : ""}.`;
  }

  moved() {
    super.moved();
    if (this.liveWanted) this.#recompute(250);
  }
  #rigChanged(kind) {
    const [x, y] = this.rig.place;
    if (this.place) this.pickPlace(x, y, this.#cellExactlyAt(x, y));
    this.#edge();
    if (kind === "rig") this.#setLive(this.rig.differs || element("live").checked || file.isBasin);
    else if (!this.place) this.pickPlace(x, y);
  }
  #cellExactlyAt(x, y) {
    const column = file.columns.cell(file.columns.place(x));
    const row = file.rows.cell(file.rows.place(y));
    const exact = file.holds(row, column) && file.columns.values[column] === x && file.rows.values[row] === y;
    return exact ? { row, column } : null;
  }
  #edge() {
    if (file.isBasin) this.view.stop = this.rig?.cell.gap_ratio ?? content.place.gap_ratio;
    const zeta = this.rig ? (this.rig.changes.damping_ratio ?? content.damping_ratio) : content.damping_ratio;
    const isUsual = file.columns.name === "frequency_ratio" && file.rows.name === "gap_ratio"; // the line exists only in that plane; curves are more exact
    if (isUsual && !content.curves && zeta !== null) this.view.edge = (ratio) => ratio ** 2 / Math.hypot(1 - ratio ** 2, 2 * zeta * ratio);
    this.view.drawTop();
  }
  #setLive(wanted) {
    this.liveWanted = wanted;
    element("live").checked = wanted;
    if (wanted) return this.#recompute(0);
    clearTimeout(this.recomputing);
    this.live?.end();
    this.live = this.view.patch = null;
    element("live-state").textContent = "";
    this.view.draw();
    this.drawLegend();
    this.readOut(this.view.hover);
    this.writeAddress();
  }
  #recompute(delay) {
    clearTimeout(this.recomputing);
    this.recomputing = setTimeout(() => {
      const refusal = whyNot(this.rig.cell);
      if (refusal) return (element("live-state").textContent = refusal);
      this.live?.end();
      this.live = liveMap(this.workers, this.rig.cell, this.view.view, this.layer, (plane) => this.#showLive(plane));
      this.writeAddress();
    }, delay);
  }
  #showLive(plane) {
    this.view.patch = plane;
    this.view.draw();
    this.drawLegend();
    const state = element("live-state");
    state.dataset.finished = String(plane.finished);
    state.dataset.milliseconds = plane.finished ? plane.milliseconds.toFixed(0) : "";
    state.textContent = plane.finished ? `${LIVE_SIZE} × ${LIVE_SIZE} cells in ${(plane.milliseconds / 1000).toFixed(1)} s`
      : `computing: ${Math.floor((100 * plane.done) / plane.count)} %`;
  }
  #asFile() {
    element("live").checked = false;
    this.rig.reset();
    this.#setLive(false);
  }

  forget() {
    this.place = this.view.picked = null;
  }
  placeOfAddress() {
    return this.place ? { at: this.place } : {};
  }
  hasPlace(at) {
    return [file.columns, file.rows].every((axis, n) => at[n] >= leastOf(axis));
  }
  goTo({ at }) {
    if (at !== null && !this.hasPlace(at)) return false;
    if (at) this.pickPlace(...at, this.#cellExactlyAt(...at));
    return at !== null;
  }
  followed({ live }) {
    if (this.rig) this.#setLive(live ?? this.rig.differs);
    this.#edge();
  }
  liveOfAddress() {
    const shown = element("live").checked;
    return this.rig && shown !== this.rig.differs ? shown : null;
  }
  // Selects the periodic cell nearest to the centre.
  pickSomething() {
    const [rows, columns] = [file.rows.values.length, file.columns.values.length];
    const step = Math.ceil(Math.max(rows, columns) / 256);
    let [nearest, cell] = [Infinity, null];
    for (let row = 0; row < rows; row += step) {
      for (let column = 0; column < columns; column += step) {
        const distance = Math.hypot(row / rows - 0.5, column / columns - 0.5);
        if (distance < nearest && file.label(row, column)[0] === PERIODIC) [nearest, cell] = [distance, { row, column }];
      }
    }
    if (cell) this.pick(cell);
  }
  // For scripts: a promise of the engine's result for a cell.
  solve(row, column) {
    file.value(row, column); // throws if there is no such cell
    return this.workers.solve(content.cell, file.sides, [file.columns.values[column], file.rows.values[row]]);
  }
}
