// The page of a file of curves: the curves over their coarse map, whose cells are shown as on the page of a map. A click on a
// curve shows the motions on its two sides.

class CurvesPage extends MapPage {
  edge = null; // the selected {curve, point}

  async load() {
    await super.load();
    await curves.load();
  }
  makeView(tell) {
    return new CurvesView(element("map"), element("map-top"), tell, () => Boolean(this.rig?.differs));
  }
  sizeWords() {
    const count = curves.list.length;
    return `${count.toLocaleString("en")} ${count === 1 ? "curve" : "curves"} · coarse map of ${super.sizeWords()}`;
  }
  get invitation() {
    return "Point at a curve or a cell; click a curve for the motions on both of its sides, a cell for its own.";
  }
  drawLegend() {
    super.drawLegend();
    if (this.view.hides()) return;
    const kinds = new Set(curves.list.map(({ kind }) => kind));
    linesInto(element("legend"), Object.entries(content.curves.kinds).filter(([kind]) => kinds.has(kind)).map(([, one]) => one));
    const meetings = new Set(content.curves.specials.map(({ words }) => words));
    if (meetings.size > 0) marksInto(element("legend"), [["dot", [...meetings].join(", ")]]);
  }
  readOut(target) {
    if (target?.curve === undefined) return super.readOut(target);
    element("readout").textContent = this.#edgeWords(target).join("   ");
  }
  // What happens at this point, to which motion, where.
  #edgeWords({ curve, point }) {
    const { kind } = curves.list[curve];
    const [x, y] = curves.values(curve, point);
    const [multiplier, force] = ["multiplier", "peak_force_ratio"].map((name) => curves.number(name, curve, point));
    return [`${content.curves.kinds[kind].words} · ${curves.label(curves.list[curve])}`, bothUnits(file.columns, x), bothUnits(file.rows, y),
      Number.isNaN(multiplier) ? "" : `multiplier ${digits(multiplier, 4)}`, this.forceWords(force)].filter(Boolean);
  }

  pick(target) {
    if (target.curve === undefined) super.pick(target);
    else this.pickEdge(target);
  }
  pickPlace(x, y, cell = null) {
    this.edge = null;
    element("edge").hidden = true;
    super.pickPlace(x, y, cell);
  }
  async pickEdge(edge) {
    const { curve, point } = edge;
    this.edge = edge;
    this.place = curves.values(curve, point);
    this.view.setPicked(...curves.place(curve, point));
    this.writeAddress();
    if (!this.panel) return;
    this.rig.setPlace(this.place);
    this.panel.cancel();
    element("cell").hidden = false;
    element("cell").classList.add("cannot");
    element("edge").hidden = false;
    element("edge").dataset.state = "solving";
    element("edge-words").textContent = this.#edgeWords(edge).join(" · ");
    element("edge-sides").replaceChildren();
    const refusal = whyNot(content.cell) ?? (content.curves.has_orbits ? null : "This file, of an older version, tells no orbits on its curves, from which to go to their sides: compute it again.");
    element("edge-step").textContent = refusal ?? "The engine follows the orbit to both sides …";
    if (refusal) return;
    const { step, sides } = await besideCurve(this.workers, curve, point);
    if (this.edge !== edge) return; // another one was selected meanwhile
    this.#showSides(edge, step, sides);
  }
  #showSides({ curve, point }, step, sides) {
    const shown = Math.max(sides.findIndex(({ keeps }) => keeps), 0);
    element("edge-step").textContent = this.#stepWords(this.place, step, sides);
    element("edge-sides").replaceChildren(...sides.map((side, n) => this.#choiceOf(side, n, n === shown, curves.list[curve], sides)));
    element("edge").dataset.state = "solved";
    this.#showSide(sides[shown]);
  }
  #showSide({ values, cell, found }) {
    element("place").textContent = [file.columns, file.rows].map((axis, n) => bothUnits(axis, values[n], 7)).join(" · ");
    this.panel.show(cell, found, null);
  }
  #choiceOf(side, number, checked, curve, sides) {
    const row = document.createElement("label");
    const button = Object.assign(document.createElement("input"), { type: "radio", name: "side", id: `side-${number}`, checked });
    button.addEventListener("change", () => this.#showSide(side));
    const { regime, impacts, period, peak_force_ratio: force } = side.found;
    const patch = document.createElement("i");
    patch.style.background = content.classes[classOf(regime, impacts, period)].colour;
    const label = [labelWords(regime, impacts, period), this.forceWords(force)].filter(Boolean).join(", ");
    const words = Object.assign(document.createElement("span"), { textContent: `${label}: ${this.#fate(side, curve, sides)}` });
    const where = [file.columns, file.rows].map((axis, n) => bothUnits(axis, side.values[n], 7)).join(" · ");
    row.append(button, patch, words, Object.assign(document.createElement("small"), { textContent: where }));
    row.dataset.keeps = side.keeps;
    return row;
  }
  #fate({ keeps }, curve, sides) {
    if (keeps) return sides.every((side) => side.keeps) ? "the motion goes on on both sides" : "this side keeps the motion";
    const lost = sides.every((side) => !side.keeps) ? `, for ${curves.label(curve)} lives in a narrower strip` : "";
    return `what becomes of it on this side${lost}`;
  }
  #stepWords([x, y], step, sides) {
    const apart = [file.columns, file.rows].map((axis, n) => {
      const change = Math.abs(sides[1].values[n] - [x, y][n]);
      return axis.factor ? `${digits(change * axis.factor, 2)} ${axis.unit}` : `${digits(change, 2)} in ${axis.symbol}`;
    });
    const cubic = content.cell.cubic_stiffness_n_per_m3 ? ", springs without their cubic term, as on the curve" : "";
    return `Each side lies ${digits(100 * step, 2)} % of the window off the curve: ${apart.join(" and ")}. The engine goes on there from the orbit on the curve${cubic}.`;
  }

  forget() {
    this.edge = null;
    super.forget();
  }
  placeOfAddress() {
    return this.edge ? { curve: [this.edge.curve, this.edge.point] } : super.placeOfAddress();
  }
  hasCurve(curve) {
    return curves.has(...curve);
  }
  goTo(address) {
    const { curve } = address;
    if (curve === null || !this.hasCurve(curve)) return super.goTo(address);
    this.pickEdge({ curve: curve[0], point: curve[1] });
    return true;
  }
  // Selects the middle of the longest curve.
  pickSomething() {
    const length = ({ from, to }) => to - from;
    const longest = curves.list.reduce((one, other) => (one && length(one) >= length(other) ? one : other), null);
    if (longest && content.curves.has_orbits) this.pickEdge({ curve: curves.list.indexOf(longest), point: length(longest) >> 1 });
    else super.pickSomething();
  }
  // For scripts: [{values, regime, impacts, period, peak_force_ratio, keeps}, ...] of both sides.
  async beside(curve, point) {
    if (!curves.has(curve, point)) throw new RangeError(`there is no point ${point} of a curve ${curve}`);
    if (!content.curves.has_orbits) throw new Error("the file tells no orbits on its curves");
    const { sides } = await besideCurve(this.workers, curve, point);
    return sides.map(({ values, found, keeps }) => ({ values, ...found, keeps }));
  }
}
