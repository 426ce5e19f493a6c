// A plane of cells computed by the workers while the page is idle, coarse to fine: a live map, or the basin of a cell.

const COARSEST = 16; // spacing of the cells in the first pass

// Cells of a size x size grid, those of the coarsest pass first: [[place, stride], ...].
function coarseToFine(size) {
  const order = [];
  for (let stride = COARSEST; stride >= 1; stride /= 2) {
    for (let j = 0; j < size; j += stride) {
      for (let i = 0; i < size; i += stride) {
        if (stride === COARSEST || i % (2 * stride) > 0 || j % (2 * stride) > 0) order.push([j * size + i, stride]);
      }
    }
  }
  return order;
}

// Counts of live cells for a legend: of each class, of those that have no force, and of those that only the program solves.
class Tally {
  kinds = new Array(content.classes.length).fill(0);
  apart = new Array(content.classes.length).fill(0); // those that keep the colour of their class among forces
  forceless = 0; // others without a force
  beyond = 0;
  add(regime, p, q, force) {
    if (regime === NOT_COMPUTED) return void ++this.beyond;
    const kind = classOf(regime, p, q);
    ++this.kinds[kind];
    if (APART.includes(kind) && !(force > 0)) ++this.apart[kind];
    else if (Number.isNaN(force)) ++this.forceless;
  }
  get all() {
    return this.kinds.reduce((sum, one) => sum + one, this.beyond) || 1;
  }
}

class LivePlane {
  // {workers, cell, sides, size, valuesAt(i, j) -> [of sides[0], of sides[1]] or null where there is nothing to compute,
  //  colour(...LISTED_NUMBERS) -> abgr, changed(plane)}
  constructor(how) {
    Object.assign(this, how);
    this.canvas = Object.assign(document.createElement("canvas"), { width: this.size, height: this.size });
    this.image = new ImageData(this.size, this.size);
    this.pixels = new Uint32Array(this.image.data.buffer);
    this.strides = new Uint8Array(this.size ** 2).fill(255); // stride of the cell that coloured a pixel
    this.todo = coarseToFine(this.size).filter(([place]) => this.#values(place));
    this.has = new Uint8Array(this.size ** 2); // mask of cells to compute: coarse cells must not extend beyond it
    for (const [place] of this.todo) this.has[place] = 1;
    this.count = this.todo.length;
    this.done = 0;
    this.tally = new Tally();
    this.begun = performance.now();
    this.todo.reverse(); // the next one is last
    this.workers.begin(this);
  }
  end() {
    this.workers.end(this);
  }
  get finished() {
    return this.done === this.count;
  }
  hasMore() {
    return this.todo.length > 0;
  }
  take(most) {
    const places = this.todo.splice(-most).reverse();
    return { places, cells: Float64Array.from(places.flatMap(([place]) => this.#values(place))) };
  }
  putBack(places) {
    this.todo.push(...places.reverse());
  }
  give(places, results) {
    places.forEach(([place, stride], n) => {
      const cell = results.subarray(LISTED_NUMBERS.length * n, LISTED_NUMBERS.length * (n + 1));
      this.tally.add(...cell);
      this.#paint(place, stride, this.colour(...cell));
    });
    this.done += places.length;
    if (this.finished) this.milliseconds = performance.now() - this.begun;
    this.waits ??= requestAnimationFrame(() => {
      this.waits = null;
      if (this.ended) return;
      this.canvas.getContext("2d").putImageData(this.image, 0, 0);
      this.changed(this);
    });
  }
  #values(place) {
    return this.valuesAt(place % this.size, Math.floor(place / this.size));
  }
  // Row 0 is at the bottom.
  #paint(place, stride, colour) {
    const [i, j] = [place % this.size, Math.floor(place / this.size)];
    for (let row = j; row < Math.min(j + stride, this.size); ++row) {
      const line = (this.size - 1 - row) * this.size;
      for (let column = i; column < Math.min(i + stride, this.size); ++column) {
        if (this.strides[line + column] < stride || !this.has[row * this.size + column]) continue;
        this.strides[line + column] = stride;
        this.pixels[line + column] = colour;
      }
    }
  }
}

const LIVE_SIZE = 128;

// The least value that an axis can have beyond its ends: negative only if it has negative values.
function leastOf(axis) {
  if (axis.name.includes("frequency") || axis.log) return Math.min(axis.values[0], 1e-6 * axis.values.at(-1));
  return axis.values[0] >= 0 ? 0 : -Infinity;
}
const valueInside = (axis, place) => Math.max(axis.value(place), leastOf(axis));

// The window of the map, recomputed for this rig.
function liveMap(workers, cell, view, layer, changed) {
  const at = ([from, to], n) => from + ((n + 0.5) / LIVE_SIZE) * (to - from);
  const plane = new LivePlane({
    workers, cell, sides: file.sides, size: LIVE_SIZE, changed,
    valuesAt: (i, j) => [valueInside(file.columns, at(view.x, i)), valueInside(file.rows, at(view.y, j))],
    colour: liveColour(layer),
  });
  plane.view = { x: [...view.x], y: [...view.y] };
  return plane;
}

// A live map provides z, regime and peak force; instead of other layers it shows z.
const isLive = (layer) => ["z", "regime", "peak_force_ratio"].includes(layer.name);

function liveColour(layer) {
  const none = abgr(NO_VALUE_COLOUR);
  const told = (colour) => (regime, p, q) => (regime === NOT_COMPUTED ? none : colour(classOf(regime, p, q)));
  if (layer.name === "regime") return told((kind) => abgr(REGIME_COLOURS[kind]));
  if (layer.name !== "peak_force_ratio") return told((kind) => CLASS_COLOURS[kind]);
  const colours = Uint32Array.from(scaleOf(layer), abgr);
  const last = colours.length - 1;
  return (regime, p, q, force) => {
    if (regime === NOT_COMPUTED) return none;
    const kind = classOf(regime, p, q);
    if (APART.includes(kind) && !(force > 0)) return CLASS_COLOURS[kind];
    if (Number.isNaN(force)) return none;
    return colours[Math.min(last, Math.max(0, Math.round(((force - layer.low) / (layer.top - layer.low)) * last)))];
  };
}
