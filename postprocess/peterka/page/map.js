// The map on its canvas: cells, axes in ratios and in Hz and mm, pan and zoom, the cell under the pointer and the one
// that is picked. A second canvas on top holds what moves.

class MapView {
  constructor(below, above, tell) {
    this.base = new Plot(below, { left: 62, right: 62, top: 42, bottom: 40 });
    this.top = new Plot(above, this.base.margins);
    this.tell = tell; // {hover(cell or null), pick(cell), moved()}
    this.paint = null; // of the layer shown
    this.patch = null; // live map: {view, size, canvas}
    this.edge = null; // gap at which a free hammer touches, by frequency ratio
    this.stop = null; // the gap of a basin
    this.hover = null; // {row, column}
    this.picked = null; // {x, y}: places
    this.reset();
    this.#listen(above);
    new ResizeObserver(() => this.draw()).observe(below);
  }
  reset() {
    const whole = (axis) => [axis.edges[0], axis.edges.at(-1)];
    this.view = { x: whole(file.columns), y: whole(file.rows) };
  }
  draw() {
    this.waits ??= requestAnimationFrame(() => {
      this.waits = null;
      this.drawNow();
    });
  }
  drawNow() {
    this.base.frame(this.view.x, this.view.y);
    if (this.paint) this.#drawCells();
    this.#drawPatch();
    this.#drawAxes();
    this.drawTop();
  }
  drawTop() {
    this.top.frame(this.view.x, this.view.y);
    this.#drawEdge();
    this.#drawStop();
    if (this.hover) this.#frameCell(this.hover);
    if (this.picked) this.#markPicked();
  }
  cellAt(event) {
    const at = this.base.area && this.base.valuesAt(event);
    return at && this.#cellOf(at[0], at[1]);
  }
  #cellOf(x, y) {
    const cell = { row: file.rows.cell(y), column: file.columns.cell(x) };
    return file.holds(cell.row, cell.column) ? cell : null;
  }

  // Each pixel shows the cell in its middle.
  #drawCells() {
    const scale = this.base.canvas.width / this.base.canvas.getBoundingClientRect().width;
    const { left, top, width, height } = this.base.area;
    const [w, h] = [Math.max(Math.round(width * scale), 1), Math.max(Math.round(height * scale), 1)];
    const image = new ImageData(w, h);
    const out = new Uint32Array(image.data.buffer);
    const along = (axis, [from, to], count) =>
      Int32Array.from({ length: count }, (_, i) => axis.cell(from + ((i + 0.5) / count) * (to - from)));
    const columns = along(file.columns, this.view.x, w);
    const rows = along(file.rows, this.view.y, h).reverse();
    for (let y = 0; y < h; ++y) {
      if (rows[y] >= 0) this.paint(out, y * w, rows[y] * file.columns.values.length, columns, y);
    }
    this.base.pen.putImageData(image, Math.round(left * scale), Math.round(top * scale));
  }
  #drawPatch() {
    if (!this.patch) return;
    const { view, canvas } = this.patch;
    this.base.clipped((pen) => {
      pen.imageSmoothingEnabled = false;
      const [x0, x1, y0, y1] = [view.x[0], view.x[1], view.y[0], view.y[1]];
      pen.drawImage(canvas, this.base.across(x0), this.base.up(y1), this.base.across(x1) - this.base.across(x0),
        this.base.up(y0) - this.base.up(y1));
      this.#nameBox(pen, `live, ${canvas.width} × ${canvas.height} cells`);
    });
  }
  #nameBox(pen, words) {
    const { area: { left, top }, letter } = this.base;
    pen.fillStyle = ink("paper");
    pen.globalAlpha = 0.85;
    pen.fillRect(left, top, pen.measureText(words).width + 14 * letter, 20 * letter);
    pen.globalAlpha = 1;
    pen.fillStyle = ink("ink");
    pen.textAlign = "left";
    pen.textBaseline = "middle";
    pen.fillText(words, left + 7 * letter, top + 10 * letter);
  }
  #drawAxes() {
    const { left, top, width, height } = this.base.area;
    const { pen, letter } = this.base;
    pen.strokeStyle = ink("ink");
    pen.strokeRect(left - 0.5, top - 0.5, width + 1, height + 1);
    pen.fillStyle = ink("ink");
    this.#ticks(file.columns, 1, width / (60 * letter), (at) => [at, top + height, 0, 5]);
    this.#ticks(file.rows, 1, height / (45 * letter), (at) => [left, at, -5, 0]);
    if (file.columns.factor) this.#ticks(file.columns, file.columns.factor, width / (60 * letter), (at) => [at, top, 0, -5]);
    if (file.rows.factor) this.#ticks(file.rows, file.rows.factor, height / (45 * letter), (at) => [left + width, at, 5, 0]);
    this.base.write(12);
    pen.textAlign = "center";
    pen.textBaseline = "alphabetic";
    pen.fillText(file.columns.symbol, left + width / 2, top + height + 34 * letter);
    if (file.columns.factor) pen.fillText(`${file.columns.about} (${file.columns.unit})`, left + width / 2, 13 * letter);
    this.base.sideways(file.rows.symbol, 10 * letter, top + height / 2);
    if (file.rows.factor) this.base.sideways(`${file.rows.about} (${file.rows.unit})`, left + width + 53 * letter, top + height / 2);
  }
  #ticks(axis, factor, count, place) {
    const alongX = axis === file.columns;
    const [low, high] = (alongX ? this.view.x : this.view.y).map((at) => axis.value(at) * factor);
    const { values, step } = axis.log ? logTicks(low, high, count) : ticksBetween(low, high, count);
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
  #drawEdge() {
    if (!this.edge) return;
    const count = Math.max(Math.round(this.top.area.width), 2);
    const x = (i) => this.view.x[0] + (i / (count - 1)) * (this.view.x[1] - this.view.x[0]);
    const y = (i) => file.rows.place(this.edge(file.columns.value(x(i))));
    this.top.line(count, x, y, "#FFFFFF", 2.6, [6, 4]);
    this.top.line(count, x, y, "#000000", 1.2, [6, 4]);
  }
  // Where the stop is at the start, in a basin.
  #drawStop() {
    const gap = this.stop;
    if (!Number.isFinite(gap)) return;
    for (const [colour, width] of [["#FFFFFF", 2.6], ["#000000", 1.2]]) {
      this.top.line(2, () => gap, (i) => this.view.y[i], colour, width, [2, 2]);
    }
  }
  #frameCell({ row, column }) {
    const pen = this.top.pen;
    const [x0, x1] = [column, column + 1].map((i) => this.top.across(file.columns.edges[i]));
    const [y1, y0] = [row, row + 1].map((i) => this.top.up(file.rows.edges[i]));
    const grow = Math.max(0, 3 - (x1 - x0) / 2);
    this.top.clipped(() => {
      for (const [colour, width] of [["#FFFFFF", 3], ["#000000", 1.2]]) {
        pen.strokeStyle = colour;
        pen.lineWidth = width;
        pen.strokeRect(x0 - grow, y0 - grow, x1 - x0 + 2 * grow, y1 - y0 + 2 * grow);
      }
    });
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

  // Moves a view so that it stays on the map and shows three cells at least.
  show(x, y) {
    const fit = ([from, to], axis) => {
      const [low, high] = [axis.edges[0], axis.edges.at(-1)];
      const width = Math.min(Math.max(to - from, (3 * (high - low)) / axis.values.length), high - low);
      const middle = (from + to) / 2;
      const start = Math.min(Math.max(middle - width / 2, low), high - width);
      return [start, start + width];
    };
    this.view = { x: fit(x, file.columns), y: fit(y, file.rows) };
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
  setHover(cell) {
    this.hover = cell;
    this.drawTop();
    this.tell.hover(cell);
  }
  setPicked(x, y) {
    this.picked = { x, y };
    this.drawTop();
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
      if (!before) return this.setHover(this.cellAt(event));
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
    const cell = this.cellAt(event);
    if (cell) this.tell.pick(cell);
  }
  #pinch(pointers, before, event) {
    const [other] = [...pointers.values()].filter((one) => one.pointerId !== event.pointerId);
    const apart = (one) => Math.hypot(one.clientX - other.clientX, one.clientY - other.clientY);
    const at = this.base.valuesAt(other);
    if (at && apart(before) > 0) this.zoom(apart(event) / apart(before), at[0], at[1]);
  }
  // Arrows walk from cell to cell, ten at once with Shift; Enter solves the cell; + and - zoom, 0 shows the whole map.
  #key(event) {
    const step = event.shiftKey ? 10 : 1;
    const steps = { ArrowLeft: [0, -step], ArrowRight: [0, step], ArrowUp: [step, 0], ArrowDown: [-step, 0] };
    const middle = ([from, to]) => (from + to) / 2;
    if (steps[event.key]) {
      const from = this.hover ?? this.#cellOf(middle(this.view.x), middle(this.view.y));
      this.#walk(from.row + steps[event.key][0], from.column + steps[event.key][1]);
    } else if (event.key === "Enter" && this.hover) this.tell.pick(this.hover);
    else if (event.key === "+" || event.key === "=") this.zoom(1.5);
    else if (event.key === "-") this.zoom(1 / 1.5);
    else if (event.key === "0") this.whole();
    else return;
    event.preventDefault();
  }
  whole() {
    this.reset();
    this.draw();
    this.tell.moved();
  }
  #walk(row, column) {
    const inside = (n, count) => Math.min(Math.max(n, 0), count - 1);
    const cell = { row: inside(row, file.rows.values.length), column: inside(column, file.columns.values.length) };
    const follow = ([from, to], at) => (at < from || at > to ? (at - (from + to) / 2) / (to - from) : 0);
    const across = follow(this.view.x, file.columns.place(file.columns.values[cell.column]));
    const up = follow(this.view.y, file.rows.place(file.rows.values[cell.row]));
    if (across !== 0 || up !== 0) this.pan(across, up);
    this.setHover(cell);
  }
}
