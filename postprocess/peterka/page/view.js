// A plane on a canvas: axes in ratios and in Hz and mm, pan and zoom by pointer, wheel and keys, hovering and picking. A second
// canvas on top holds moving elements. Subclasses draw and find the contents of the plane: drawContent(), drawMarks(),
// targetAt(event) and walk(right, up, from).

// The scales of an axis, {factor, words}: of its ratios and, if it has one, of its values in Hz, mm or N, the job's own first.
function scalesOf({ symbol, about, unit, factor, leadsInSi: first }) {
  const ratios = { factor: 1, words: symbol };
  if (!factor) return [ratios];
  const si = { factor, words: `${about} (${unit})` };
  return first ? [si, ratios] : [ratios, si];
}

const SIDE = 62; // CSS pixels on a screen of standard size: room for ticks beside a plane, more where their labels are long

class PlaneView {
  // axes: {x, y}, each with edges, place(value), value(place), narrowest, and words and factor of its scales.
  constructor(below, above, axes, tell) {
    this.base = new Plot(below, { left: SIDE, right: SIDE, top: 42, bottom: 40 });
    this.top = new Plot(above, this.base.margins);
    this.axes = axes;
    this.tell = tell; // {hover(target or null), pick(target), moved()}
    this.hover = null;
    this.picked = null; // {x, y}: places
    this.reset();
    this.#listen(above);
    new ResizeObserver(() => this.draw()).observe(below);
  }
  reset() {
    this.view = { x: this.wholeOf("x"), y: this.wholeOf("y") };
  }
  draw() {
    this.waits ??= requestAnimationFrame(() => {
      this.waits = null;
      this.drawNow();
    });
  }
  drawNow() {
    this.base.frame(this.view.x, this.view.y);
    const [left, right = SIDE] = scalesOf(this.axes.y).map(({ factor }) => this.#roomBeside(factor));
    Object.assign(this.base.margins, { left, right }); // of both canvases
    this.base.frame(this.view.x, this.view.y);
    this.drawContent();
    this.#drawAxes();
    this.drawTop();
  }
  drawTop() {
    this.top.frame(this.view.x, this.view.y);
    this.drawMarks();
    if (this.picked) this.#markPicked();
  }
  #drawAxes() {
    const { left, top, width, height } = this.base.area;
    const { pen, letter } = this.base;
    pen.strokeStyle = ink("ink");
    pen.strokeRect(left - 0.5, top - 0.5, width + 1, height + 1);
    pen.fillStyle = ink("ink");
    const [[below, above], [before, behind]] = [scalesOf(this.axes.x), scalesOf(this.axes.y)];
    this.#ticks(this.axes.x, below.factor, width / (60 * letter), (at) => [at, top + height, 0, 5]);
    this.#ticks(this.axes.y, before.factor, height / (45 * letter), (at) => [left, at, -5, 0]);
    if (above) this.#ticks(this.axes.x, above.factor, width / (60 * letter), (at) => [at, top, 0, -5]);
    if (behind) this.#ticks(this.axes.y, behind.factor, height / (45 * letter), (at) => [left + width, at, 5, 0]);
    this.base.write(12);
    pen.textAlign = "center";
    pen.textBaseline = "alphabetic";
    pen.fillText(below.words, left + width / 2, top + height + 34 * letter);
    if (above) pen.fillText(above.words, left + width / 2, 13 * letter);
    this.base.sideways(before.words, 10 * letter, top + height / 2);
    if (behind) this.base.sideways(behind.words, left + width + (this.base.margins.right - 9) * letter, top + height / 2);
  }
  // For the labels of the ticks of a scale of the y axis, and its name.
  #roomBeside(factor) {
    const { pen, letter, area } = this.base;
    const { values, step } = this.#ticksOf(this.axes.y, factor, area.height / (45 * letter));
    const widest = Math.max(0, ...values.map((value) => pen.measureText(tickText(value, step)).width));
    return Math.max(SIDE, widest / letter + 28);
  }
  #ticksOf(axis, factor, count) {
    const [low, high] = (axis === this.axes.x ? this.view.x : this.view.y).map((at) => axis.value(at) * factor);
    return axis.log ? logTicks(low, high, count) : ticksBetween(low, high, count);
  }
  #ticks(axis, factor, count, place) {
    const alongX = axis === this.axes.x;
    const { values, step } = this.#ticksOf(axis, factor, count);
    const pen = this.base.pen;
    for (const value of values) {
      const at = axis.place(value / factor);
      const [x, y, dx, dy] = place(Math.round(alongX ? this.base.across(at) : this.base.up(at)) + 0.5);
      pen.beginPath();
      pen.moveTo(x, y);
      pen.lineTo(x + dx, y + dy);
      pen.stroke();
      pen.textAlign = dx === 0 ? "center" : dx < 0 ? "right" : "left";
      pen.textBaseline = dy === 0 ? "middle" : dy < 0 ? "bottom" : "top";
      pen.fillText(tickText(value, step), x + 1.6 * dx, y + 1.6 * dy);
    }
  }
  #markPicked() {
    const [x, y] = [this.top.across(this.picked.x), this.top.up(this.picked.y)];
    this.top.clipped((pen) => {
      for (const [colour, width] of [["#FFFFFF", 4], ["#000000", 1.6]]) {
        pen.strokeStyle = colour;
        pen.lineWidth = width;
        pen.beginPath();
        pen.arc(x, y, 7, 0, 2 * Math.PI);
        for (const [dx, dy] of [[1, 0], [-1, 0], [0, 1], [0, -1]]) {
          pen.moveTo(x + 7 * dx, y + 7 * dy);
          pen.lineTo(x + 13 * dx, y + 13 * dy);
        }
        pen.stroke();
      }
    });
  }

  // Moves the view so that it stays within both axes and is no narrower than they permit.
  show(x, y) {
    const fit = ([from, to], axis) => {
      const [low, high] = [axis.edges[0], axis.edges.at(-1)];
      if (from <= low && to >= high) return [low, high]; // not rounded: an address doesn't name it
      const width = Math.min(Math.max(to - from, axis.narrowest), high - low);
      const middle = (from + to) / 2;
      const start = Math.min(Math.max(middle - width / 2, low), high - width);
      return [start, start + width];
    };
    this.view = { x: fit(x, this.axes.x), y: fit(y, this.axes.y) };
    this.draw();
    this.tell.moved();
  }
  zoom(factor, x, y) {
    const around = ([from, to], at) => [at - (at - from) / factor, at + (to - at) / factor];
    const middle = ([from, to]) => (from + to) / 2;
    this.show(around(this.view.x, x ?? middle(this.view.x)), around(this.view.y, y ?? middle(this.view.y)));
  }
  pan(across, up) {
    const moved = ([from, to], share) => [from + share * (to - from), to + share * (to - from)];
    this.show(moved(this.view.x, across), moved(this.view.y, up));
  }
  setHover(target) {
    this.hover = target;
    this.drawTop();
    this.tell.hover(target);
  }
  setPicked(x, y) {
    this.picked = { x, y };
    this.drawTop();
  }
  // Moves the view so that a place lies inside it.
  follow(x, y) {
    const beyond = ([from, to], at) => (at < from || at > to ? (at - (from + to) / 2) / (to - from) : 0);
    const [across, up] = [beyond(this.view.x, x), beyond(this.view.y, y)];
    if (across !== 0 || up !== 0) this.pan(across, up);
  }

  #listen(canvas) {
    const pointers = new Map();
    let travelled = 0;
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      pointers.set(event.pointerId, event);
      travelled = 0;
    });
    canvas.addEventListener("pointermove", (event) => {
      const before = pointers.get(event.pointerId);
      if (!before) return this.setHover(this.targetAt(event));
      const { width, height } = this.base.area;
      travelled += Math.hypot(event.clientX - before.clientX, event.clientY - before.clientY);
      if (pointers.size === 1 && travelled > 4) {
        this.pan((before.clientX - event.clientX) / width, (event.clientY - before.clientY) / height);
      } else if (pointers.size === 2) this.#pinch(pointers, before, event);
      pointers.set(event.pointerId, event);
    });
    const release = (event) => {
      if (pointers.delete(event.pointerId) && travelled <= 4 && event.type === "pointerup") this.#click(event);
    };
    canvas.addEventListener("pointerup", release);
    canvas.addEventListener("pointercancel", release);
    canvas.addEventListener("pointerleave", () => this.setHover(null));
    canvas.addEventListener("wheel", (event) => {
      const at = this.base.valuesAt(event);
      if (!at) return;
      event.preventDefault();
      this.zoom(Math.exp(-Math.max(-60, Math.min(60, event.deltaY)) / 250), at[0], at[1]);
    }, { passive: false });
    canvas.addEventListener("keydown", (event) => this.#key(event));
  }
  #click(event) {
    const target = this.targetAt(event);
    if (target) this.tell.pick(target);
  }
  #pinch(pointers, before, event) {
    const [other] = [...pointers.values()].filter((one) => one.pointerId !== event.pointerId);
    const apart = (one) => Math.hypot(one.clientX - other.clientX, one.clientY - other.clientY);
    const at = this.base.valuesAt(other);
    if (at && apart(before) > 0) this.zoom(apart(event) / apart(before), at[0], at[1]);
  }
  // Arrows move to the next target, ten at once with Shift; Enter solves it; + and - zoom, 0 shows everything.
  #key(event) {
    const step = event.shiftKey ? 10 : 1;
    const steps = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, step], ArrowDown: [0, -step] };
    if (steps[event.key]) this.walk(...steps[event.key]);
    else if (event.key === "Enter" && this.hover) this.tell.pick(this.hover);
    else if (event.key === "+" || event.key === "=") this.zoom(1.5);
    else if (event.key === "-") this.zoom(1 / 1.5);
    else if (event.key === "0") this.whole();
    else return;
    event.preventDefault();
  }
  wholeOf(side) {
    return [this.axes[side].edges[0], this.axes[side].edges.at(-1)];
  }
  whole() {
    this.reset();
    this.draw();
    this.tell.moved();
  }
}
