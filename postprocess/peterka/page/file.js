// The file's contents, and how the page queries them.

const content = JSON.parse(document.getElementById("content").textContent);
const [NO_IMPACT, PERIODIC, CHAOTIC, SUSTAINED_CONTACT, UNRESOLVED, FAILED, NOT_COMPUTED] = [0, 1, 2, 3, 4, 5, -128];

const blobOf = (number) => {
  const element = document.getElementById(`blob-${number}`);
  const text = element.textContent;
  element.remove(); // megabytes that are no longer needed
  return unpacked(text);
};

// Whether forces and lengths are told in N and mm first, as the job gives its coordinates in SI units.
const leadsInSi = content.in_si.length > 0;

// Ratios along one side. `place` is linear on the screen: the ratio or its logarithm. Cells extend half-way to their neighbours.
class Axis {
  // `factor` of the description: from the values to Hz, mm or mm/s; null if the file does not give it.
  constructor(description) {
    Object.assign(this, description, { leadsInSi: content.in_si.includes(description.name) });
    const places = this.values.map((value) => this.place(value));
    const last = places.length - 1;
    this.edges = new Float64Array(places.length + 1);
    for (let i = 1; i <= last; ++i) this.edges[i] = (places[i - 1] + places[i]) / 2;
    this.edges[0] = 2 * places[0] - this.edges[1];
    this.edges[last + 1] = 2 * places[last] - this.edges[last];
    if (["frequency_ratio", "frequency_hz"].includes(this.name) && !this.log) this.edges[0] = Math.max(this.edges[0], 0);
  }
  // Width of three cells, as places.
  get narrowest() {
    return (3 * (this.edges.at(-1) - this.edges[0])) / this.values.length;
  }
  place(value) {
    return this.log ? Math.log(value) : value;
  }
  value(place) {
    return this.log ? Math.exp(place) : place;
  }
  // The cell at a place, -1 outside.
  cell(place) {
    const edges = this.edges;
    if (!(place >= edges[0] && place <= edges.at(-1))) return -1;
    let low = 0;
    let high = edges.length - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (edges[middle] <= place) low = middle;
      else high = middle;
    }
    return low;
  }
}

// A map's cells lie in rows and columns; for a sweep the rows are its tracks, branches first, and the cells their points.
const rowCount = content.rows?.values.length ?? content.tracks.length;

const file = {
  columns: new Axis(content.columns),
  rows: content.rows ? new Axis(content.rows) : null,
  rowCount,
  // Rows over which shares are computed.
  toldRows: content.branches ?? rowCount,
  // The numbers of a cell that both axes, or a sweep's axis and a branch's gap, set and clear.
  sides: [content.columns, content.rows ?? content.gap].filter(Boolean).map(({ sets, clears }) => ({ sets, clears })),
  labels: null, // index of each cell's label
  // `first`: row at which a layer begins; `samples`: numbers per cell.
  layers: content.layers.map((layer) => ({ first: 0, rows: rowCount, samples: 1, ...layer, plane: null })),
  isBasin: content.kind === "basin",

  async loadLabels() {
    const { plane, blob } = content.labels;
    this.labels = planeOf(plane, await blobOf(blob), this.columns.values.length);
    if (this.layer("computed")) await this.loadLayer(this.layer("computed"));
  },
  async loadLayer(layer) {
    layer.loading ??= blobOf(layer.blob).then((bytes) => {
      layer.plane = planeOf(content.layers[this.layers.indexOf(layer)].plane, bytes, this.columns.values.length);
    });
    await layer.loading;
  },
  index(row, column) {
    return row * this.columns.values.length + column;
  },
  holds(row, column) {
    return row >= 0 && column >= 0 && row < this.rowCount && column < this.columns.values.length;
  },
  // [regime, impacts, period, class]
  label(row, column) {
    return content.labels.table[this.labels.at(this.index(row, column))];
  },
  // As stored in the file.
  value(row, column) {
    if (!this.holds(row, column)) throw new RangeError(`the ${content.kind} has no cell in row ${row}, column ${column}`);
    const [regime, impacts, period] = this.label(row, column);
    const filled = this.number("computed", row, column) === 0; // from the cells around it, in a refined map
    return { regime, impacts, period, filled, peak_force_ratio: this.number("peak_force_ratio", row, column), row, column };
  },
  // What is proved about a cell [certified, lower, upper, in what unit], or why nothing is [reason in words]; null where
  // nothing was tried or the file has no proofs, or only shortened ones. Loads what it needs.
  async proof(row, column) {
    const layers = ["certified", "peak_force_lower_ratio", "peak_force_upper_ratio", "impact_speed_lower", "impact_speed_upper"]
      .map((name) => this.layer(name)).filter(Boolean);
    if (!layers.length || content.layers.some(({ name, plane }) => name === "peak_force_lower_ratio" && plane.as !== "reals")) return null;
    await Promise.all(layers.map((layer) => this.loadLayer(layer)));
    const certified = this.number("certified", row, column);
    if (!(certified > 0)) return certified < 0 ? { reason: this.layer("certified").words?.[certified]?.replaceAll("_", " ") } : null;
    const speed = this.number("impact_speed_upper", row, column) > 0;
    const [lower, upper] = ["lower", "upper"].map((side) => this.number(speed ? `impact_speed_${side}` : `peak_force_${side}_ratio`, row, column));
    const factor = speed ? 1000 : content.newtons ?? 1;
    return { fromStart: certified > 1, lower: lower * factor, upper: upper * factor, unit: speed ? "mm/s" : content.newtons ? "N" : "m g" };
  },
  // What the drawn rigs of a cell end in, the commonest first, as [{regime, impacts, period, probability}, ...]; [] in a file
  // without them, or of which they aren't loaded.
  outcomes(row, column) {
    const parts = ["regime", "impacts", "period", "probability"];
    const found = [];
    for (let slot = 0; this.layer(`outcome_regime[${slot}]`); ++slot) {
      const one = Object.fromEntries(parts.map((part) => [part, this.number(`outcome_${part}[${slot}]`, row, column)]));
      if (one.probability > 0) found.push(one);
    }
    return found;
  },
  async loadOutcomes() {
    await Promise.all(this.layers.filter(({ name }) => /^outcome_\w+\[/.test(name)).map((layer) => this.loadLayer(layer)));
  },
  layer(name) {
    return this.layers.find((one) => one.name === name);
  },
  number(name, row, column, sample = 0) {
    const layer = this.layer(name);
    const own = layer?.plane && row >= layer.first && row < layer.first + layer.rows;
    return own ? layer.plane.at(this.index(row - layer.first, column) * layer.samples + sample) : NaN;
  },
};

const classIndex = Object.fromEntries(content.classes.map((one, number) => [one.label, number]));
const classOfOrbit = new Map(
  content.classes.flatMap((one, number) => (one.orbit ? [[one.orbit.join("/"), number]] : [])),
);

// The class of a cell, as in classes.py, and as displayed for the file's own cells of that class.
function classOf(regime, impacts, period) {
  if (regime === PERIODIC) return content.labels.shown[classOfOrbit.get(`${impacts}/${period}`) ?? classIndex["other p/q"]];
  const names = {
    [NO_IMPACT]: "no impact", [CHAOTIC]: "chaotic", [SUSTAINED_CONTACT]: "sustained contact",
    [UNRESOLVED]: "unresolved", [FAILED]: "failed", [NOT_COMPUTED]: "not computed yet",
  };
  return classIndex[names[regime]];
}

// z = p/q if there is one, otherwise the regime, as words.
function labelWords(regime, impacts, period) {
  if (regime === PERIODIC) return `z = ${impacts}/${period}`;
  return content.classes[classOf(regime, impacts, period)].label;
}
