// The page: puts the parts together.

const element = (id) => document.getElementById(id);
const USUAL_AXES = ["frequency_ratio", "gap_ratio", "displacement_ratio", "velocity_ratio"];
const Z_LAYER = { name: "z", title: "z = p/q" };
const REGIME_LAYER = { name: "regime", title: "regime" };
const LAYERS = [Z_LAYER, REGIME_LAYER, ...file.layers];

function painterOf(layer) {
  if (layer === Z_LAYER) return classPainter();
  if (layer === REGIME_LAYER) return classPainter(REGIME_COLOURS);
  return isWords(layer) ? wordPainter(layer, wordEntries(layer)) : numberPainter(layer);
}

class Page {
  async begin() {
    element("title").textContent = content.title;
    element("facts").textContent = factsWords();
    await file.loadLabels();
    this.layer = Z_LAYER;
    this.map = new MapView(element("map"), element("map-top"), {
      hover: (cell) => this.#readOut(cell),
      pick: ({ row, column }) => this.pick(file.columns.values[column], file.rows.values[row], { row, column }),
      moved: () => this.#moved(),
    });
    this.map.paint = classPainter();
    this.map.drawNow();
    this.#edge();
    performance.mark("first-picture");
    await new Promise((done) => setTimeout(done));
    drawLegend(element("legend"), this.layer);
    this.#fillLayers();
    await this.#beginEngine();
    await this.#loadForce();
    this.#listen();
    await this.#followAddress();
    document.documentElement.dataset.ready = "true";
  }
  async #loadForce() {
    const force = file.layers.find((layer) => layer.name === "peak_force_ratio");
    if (force) await file.loadLayer(force);
  }
  async #beginEngine() {
    element("missing").textContent = content.missing ? `No live cells: ${content.missing}` : "";
    if (content.cell === null || content.engine === null) return document.body.classList.add("no-engine");
    const bytes = await blobOf(content.engine);
    this.workers = new Workers(bytes, element("worker").textContent);
    document.body.classList.toggle("cannot-run", whyNot(content.cell) !== null);
    this.rig = new Rig(element("sliders"), (kind) => this.#rigChanged(kind));
    this.panel = new CellPanel(element, this.workers);
  }
  #fillLayers() {
    const select = element("layer");
    for (const layer of LAYERS) {
      select.append(Object.assign(document.createElement("option"), { value: layer.name, textContent: layer.title }));
    }
    select.addEventListener("change", () => this.showLayer(select.value));
  }
  async showLayer(name) {
    const layer = LAYERS.find((one) => one.name === name) ?? Z_LAYER;
    this.layer = layer;
    element("layer").value = layer.name;
    if (layer.blob !== undefined) await file.loadLayer(layer);
    if (this.layer !== layer) return; // another one was chosen meanwhile
    this.map.paint = painterOf(layer);
    drawLegend(element("legend"), layer, this.map.patch?.kinds);
    this.map.draw();
    this.#moved();
  }

  // The cell nearest to a place of the map, or the place itself where the sliders lead.
  pick(x, y, cell = null) {
    this.place = [x, y];
    this.map.setPicked(file.columns.place(x), file.rows.place(y));
    this.#writeAddress();
    if (!this.panel) return;
    this.rig.setPlace([x, y]);
    element("cell").hidden = false;
    const inside = (axis, value) => Math.max(axis.cell(Math.min(Math.max(axis.place(value), axis.edges[0]), axis.edges.at(-1))), 0);
    const inFile = file.value(inside(file.rows, y), inside(file.columns, x));
    element("place").textContent = this.#placeWords(this.rig.cell);
    this.panel.show(this.rig.cell, inFile, cell && !this.rig.differs ? inFile : null);
  }
  #placeWords({ hertz, amplitude_m: amplitude, frequency_ratio: frequency, gap_ratio: gap, displacement_ratio: x, velocity_ratio: v }) {
    const parts = [`Ω/ω ${digits(frequency, 5)}`, hertz && `${digits(frequency * hertz, 4)} Hz`, `gap/A₀ ${digits(gap, 4)}`,
      amplitude && `${digits(1000 * gap * amplitude, 4)} mm`];
    for (const axis of [file.columns, file.rows]) {
      if (USUAL_AXES.includes(axis.name)) continue;
      const value = this.rig.place[axis === file.columns ? 0 : 1];
      parts.push(`${axis.about} ${digits(value * (axis.factor ?? 1), 4)} ${axis.unit}`.trim());
    }
    if (file.isBasin) parts.push(`from x/A₀ ${digits(x, 4)}, ẋ/(A₀ω) ${digits(v, 4)}`);
    return parts.filter(Boolean).join(" · ");
  }
  #readOut(cell) {
    const out = element("readout");
    if (!cell) return (out.textContent = out.dataset.empty);
    const { regime, impacts, period, peak_force_ratio: force } = file.value(cell.row, cell.column);
    const axis = (one, n) => {
      const value = one.values[n];
      return `${one.symbol} ${digits(value, 5)}${one.factor ? ` · ${digits(value * one.factor, 4)} ${one.unit}` : ""}`;
    };
    const parts = [axis(file.columns, cell.column), axis(file.rows, cell.row), labelWords(regime, impacts, period)];
    if (force > 0) parts.push(`${content.newtons ? `${digits(force * content.newtons, 4)} N · ` : ""}${digits(force, 4)} m g`);
    if (this.layer.blob !== undefined && this.layer.name !== "peak_force_ratio") parts.push(this.#layerValue(cell));
    if (this.map.patch) parts.unshift("in the file:");
    out.textContent = parts.join("   ");
  }
  #layerValue({ row, column }) {
    const { layer } = this;
    const value = file.number(layer.name, row, column);
    const words = layer.words?.[value]?.replaceAll("_", " ") ?? digits(value, 5);
    return `${layer.title} ${words}${layer.unit && layer.unit !== "1" ? ` ${layer.unit}` : ""}`;
  }

  #moved() {
    this.#writeAddress();
    if (this.liveWanted) this.#recompute(250);
  }
  #rigChanged(kind) {
    const [x, y] = this.rig.place;
    if (this.place) this.pick(x, y, this.#cellExactlyAt(x, y));
    this.#edge();
    if (kind === "rig") this.#setLive(this.rig.differs || element("live").checked || file.isBasin);
    else if (!this.place) this.pick(x, y);
  }
  #cellExactlyAt(x, y) {
    const column = file.columns.cell(file.columns.place(x));
    const row = file.rows.cell(file.rows.place(y));
    const exact = file.holds(row, column) && file.columns.values[column] === x && file.rows.values[row] === y;
    return exact ? { row, column } : null;
  }
  #edge() {
    if (file.isBasin) this.map.stop = this.rig?.cell.gap_ratio ?? content.place.gap_ratio;
    const zeta = this.rig ? (this.rig.changes.damping_ratio ?? content.damping_ratio) : content.damping_ratio;
    const isUsual = file.columns.name === "frequency_ratio" && file.rows.name === "gap_ratio"; // the line is one of that plane
    if (isUsual && zeta !== null) this.map.edge = (ratio) => ratio ** 2 / Math.hypot(1 - ratio ** 2, 2 * zeta * ratio);
    this.map.drawTop();
  }
  #setLive(wanted) {
    this.liveWanted = wanted;
    element("live").checked = wanted;
    if (wanted) return this.#recompute(0);
    this.live?.end();
    this.live = this.map.patch = null;
    element("live-state").textContent = "";
    this.map.draw();
    drawLegend(element("legend"), this.layer);
    this.#writeAddress();
  }
  #recompute(delay) {
    clearTimeout(this.recomputing);
    this.recomputing = setTimeout(() => {
      const refusal = whyNot(this.rig.cell);
      if (refusal) return (element("live-state").textContent = refusal);
      this.live?.end();
      this.live = liveMap(this.workers, this.rig.cell, this.map.view, this.layer, (plane) => this.#showLive(plane));
      this.#writeAddress();
    }, delay);
  }
  #showLive(plane) {
    this.map.patch = plane;
    this.map.draw();
    drawLegend(element("legend"), this.layer, plane.kinds);
    const state = element("live-state");
    state.dataset.finished = String(plane.finished);
    state.dataset.milliseconds = plane.finished ? plane.milliseconds.toFixed(0) : "";
    state.textContent = plane.finished ? `${LIVE_SIZE} × ${LIVE_SIZE} cells in ${(plane.milliseconds / 1000).toFixed(1)} s`
      : `computing: ${Math.floor((100 * plane.done) / plane.count)} %`;
  }

  #writeAddress() {
    if (!this.listens) return;
    writeAddress({ layer: this.layer.name, view: this.map.view, place: this.place, rig: this.rig?.values() ?? [],
      live: Boolean(this.rig && element("live").checked && !this.rig.differs) });
  }
  async #followAddress() {
    const address = readAddress();
    element("address-state").textContent = this.#strangeWords(address);
    for (const [name, value] of this.rig ? address.rig : []) this.rig.take(name, Number(value));
    if (address.x || address.y) this.map.show(address.x ?? this.map.view.x, address.y ?? this.map.view.y);
    if (address.layer !== "z") await this.showLayer(address.layer);
    if (!address.place && !this.place) this.#pickMiddle();
    if (address.place) this.pick(...address.place, this.#cellExactlyAt(...address.place));
    if (this.rig && (address.live || this.rig.differs)) this.#setLive(true);
    this.#edge();
    this.listens = true;
  }
  // What of an address this page doesn't follow, for it was made by another version or for another file.
  #strangeWords({ rig, version }) {
    const known = ["layer", "x", "y", "at", "live", "version"];
    const strange = rig.filter(([name, value]) => !known.includes(name) && !this.rig?.takes(name, Number(value)));
    const parts = strange.map(([name, value]) => `${name} = ${value} isn't of this page's rig and is left out`);
    if (version !== null && version !== VERSION) parts.unshift(`the address was made by version ${version}, this page by ${VERSION}`);
    return parts.length > 0 ? `${parts.join("; ")}.` : "";
  }
  // Something to look at: the periodic cell nearest to the middle.
  #pickMiddle() {
    const [rows, columns] = [file.rows.values.length, file.columns.values.length];
    const step = Math.ceil(Math.max(rows, columns) / 256);
    let [nearest, place] = [Infinity, null];
    for (let row = 0; row < rows; row += step) {
      for (let column = 0; column < columns; column += step) {
        const distance = Math.hypot(row / rows - 0.5, column / columns - 0.5);
        if (distance < nearest && file.label(row, column)[0] === PERIODIC) [nearest, place] = [distance, { row, column }];
      }
    }
    if (place) this.pick(file.columns.values[place.column], file.rows.values[place.row], place);
  }
  #listen() {
    element("whole").addEventListener("click", () => this.map.whole());
    element("closer").addEventListener("click", () => this.map.zoom(1.5));
    element("farther").addEventListener("click", () => this.map.zoom(1 / 1.5));
    element("theme").addEventListener("click", () => this.#turnTheme());
    element("keys").addEventListener("click", () => element("help").showModal());
    element("as-file").addEventListener("click", () => this.#asFile());
    element("live").addEventListener("change", (event) => this.#setLive(event.target.checked));
    addEventListener("hashchange", () => this.#followAddress());
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.#repaint());
    addEventListener("keydown", (event) => this.#key(event));
  }
  #asFile() {
    element("live").checked = false;
    this.rig.reset();
    this.#setLive(false);
  }
  #key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || /INPUT|SELECT|BUTTON/.test(event.target.tagName)) return;
    if (event.key === " " && this.panel) this.panel.togglePlay();
    else if (event.key === "Escape" && element("cell").dataset.state === "solving") this.panel.cancel();
    else if (event.key === "l") this.#nextLayer();
    else if (event.key === "?") element("help").showModal();
    else return;
    event.preventDefault();
  }
  #nextLayer() {
    const names = LAYERS.map((layer) => layer.name);
    this.showLayer(names[(names.indexOf(this.layer.name) + 1) % names.length]);
  }
  #turnTheme() {
    const root = document.documentElement;
    const dark = (root.dataset.theme ?? (matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light")) === "dark";
    root.dataset.theme = dark ? "light" : "dark";
    this.#repaint();
  }
  #repaint() {
    this.map.draw();
    this.panel?.charts.draw();
    this.panel?.stage.draw();
  }
}

function factsWords() {
  const size = `${file.rows.values.length.toLocaleString("en")} × ${file.columns.values.length.toLocaleString("en")} cells`;
  const computed = content.computed < 1 ? `${(Math.floor(1000 * content.computed) / 10).toFixed(1)} % computed` : "";
  const every = content.every > 1 ? `each ${content.every}th row and column` : "";
  const force = content.layers.find((layer) => layer.name === "peak_force_ratio")?.plane.digits;
  const short = force ? `force to ${force} digits` : "";
  return [content.name, size, computed, every, short, content.source, content.commit].filter(Boolean).join(" · ");
}

// For scripts: value(row, column) is the file's, solve(row, column) a promise of the engine's.
const page = new Page();
const begun = page.begin();
window.peterka = {
  ready: begun.then(() => undefined),
  value: (row, column) => file.value(row, column),
  solve: async (row, column) => {
    await begun;
    if (!page.workers) throw new Error(content.missing);
    const refusal = whyNot(content.cell);
    if (refusal) throw new Error(refusal);
    file.value(row, column); // says so where there is no such cell
    const values = [file.columns.values[column], file.rows.values[row]];
    return page.workers.solve(content.cell, file.sides, values);
  },
};
