// Colours of cells, as in the pictures of draw.py: for classes, for numbers, and for a file's own words.

const abgr = (colour) => {
  const [red, green, blue] = [1, 3, 5].map((from) => parseInt(colour.slice(from, from + 2), 16));
  return ((255 << 24) | (blue << 16) | (green << 8) | red) >>> 0;
};
const CLASS_COLOURS = Uint32Array.from(content.classes, (one) => abgr(one.colour));
const scaleOf = (layer) => (layer.diverging ? content.diverging : content.viridis);
const NO_VALUE_COLOUR = content.no_value;
const MISSING = classIndex["not computed yet"];
const [HATCH, BARE] = [abgr("#B4B4B4"), abgr("#FFFFFF")];

function shade(colour, repeat) {
  const [weight, towards] = content.shades[repeat % content.shades.length]; // brightness mixed into a colour
  const parts = [1, 3, 5].map((from) => parseInt(colour.slice(from, from + 2), 16));
  return `#${parts.map((part) => Math.round((1 - weight) * part + weight * towards).toString(16).padStart(2, "0")).join("")}`;
}

const PERIODIC_COLOUR = "#0072B2";
const REGIME_COLOURS = content.classes.map((one) => (one.orbit ? PERIODIC_COLOUR : one.colour));
REGIME_COLOURS[classIndex["other p/q"]] = PERIODIC_COLOUR; // one colour for all periodic cells

// A layer paints rows of pixels: paint(out, from, firstCell, columnOfPixel, y), where columnOfPixel is -1 outside. This painter
// uses the class of each cell.
function classPainter(of_class = content.classes.map((one) => one.colour)) {
  const { raw } = file.labels;
  const colours = Uint32Array.from(content.labels.table, ([, , , number]) => abgr(of_class[number]));
  const missing = content.labels.table.map(([, , , number]) => number === MISSING);
  const some = missing.some((one) => one);
  return (out, from, first, columns, y) => {
    for (let x = 0; x < columns.length; ++x) {
      const label = columns[x] < 0 ? -1 : raw[first + columns[x]];
      out[from + x] = label < 0 ? 0 : some && missing[label] ? hatched(x, y) : colours[label];
    }
  };
}

const hatched = (x, y) => ((x + y) % 9 < 2 ? HATCH : BARE);

// Cells without a value, or without a meaningful one, keep the colour of their class.
const APART = content.apart.map((one) => classIndex[one]);
// The regime of the job's own rig says nothing of what rigs drawn do.
const isOfDraws = (layer) => /^(force_q\d\d_ratio|speed_q\d\d|outcome)/.test(layer.name);
const apartOf = (layer) => (isOfDraws(layer) ? [MISSING] : APART);

const isNoNumber = (layer, value) => Number.isNaN(value) || (layer.never !== undefined && value < 0);
// Whether a cell of a class that is set apart keeps its colour.
const isApart = (layer, kind, value) => apartOf(layer).includes(kind) && !(value > 0);

function numberPainter(layer) {
  const { raw } = file.labels;
  const kinds = content.labels.table.map(([, , , number]) => number);
  const none = abgr(NO_VALUE_COLOUR);
  const colours = Uint32Array.from(scaleOf(layer), abgr);
  const last = colours.length - 1;
  const step = last / (layer.top - layer.low);
  return (out, from, first, columns, y) => {
    for (let x = 0; x < columns.length; ++x) {
      if (columns[x] < 0) {
        out[from + x] = 0;
        continue;
      }
      const cell = first + columns[x];
      const label = raw[cell];
      const value = layer.plane.at(cell);
      if (kinds[label] === MISSING) out[from + x] = hatched(x, y);
      else if (isApart(layer, kinds[label], value)) out[from + x] = CLASS_COLOURS[kinds[label]];
      else if (isNoNumber(layer, value)) out[from + x] = none;
      else out[from + x] = colours[Math.max(0, Math.min(last, Math.round((value - layer.low) * step)))];
    }
  };
}

// Of a layer of numbers: cells of each class that keep its colour.
function apartCounts(layer) {
  const kinds = content.labels.table.map(([, , , number]) => number);
  const counts = new Array(content.classes.length).fill(0);
  for (let cell = 0; cell < toldCells; ++cell) {
    const kind = kinds[file.labels.raw[cell]];
    if (isApart(layer, kind, layer.plane.at(cell))) ++counts[kind];
  }
  return counts;
}

// Of a layer of numbers: {label, colour, share} of cells that have none and keep no colour of their class; [] if there are no such cells.
function withoutValue(layer) {
  const kinds = content.labels.table.map(([, , , number]) => number);
  let count = 0;
  for (let cell = 0; cell < toldCells; ++cell) {
    const value = layer.plane.at(cell);
    if (isNoNumber(layer, value) && !isApart(layer, kinds[file.labels.raw[cell]], value)) ++count;
  }
  return noValue(layer, share(count));
}
const noValue = (layer, part) => (part > 0 ? [{ label: layer.never ?? "no value", colour: NO_VALUE_COLOUR, share: part }] : []);

// One colour per word or attractor number.
function wordPainter(layer, entries) {
  const { raw } = file.labels;
  const missing = content.labels.table.map(([, , , number]) => number === MISSING);
  const colours = new Map(entries.map(({ number, colour }) => [number, abgr(colour)]));
  const other = abgr(NO_VALUE_COLOUR);
  return (out, from, first, columns, y) => {
    for (let x = 0; x < columns.length; ++x) {
      if (columns[x] < 0) out[from + x] = 0;
      else if (missing[raw[first + columns[x]]]) out[from + x] = hatched(x, y);
      else out[from + x] = colours.get(layer.plane.at(first + columns[x])) ?? other;
    }
  };
}

// The class of each cell's commonest outcome; -1 where nothing is computed.
function commonestKinds() {
  const [regime, impacts, period, probability] = ["regime", "impacts", "period", "probability"].map((part) => file.layer(`outcome_${part}[0]`).plane);
  return Int16Array.from({ length: toldCells }, (_, cell) => (probability.at(cell) > 0 ? classOf(regime.at(cell), impacts.at(cell), period.at(cell)) : -1));
}

// One colour per class of these.
function kindPainter(kinds) {
  return (out, from, first, columns, y) => {
    for (let x = 0; x < columns.length; ++x) {
      if (columns[x] < 0) out[from + x] = 0;
      else out[from + x] = kinds[first + columns[x]] < 0 ? hatched(x, y) : CLASS_COLOURS[kinds[first + columns[x]]];
    }
  };
}

const isWords = (layer) => layer.words !== undefined || layer.name === "attractor";
const CATEGORY_COLOURS = ["#F2F2F2", "#0072B2", "#E69F00", "#009E73", "#CC79A7", "#D55E00", "#56B4E9", "#F0E442"];

// {number, label, colour} of each word that occurs in a layer; cells without one come last.
function wordEntries(layer) {
  if (layer.name === "attractor") return attractorEntries(layer);
  const missing = fileCounts()[MISSING];
  const counts = countsOf(layer.plane, undefined, (cell) => content.labels.table[file.labels.at(cell)][3] !== MISSING);
  const entries = Object.entries(layer.words).filter(([number]) => counts.has(Number(number)))
    .map(([number, word], place) => ({
      number: Number(number), label: word.replaceAll("_", " "), share: share(counts.get(Number(number))),
      colour: CATEGORY_COLOURS[place % CATEGORY_COLOURS.length],
    }));
  const rest = 1 - share(missing) - entries.reduce((sum, one) => sum + one.share, 0);
  return [...entries, ...noValue(layer, rest > 1e-9 ? rest : 0), ...(missing > 0 ? [{ ...content.classes[MISSING], number: MISSING, share: share(missing) }] : [])];
}

// Attractors of a class in shades of its colour, as in draw.py; -1: none.
function attractorEntries(layer) {
  const firsts = new Map();
  const counts = countsOf(layer.plane, (number, cell) => firsts.set(number, cell));
  const seen = new Map();
  return [...counts.keys()].sort((a, b) => a - b).map((number) => {
    const [regime, p, q, kind] = content.labels.table[file.labels.at(firsts.get(number))];
    const { colour } = content.classes[kind];
    const repeat = seen.get(colour) ?? 0;
    if (number >= 0) seen.set(colour, repeat + 1);
    const label = number < 0 ? "no attractor" : `${number}: ${labelWords(regime, p, q)}`;
    return { number, label, share: share(counts.get(number)), colour: number < 0 ? NO_VALUE_COLOUR : shade(colour, repeat) };
  });
}

function countsOf(plane, first = () => {}, told = () => true) {
  const counts = new Map();
  for (let cell = 0; cell < toldCells; ++cell) {
    if (!told(cell)) continue;
    const number = plane.at(cell);
    const count = counts.get(number);
    if (count === undefined) first(number, cell);
    counts.set(number, (count ?? 0) + 1);
  }
  return counts;
}

const toldCells = file.toldRows * file.columns.values.length;
const share = (count) => count / toldCells;

// Number of cells of each class in the file.
function fileCounts() {
  const counts = new Array(content.classes.length).fill(0);
  const { raw } = file.labels;
  const table = content.labels.table;
  const labels = new Array(table.length).fill(0);
  for (let cell = 0; cell < toldCells; ++cell) ++labels[raw[cell]];
  labels.forEach((count, label) => (counts[table[label][3]] += count));
  return counts;
}

function kindCounts(kinds) {
  const counts = new Array(content.classes.length).fill(0);
  for (const kind of kinds) ++counts[kind < 0 ? MISSING : kind];
  return counts;
}

// {label, colour, share} of each class that occurs, in the file or in other counts.
function classEntries(counts = fileCounts(), all = counts.reduce((sum, one) => sum + one, 0) || 1) {
  return content.classes.map((one, number) => ({ number, ...one, share: counts[number] / all })).filter((one) => one.share > 0);
}

// The same with all periodic cells merged.
function regimeEntries(counts, all) {
  const entries = classEntries(counts, all);
  const periodic = entries.filter(({ number }) => REGIME_COLOURS[number] === PERIODIC_COLOUR);
  const others = entries.filter((one) => !periodic.includes(one));
  const part = periodic.reduce((sum, one) => sum + one.share, 0);
  return part > 0 ? [{ label: "periodic", colour: PERIODIC_COLOUR, share: part }, ...others] : others;
}

// 0 % and 100 % only if exact; otherwise rounded as in the program's summary.
function percent(part) {
  const value = 100 * part;
  const text = `${value.toFixed(1)} %`;
  if (value > 0 && text === "0.0 %") return "< 0.05 %";
  return value < 100 && text === "100.0 %" ? "> 99.95 %" : text;
}
