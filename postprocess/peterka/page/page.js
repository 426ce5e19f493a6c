// Behaviour common to all pages: shows the layers of a file, starts the engine, handles the address and the keys. The page of
// each kind of file adds: layers, makeView(), paint(layer), sizeWords(), readOut(target), pick(target), placeOfAddress(),
// goTo(address), pickSomething(), forget().

const element = (id) => document.getElementById(id);

class Page {
  async begin() {
    element("title").textContent = content.title;
    element("facts").textContent = factsWords(this.sizeWords());
    await this.load();
    this.layer = this.layers[0];
    this.view = this.makeView({ hover: (target) => this.readOut(target), pick: (target) => this.pick(target), moved: () => this.moved() });
    this.readOut(null);
    this.paint(this.layer);
    this.view.drawNow();
    this.beginMarks();
    performance.mark("first-picture");
    await new Promise((done) => setTimeout(done));
    this.drawLegend();
    this.#fillLayers();
    await this.#beginEngine();
    await this.#loadForce();
    this.#listen();
    await this.#followAddress();
    document.documentElement.dataset.ready = "true";
  }
  // Loads what the first picture needs.
  load() {
    return file.loadLabels();
  }
  beginMarks() {}
  beginRig() {}
  async #loadForce() {
    const force = file.layer("peak_force_ratio");
    if (force) await file.loadLayer(force);
  }
  async #beginEngine() {
    element("missing").textContent = content.missing ? `No live cells: ${content.missing}` : "";
    if (content.cell === null || content.engine === null) return document.body.classList.add("no-engine");
    const bytes = await blobOf(content.engine);
    this.workers = new Workers(bytes, element("worker").textContent);
    document.body.classList.toggle("cannot-run", whyNot(content.cell) !== null);
    this.panel = new CellPanel(element, this.workers);
    this.beginRig();
  }
  #fillLayers() {
    const select = element("layer");
    for (const layer of this.layers) {
      select.append(Object.assign(document.createElement("option"), { value: layer.name, textContent: inUnit(layer.title, layer) }));
    }
    select.addEventListener("change", () => this.showLayer(select.value));
  }
  async showLayer(name) {
    const layer = this.layers.find((one) => one.name === name) ?? this.layers[0];
    this.chosen = layer;
    element("layer").value = layer.name;
    if (layer.blob !== undefined) await file.loadLayer(layer);
    if (this.chosen !== layer) return; // another one was chosen meanwhile
    this.layer = layer;
    this.paint(layer);
    this.drawLegend();
    this.view.draw();
    this.readOut(this.view.hover);
    this.moved();
  }
  drawLegend() {
    drawLegend(element("legend"), this.layer, this.view.patch?.tally);
  }
  // The file's data for a target: the force, and a value of the layer shown, in words.
  forceWords(force) {
    return force > 0 ? inOrder(content.newtons && `${digits(force * content.newtons, 4)} N`, `${digits(force, 4)} m g`).join(" · ") : "";
  }
  layerWords(row, column, sample = 0) {
    const { layer } = this;
    const value = file.number(layer.name, row, column, sample);
    if (file.label(row, column)[0] === NOT_COMPUTED) return "";
    if (layer.never !== undefined && value < 0) return `${layer.title}: ${layer.never}`;
    if (layer.over_weight) return `${layer.title} ${this.forceWords(value) || digits(value, 4)}`;
    const words = layer.words?.[value]?.replaceAll("_", " ") ?? (layer.plane.raw ? value.toLocaleString("en") : digits(value, 5));
    return `${layer.title} ${words}${layer.unit && layer.unit !== "1" ? ` ${layer.unit}` : ""}`;
  }

  moved() {
    this.writeAddress();
  }
  writeAddress() {
    if (!this.listens) return;
    const { layer, layers, view, rig } = this;
    writeAddress({ layer: layer === layers[0] ? undefined : layer.name, axes: view.axes, view: view.view, at: this.placeOfAddress(),
      rig: rig?.values() ?? [], live: this.liveOfAddress() });
  }
  // What an address doesn't name is as in a page that was just opened.
  async #followAddress() {
    const address = readAddress();
    const turn = (this.turn = (this.turn ?? 0) + 1);
    this.listens = false;
    element("address-state").textContent = this.#strangeWords(address);
    this.rig?.reset();
    for (const [name, value] of this.rig ? address.rig : []) this.rig.take(name, Number(value));
    await this.showLayer(address.layer ?? this.layers[0].name);
    if (turn !== this.turn) return; // another one was entered meanwhile
    this.forget();
    this.panel?.cancel();
    element("cell").hidden = true;
    this.view.show(address.x ?? this.view.wholeOf("x"), address.y ?? this.view.wholeOf("y"));
    if (!this.goTo(address)) this.pickSomething();
    this.followed(address);
    this.listens = true;
  }
  followed() {}
  liveOfAddress() {
    return null;
  }
  // Whether this page has what an address names.
  hasPlace() {
    return true;
  }
  hasCurve() {
    return false;
  }
  hasGap() {
    return false;
  }
  // The parts of an address that this page ignores, as it was made by another version or for another file.
  #strangeWords({ rig, version, at, curve, gap }) {
    const strange = rig.filter(([name, value]) => !this.rig?.takes(name, Number(value)));
    const parts = strange.map(([name, value]) => `${name} = ${value} isn't of this page's rig and is left out`);
    if (at !== null && !this.hasPlace(at)) parts.push(`at = ${at.join(",")} is no place of this page and is left out`);
    if (curve !== null && !this.hasCurve(curve)) parts.push(`curve = ${curve.join(",")} is no point of this page’s curves and is left out`);
    if (gap !== null && !this.hasGap(gap)) parts.push(`gap = ${gap} is none of this page’s gaps and is left out`);
    if (version !== null && version !== VERSION) parts.unshift(`the address was made by version ${version}, this page by ${VERSION}`);
    return parts.length > 0 ? `${parts.join("; ")}.` : "";
  }
  #listen() {
    element("whole").addEventListener("click", () => this.view.whole());
    element("closer").addEventListener("click", () => this.view.zoom(1.5));
    element("farther").addEventListener("click", () => this.view.zoom(1 / 1.5));
    element("theme").addEventListener("click", () => this.#turnTheme());
    element("keys").addEventListener("click", () => element("help").showModal());
    addEventListener("hashchange", () => this.#followAddress());
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.#repaint());
    addEventListener("keydown", (event) => this.#key(event));
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
    const names = this.layers.map((layer) => layer.name);
    this.showLayer(names[(names.indexOf((this.chosen ?? this.layer).name) + 1) % names.length]);
  }
  #turnTheme() {
    const root = document.documentElement;
    const dark = (root.dataset.theme ?? (matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light")) === "dark";
    root.dataset.theme = dark ? "light" : "dark";
    this.#repaint();
  }
  #repaint() {
    this.view.draw();
    this.panel?.charts.draw();
    this.panel?.stage.draw();
  }
  // For scripts: resolves once the engine can run the file's cells; rejects with the reason if it cannot.
  async ready() {
    await this.begun;
    if (!this.workers) throw new Error(content.missing);
    const refusal = whyNot(content.cell);
    if (refusal) throw new Error(refusal);
  }
}

// A coordinate in both of its units, to this many digits: first in the one in which the job gives it.
function bothUnits({ name, symbol, factor, unit }, value, count = 5) {
  const ratio = `${symbol} ${digits(value, count)}`;
  if (!factor) return ratio;
  const si = `${digits(value * factor, Math.max(count, 5) - 1)} ${unit}`;
  return inOrder(si, ratio, content.in_si.includes(name)).join(" · ");
}

function factsWords(size) {
  const every = content.every > 1 ? `1 of ${content.every} rows and columns` : "";
  const force = content.layers.find((layer) => layer.name === "peak_force_ratio")?.plane.digits;
  const short = force ? `force to ${force} digits` : "";
  return [content.name, size, content.incomplete, every, short, content.source, content.commit].filter(Boolean).join(" · ");
}
