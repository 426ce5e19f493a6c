// Curves over the coarse map in which their orbits were searched: where periodic motions are born, end or change their number of impacts.

const CURVE_NEAR = 9; // px: largest distance from the pointer to the selected curve
const MOST_CURVE_NAMES = 24;
const NAMES_APART = 44; // px

// Numbers of all points of the curves: column and row as values of the axes, and the file's further data.
const curves = {
  list: content.curves?.list ?? [],
  points: null,
  async load() {
    const columns = file.columns.values.length;
    const named = Object.entries(content.curves.points)
      .map(async ([name, { plane, blob }]) => [name, planeOf(plane, await blobOf(blob), columns).at]);
    this.points = Object.fromEntries(await Promise.all(named));
  },
  has(curve, point) {
    const one = this.list[curve];
    return one !== undefined && Number.isInteger(point) && point >= 0 && point < one.to - one.from;
  },
  // [across, up] of a point of a curve.
  values(curve, point) {
    const at = this.list[curve].from + point;
    return [this.points.column(at), this.points.row(at)];
  },
  place(curve, point) {
    const [x, y] = this.values(curve, point);
    return [file.columns.place(x), file.rows.place(y)];
  },
  number(name, curve, point) {
    return this.points[name]?.(this.list[curve].from + point) ?? NaN;
  },
  label({ impacts, period }) {
    return impacts === 0 ? labelWords(NO_IMPACT, 0, 1) : labelWords(PERIODIC, impacts, period);
  },
};

class CurvesView extends MapView {
  // hides(): whether the curves belong to a different rig than the one shown.
  constructor(below, above, tell, hides) {
    super(below, above, tell);
    this.hides = hides;
  }
  drawContent() {
    super.drawContent();
    if (this.hides()) return;
    this.base.clipped((pen) => {
      for (const [number, { kind }] of curves.list.entries()) this.#stroke(this.base, pen, number, "#FFFFFF", 3.2, []);
      for (const [number, { kind }] of curves.list.entries()) {
        const { colour, dash } = content.curves.kinds[kind];
        this.#stroke(this.base, pen, number, colour, 1.6, dash.map((length) => 1.6 * length));
      }
      this.#drawSpecials(pen);
      this.#drawNames(pen);
    });
  }
  #stroke(plot, pen, number, colour, width, dash) {
    pen.strokeStyle = colour;
    pen.lineWidth = width * plot.letter;
    pen.setLineDash(dash.map((length) => length * plot.letter));
    pen.lineJoin = "round";
    pen.beginPath();
    for (const [x, y] of this.#way(number)) pen.lineTo(x, y);
    pen.stroke();
    pen.setLineDash([]);
  }
  // The curve's path on the screen.
  #way(number) {
    const { from, to } = curves.list[number];
    return Array.from({ length: to - from }, (_, point) => {
      const [x, y] = curves.place(number, point);
      return [this.base.across(x), this.base.up(y)];
    });
  }
  #drawSpecials(pen) {
    for (const { place: [x, y] } of content.curves.specials) {
      const at = [this.base.across(file.columns.place(x)), this.base.up(file.rows.place(y))];
      for (const [colour, radius] of [["#FFFFFF", 3.2], ["#000000", 2.2]]) {
        pen.fillStyle = colour;
        fillMark(pen, "dot", ...at, radius * this.base.letter);
      }
    }
  }
  // Writes z at the middle of the longest visible curves, where space permits.
  #drawNames(pen) {
    const { left, top, width, height } = this.base.area;
    const seen = ([x, y]) => x > left && x < left + width && y > top && y < top + height;
    const ways = curves.list.map((curve, number) => ({ curve, way: this.#way(number).filter(seen) }));
    const names = ways.sort((a, b) => b.way.length - a.way.length).slice(0, MOST_CURVE_NAMES);
    const taken = [];
    this.base.write(11);
    pen.textAlign = "center";
    pen.textBaseline = "middle";
    for (const { curve: { kind, impacts, period }, way } of names) {
      const at = way[way.length >> 1];
      if (!at || taken.some(([x, y]) => Math.hypot(x - at[0], y - at[1]) < NAMES_APART * this.base.letter)) continue;
      taken.push(at);
      pen.strokeStyle = "#FFFFFF";
      pen.lineWidth = 3.5 * this.base.letter;
      const name = impacts === 0 ? "no impact" : `${impacts}/${period}`;
      pen.strokeText(name, ...at);
      pen.fillStyle = content.curves.kinds[kind].colour;
      pen.fillText(name, ...at);
    }
  }
  // {curve, point} of the nearest curve, or else the cell.
  targetAt(event) {
    return this.#edgeAt(event) ?? super.targetAt(event);
  }
  #edgeAt(event) {
    const at = this.base.area && this.base.valuesAt(event);
    if (!at || this.hides()) return null;
    const here = [this.base.across(at[0]), this.base.up(at[1])];
    let [nearest, found] = [CURVE_NEAR * this.base.letter, null];
    curves.list.forEach((_, curve) => {
      const way = this.#way(curve);
      way.forEach((to, point) => {
        const before = way[Math.max(point - 1, 0)];
        const [distance, share] = fromSegment(here, before, to);
        if (distance < nearest) [nearest, found] = [distance, { curve, point: share < 0.5 ? Math.max(point - 1, 0) : point }];
      });
    });
    return found;
  }
  drawMarks() {
    super.drawMarks();
    if (this.hover?.curve === undefined) return;
    this.top.clipped((pen) => {
      const { kind } = curves.list[this.hover.curve];
      this.#stroke(this.top, pen, this.hover.curve, "#FFFFFF", 6, []);
      this.#stroke(this.top, pen, this.hover.curve, content.curves.kinds[kind].colour, 3.2, []);
    });
  }
}

// Distance of a point from the segment between two others, and the relative position of its foot along the segment.
function fromSegment([x, y], [x0, y0], [x1, y1]) {
  const [dx, dy] = [x1 - x0, y1 - y0];
  const square = dx * dx + dy * dy;
  const share = square > 0 ? Math.min(Math.max(((x - x0) * dx + (y - y0) * dy) / square, 0), 1) : 1;
  return [Math.hypot(x - x0 - share * dx, y - y0 - share * dy), share];
}
