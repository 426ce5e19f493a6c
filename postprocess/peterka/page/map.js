// The map on its plane: cells, live cells, the line of the free swing, the cell under the pointer.

const EDGE_LINE = { words: "free swing grazes the stop", colour: "#000000", dash: [6, 4] };
const STOP_LINE = { words: "stop at the start", colour: "#000000", dash: [2, 2] };

class MapView extends PlaneView {
  constructor(below, above, tell) {
    super(below, above, { x: file.columns, y: file.rows }, tell);
    this.paint = null; // painter of the layer shown
    this.patch = null; // live map: {view, size, canvas}
    this.edge = null; // gap at which a freely swinging hammer grazes, by frequency ratio
    this.stop = null; // gap of a basin
  }
  drawContent() {
    if (this.paint) this.#drawCells();
    this.#drawPatch();
  }
  drawMarks() {
    this.#drawEdge();
    this.#drawStop();
    if (this.hover?.row !== undefined) this.#frameCell(this.hover);
  }
  targetAt(event) {
    const at = this.base.area && this.base.valuesAt(event);
    return at && this.#cellOf(at[0], at[1]);
  }
  #cellOf(x, y) {
    const cell = { row: file.rows.cell(y), column: file.columns.cell(x) };
    return file.holds(cell.row, cell.column) ? cell : null;
  }

  // Each pixel shows the cell at its centre.
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
  #drawEdge() {
    if (!this.edge) return;
    const count = Math.max(Math.round(this.top.area.width), 2);
    const x = (i) => this.view.x[0] + (i / (count - 1)) * (this.view.x[1] - this.view.x[0]);
    const y = (i) => file.rows.place(this.edge(file.columns.value(x(i))));
    this.top.line(count, x, y, "#FFFFFF", 2.6, EDGE_LINE.dash);
    this.top.line(count, x, y, EDGE_LINE.colour, 1.2, EDGE_LINE.dash);
  }
  // The stop's position at the start, in a basin.
  #drawStop() {
    const gap = this.stop;
    if (!Number.isFinite(gap)) return;
    for (const [colour, width] of [["#FFFFFF", 2.6], [STOP_LINE.colour, 1.2]]) {
      this.top.line(2, () => gap, (i) => this.view.y[i], colour, width, STOP_LINE.dash);
    }
  }
  // Whether the line of grazing comes into the map.
  #meetsEdge() {
    const { edges } = file.columns;
    const heights = Array.from({ length: 500 }, (_, i) => edges[0] + (i / 499) * (edges.at(-1) - edges[0]))
      .map((place) => file.rows.place(this.edge(file.columns.value(place))));
    return Math.min(...heights) <= file.rows.edges.at(-1) && Math.max(...heights) >= file.rows.edges[0];
  }
  // For a legend: the lines over the cells.
  get lines() {
    const lines = [...(this.edge && this.#meetsEdge() ? [EDGE_LINE] : []), ...(Number.isFinite(this.stop) ? [STOP_LINE] : [])];
    return lines.map((line) => ({ ...line, colour: "currentColor" })); // visible in both themes
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
  walk(right, up) {
    const middle = ([from, to]) => (from + to) / 2;
    const from = (this.hover?.row === undefined ? null : this.hover) ?? this.#cellOf(middle(this.view.x), middle(this.view.y));
    const inside = (n, count) => Math.min(Math.max(n, 0), count - 1);
    const cell = { row: inside(from.row + up, file.rows.values.length), column: inside(from.column + right, file.columns.values.length) };
    this.follow(file.columns.place(file.columns.values[cell.column]), file.rows.place(file.rows.values[cell.row]));
    this.setHover(cell);
  }
}
