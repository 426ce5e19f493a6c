// The page of a sweep: its branches gap by gap; a click on a point shows its
// motion, computed from the state stored in the file at forcing phase 0.

class SweepPage extends Page {
  layers = file.layers;
  picked = null; // {track, column, sample}

  async load() {
    await file.loadLabels();
    await Promise.all([file.layers[0], file.layer("peak_force_ratio")].map((layer) => file.loadLayer(layer)));
    const columns = file.columns.values.length;
    const plane = async ({ plane: packed, blob }) => planeOf(packed, await blobOf(blob), columns);
    file.jumps = await plane(content.jumps);
    this.starts = await Promise.all([content.starts.stroboscopic_displacement, content.starts.stroboscopic_velocity].map(plane));
    const shares = file.layer("basin_share");
    if (shares) await file.loadLayer(shares);
  }
  makeView(tell) {
    document.body.classList.add("of-sweep");
    this.#fillGaps();
    element("whole").textContent = "Whole sweep";
    element("map-top").setAttribute("aria-label", "Branches of a sweep: left and right arrows walk along a branch, up and down from one to the next, Enter solves a point, plus and minus zoom, 0 shows the whole sweep");
    return new BranchesView(element("map"), element("map-top"), tell);
  }
  #fillGaps() {
    element("gap-choice").hidden = content.gaps.length < 2;
    const select = element("gap");
    content.gaps.forEach((gap, n) => select.append(Object.assign(document.createElement("option"),
      { value: n, textContent: gap === null ? "" : bothUnits(content.gap, gap) })));
    select.addEventListener("change", () => this.showGap(Number(select.value)));
  }
  showGap(gap) {
    element("gap").value = gap;
    this.view.setGap(gap);
    this.drawLegend();
    if (this.picked) this.view.mark(this.picked);
    this.view.draw();
    this.writeAddress();
  }
  sizeWords() {
    return `${content.branches.toLocaleString("en")} branches of ${file.columns.values.length.toLocaleString("en")} points`;
  }
  paint(layer) {
    this.view.setLayer(layer);
  }
  drawLegend() {
    const parent = element("legend");
    parent.replaceChildren();
    entriesInto(parent, this.#entries());
    const ways = new Map(content.tracks.map(({ slot, direction, words }) => (slot === null ? [direction, words] : ["known", "an attractor that is known"])));
    marksInto(parent, [...ways]);
    if (this.layer.samples === 1 && this.layer.name !== "basin_share" && this.#jumpsHere()) linesInto(parent, [{ words: "the force jumps", colour: OUTLINE, dash: JUMP_DASH }]);
  }

  // Whether the force jumps on a branch of the gap shown.
  #jumpsHere() {
    return content.tracks.some(({ gap, slot }, track) => gap === this.view.gap && slot === null &&
      [...file.columns.values.keys()].some((column) => file.jumps.at(file.index(track, column)) === 1));
  }
  // Points of each class at the gap shown, on its branches or of its other attractors.
  #counts(onBranches) {
    const columns = [...file.columns.values.keys()];
    const here = content.tracks.flatMap(({ gap, slot }, track) => (
      gap === this.view.gap && (slot === null) === onBranches ? columns.map((column) => file.index(track, column)) : []));
    return kindCounts(here.map((point) => content.labels.table[file.labels.raw[point]][3]));
  }
  // The classes with their shares of the branches' points; those that only other attractors have, without.
  #entries() {
    const onBranches = this.#counts(true);
    const beside = this.#counts(false).map((count, kind) => (onBranches[kind] === 0 && kind !== MISSING ? count : 0));
    return [...classEntries(onBranches), ...classEntries(beside).map((entry) => ({ ...entry, share: null }))];
  }

  pick(target) {
    const { track, column } = target;
    this.picked = target;
    if (content.tracks[track].gap !== this.view.gap) this.showGap(content.tracks[track].gap);
    this.view.mark(target);
    this.writeAddress();
    if (!this.panel) return;
    element("cell").hidden = false;
    element("place").textContent = this.#placeWords(target).join(" · ");
    const inFile = file.value(track, column);
    const cell = this.#cellOf(target);
    if (cell === null) return this.panel.showFile(inFile, "The file has no motion of this point to begin with.");
    this.panel.show(cell, inFile, inFile);
  }
  // The cell on the file's motion there; null without one.
  #cellOf({ track, column }) {
    const [u, v] = this.starts.map((plane) => plane.at(file.index(track, column)));
    if (Number.isNaN(u)) return null;
    const values = [file.columns.values[column], ...(content.gap ? [content.gaps[content.tracks[track].gap]] : [])];
    const changes = file.sides.map((side, n) => changeOf(side, values[n]));
    return startingAt(settled(Object.assign({ ...content.cell }, ...changes)), u, v);
  }
  #placeWords({ track, column }) {
    const { gap, slot, words } = content.tracks[track];
    const share = file.number("basin_share", track, column);
    const starts = share > 0 ? `${percent(share)} of the starts end on it` : "none of the starts ends on it";
    return [bothUnits(file.columns, file.columns.values[column]), content.gap ? bothUnits(content.gap, content.gaps[gap]) : "",
      slot === null ? words : `attractor ${slot + 1}: ${starts}`].filter(Boolean);
  }
  readOut(target) {
    const out = element("readout");
    if (!target) return (out.textContent = "Point at a branch for its values; click a point and the engine finds its motion.");
    const { track, column, sample } = target;
    const { regime, impacts, period, peak_force_ratio: force } = file.value(track, column);
    const parts = [...this.#placeWords(target), labelWords(regime, impacts, period), this.forceWords(force)];
    if (content.tracks[track].slot === null && file.jumps.at(file.index(track, column)) === 1) parts.push("the force jumps on the way here");
    if (this.layer.name !== "peak_force_ratio" && this.layer.name !== "basin_share") parts.push(this.layerWords(track, column, sample));
    out.textContent = parts.filter(Boolean).join("   ");
  }

  // The gap shown is told where it isn't that of the point.
  forget() {
    this.picked = this.view.target = this.view.picked = null;
  }
  placeOfAddress() {
    if (!this.picked) return {};
    const { track, column } = this.picked;
    return { at: [track, column], ...(content.tracks[track].gap === this.view.gap ? {} : { gap: [this.view.gap] }) };
  }
  hasPlace(at) {
    return at.every(Number.isInteger) && file.holds(...at) && file.label(...at)[0] !== NOT_COMPUTED;
  }
  goTo({ at }) {
    if (at === null || !this.hasPlace(at)) return false;
    this.pick({ track: at[0], column: at[1], sample: 0 });
    return true;
  }
  hasGap(gap) {
    return content.gaps[gap] !== undefined;
  }
  followed({ gap }) {
    if (this.hasGap(gap) && gap !== this.view.gap) this.showGap(gap);
  }
  // Selects the periodic point of the first branch with the largest force.
  pickSomething() {
    const { length } = file.columns.values;
    let [most, hardest] = [-1, null];
    for (let column = 0; column < length; ++column) {
      const { regime, peak_force_ratio: force } = file.value(0, column);
      if (regime === PERIODIC && !(force <= most)) [most, hardest] = [force, column];
    }
    if (hardest !== null) this.pick({ track: 0, column: hardest, sample: 0 });
  }
  // For scripts: a promise of the engine's result, starting from the file's motion.
  async solve(track, column) {
    file.value(track, column); // throws if there is no such point
    const cell = this.#cellOf({ track, column });
    if (cell === null) throw new Error("the file has no motion of this point to begin with");
    return this.workers.solve(cell, [], []);
  }
}
