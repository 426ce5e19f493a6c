// The branches of a sweep at one of its gaps, over the swept coordinate: a mark for each point in the colour of its z, a triangle
// pointing in the branch's direction, and small dots for the other known attractors.

const NEAR = 24; // px: largest distance from the pointer to the selected mark
const OUTLINE = "#8A8A8A";
const JUMP_DASH = [2, 3];
const MANY_MARKS = 20000;

// The values of a layer as heights of the points.
class Heights {
  constructor(layer) {
    const force = layer.over_weight === true;
    const inAmplitudes = layer.name.endsWith("_displacement");
    const [name, factor, unit] = force ? ["F/(m g)", content.newtons, "N"]
      : inAmplitudes ? [layer.name.startsWith("impact") ? "x/A₀ at first touch" : "x/A₀ at forcing phase 0", 1000 * content.amplitude_m, "mm"] : [layer.title, null, ""];
    Object.assign(this, { name: layer.name, symbol: name + (layer.unit !== "1" ? ` (${layer.unit})` : ""), factor: factor || null, unit,
      about: force ? layer.title : "x", log: false, leadsInSi });
    let [low, high] = [Infinity, -Infinity];
    const count = layer.rows * layer.samples * file.columns.values.length;
    for (let i = 0; i < count; ++i) {
      const value = layer.plane.at(i);
      if (value < low) low = value;
      if (value > high) high = value;
    }
    if (!(high >= low)) [low, high] = [0, 1]; // no value at all
    if (force || (low >= 0 && low < 0.3 * high)) low = 0;
    const room = 0.05 * (high > low ? high - low : Math.abs(high) || 1);
    this.edges = [low === 0 ? -room / 2 : low - room, high + room];
  }
  get narrowest() {
    return (this.edges[1] - this.edges[0]) / 1000;
  }
  place(value) {
    return value;
  }
  value(place) {
    return place;
  }
}

class BranchesView extends PlaneView {
  constructor(below, above, tell) {
    super(below, above, { x: file.columns, y: new Heights(file.layers[0]) }, tell);
    this.layer = file.layers[0];
    this.gap = 0; // index among the file's gaps
  }
  // The layer whose values are shown as heights.
  setLayer(layer) {
    if (layer === this.layer) return;
    this.layer = layer;
    this.axes.y = new Heights(layer);
    this.view = { x: this.view.x, y: [...this.axes.y.edges] };
    this.hover = null; // a sample of the other layer
    if (this.target) this.mark({ ...this.target, sample: 0 });
  }
  setGap(gap) {
    this.gap = gap;
    this.hover = null;
  }
  // The selected point, at its height, or null if the layer has no value there.
  mark(target) {
    this.target = target;
    const { track, column, sample = 0 } = target;
    const y = file.number(this.layer.name, track, column, sample);
    this.picked = content.tracks[track].gap === this.gap && !Number.isNaN(y) ? this.#placeOf({ ...target, y }) : null;
    this.drawTop();
  }
  #placeOf({ column, y }) {
    return { x: file.columns.place(file.columns.values[column]), y };
  }
  // The tracks of this gap, the lowest layer first.
  get #tracks() {
    const own = content.tracks.map((track, number) => ({ ...track, number })).filter(({ gap }) => gap === this.gap);
    return own.reverse();
  }
  // Yields {track, column, sample, y} for all values of a track in these columns.
  *#points(track, from = 0, to = file.columns.values.length - 1) {
    for (let column = from; column <= to; ++column) {
      if (file.label(track, column)[0] === NOT_COMPUTED) continue;
      for (let sample = 0; sample < this.layer.samples; ++sample) {
        const y = file.number(this.layer.name, track, column, sample);
        if (!Number.isNaN(y)) yield { track, column, sample, y };
        else if (sample > 0) break;
      }
    }
  }
  // The visible columns, or those near a position [px].
  #columns(from, to) {
    const { edges, values } = file.columns;
    const inside = (place) => file.columns.cell(Math.min(Math.max(place, edges[0]), edges.at(-1)));
    return [Math.max(inside(from) - 1, 0), Math.min(inside(to) + 1, values.length - 1)];
  }
  targetAt(event) {
    const at = this.base.area && this.base.valuesAt(event);
    if (!at) return null;
    const [x, y] = [this.base.across(at[0]), this.base.up(at[1])];
    const reach = (NEAR / this.base.area.width) * (this.view.x[1] - this.view.x[0]);
    const columns = this.#columns(at[0] - reach, at[0] + reach);
    let [nearest, found] = [NEAR, null];
    for (const { number } of this.#tracks) {
      for (const point of this.#points(number, ...columns)) {
        const place = this.#placeOf(point);
        const distance = Math.hypot(this.base.across(place.x) - x, this.base.up(place.y) - y);
        if (distance <= nearest) [nearest, found] = [distance, point]; // among coinciding points, the topmost
      }
    }
    return found;
  }
  drawContent() {
    const [from, to] = this.#columns(...this.view.x);
    const apart = this.base.area.width / Math.max(to - from, 1);
    const radius = Math.min(Math.max(0.6 * apart, 2), 4.5) * this.base.letter;
    this.base.clipped((pen) => {
      for (const { number, slot, direction } of this.#tracks) {
        const points = [...this.#points(number, from, to)];
        if (slot === null && this.layer.samples === 1) this.#drawLine(pen, number, points, direction);
        this.#drawPoints(pen, number, points, slot === null ? direction : "known", slot === null ? radius : 0.55 * radius);
      }
    });
  }
  // Joins neighbours with periodic motions, dotted where the force jumps.
  #drawLine(pen, track, points, direction) {
    pen.strokeStyle = OUTLINE;
    pen.lineWidth = 1;
    const steady = ({ column }) => ![CHAOTIC, UNRESOLVED].includes(file.label(track, column)[0]);
    for (let n = 1; n < points.length; ++n) {
      const [before, after] = [points[n - 1], points[n]];
      const jumps = file.jumps.at(file.index(track, direction === "down" ? before.column : after.column)) === 1;
      if (after.column - before.column > 1 || !(jumps || (steady(before) && steady(after)))) continue;
      pen.setLineDash(jumps ? JUMP_DASH : []);
      pen.beginPath();
      for (const point of [before, after]) {
        const place = this.#placeOf(point);
        pen.lineTo(this.base.across(place.x), this.base.up(place.y));
      }
      pen.stroke();
    }
    pen.setLineDash([]);
  }
  #drawPoints(pen, track, points, shape, radius) {
    const small = this.layer.samples > 1 ? 0.6 * radius : radius;
    const places = points.map((point) => {
      const place = this.#placeOf(point);
      return [this.base.across(place.x), this.base.up(place.y)];
    });
    const draw = points.length > MANY_MARKS ? (x, y, size) => pen.fillRect(x - size / 2, y - size / 2, size, size)
      : (x, y, size) => fillMark(pen, shape, x, y, size);
    pen.fillStyle = OUTLINE; // outlines of all points first: dense points become one outlined band
    for (const [x, y] of places) draw(x, y, small + Math.min(0.9, 0.35 * small));
    points.forEach(({ column }, n) => {
      pen.fillStyle = content.classes[file.label(track, column)[3]].colour;
      draw(...places[n], small);
    });
  }
  drawMarks() {
    if (!this.hover) return;
    const place = this.#placeOf(this.hover);
    this.top.clipped((pen) => {
      for (const [colour, width] of [["#FFFFFF", 3], ["#000000", 1.2]]) {
        pen.strokeStyle = colour;
        pen.lineWidth = width;
        pen.beginPath();
        pen.arc(this.top.across(place.x), this.top.up(place.y), 6, 0, 2 * Math.PI);
        pen.stroke();
      }
    });
  }
  // Moves along the track; up and down to the next height at this coordinate.
  walk(right, up) {
    const middle = Math.round((file.columns.values.length - 1) / 2);
    const here = [this.hover, this.target].find((one) => one && content.tracks[one.track].gap === this.gap);
    const { track, column, sample, y } = here ?? { track: this.#tracks.at(-1).number, column: middle };
    const to = Math.min(Math.max(column + right, 0), file.columns.values.length - 1);
    let next;
    if (up === 0) next = [...this.#points(track, to, to)].find((point) => point.sample === sample) ?? [...this.#points(track, to, to)][0];
    else {
      const above = this.#tracks.flatMap(({ number }) => [...this.#points(number, column, column)])
        .filter((point) => (up > 0 ? point.y > y : point.y < y)).sort((a, b) => Math.abs(a.y - y) - Math.abs(b.y - y));
      next = above[0];
    }
    if (!next) return;
    const place = this.#placeOf(next);
    this.follow(place.x, place.y);
    this.setHover(next);
  }
}

// A mark of this radius [px] around a position; triangles have the visual size of disks.
function fillMark(pen, shape, x, y, radius) {
  pen.beginPath();
  if (shape === "up" || shape === "down") {
    const tip = shape === "up" ? -1 : 1;
    const side = 1.15 * radius;
    pen.moveTo(x, y + 1.25 * tip * radius);
    pen.lineTo(x - side, y - 0.8 * tip * radius);
    pen.lineTo(x + side, y - 0.8 * tip * radius);
  } else pen.arc(x, y, radius, 0, 2 * Math.PI);
  pen.fill();
}
