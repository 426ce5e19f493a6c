// The legend of the layer shown: classes and words with their shares, or a colour scale.

// What is told in SI units, "" or null if it can't be, and as a ratio: the job's own unit first.
const inOrder = (si, ratio, first = leadsInSi) => (first ? [si, ratio] : [ratio, si]).filter(Boolean);

const BEYOND_LABEL = "beyond the page’s engine";

// tally: counts of a live map, whose shares replace the file's.
function drawLegend(parent, layer, tally = undefined) {
  parent.replaceChildren();
  const beyond = tally?.beyond > 0 ? [{ label: BEYOND_LABEL, colour: NO_VALUE_COLOUR, share: tally.beyond / tally.all }] : [];
  if (tally && !isLive(layer)) {
    parent.append(Object.assign(document.createElement("div"), { className: "about", textContent: `A live map has z instead of ${layer.title}.` }));
  }
  if (layer.name === "z" || (tally && !isLive(layer))) return entriesInto(parent, [...classEntries(tally?.kinds, tally?.all), ...beyond]);
  if (layer.name === "regime") return entriesInto(parent, [...regimeEntries(tally?.kinds, tally?.all), ...beyond]);
  if (layer.name === "commonest") return entriesInto(parent, classEntries(kindCounts(commonestKinds())));
  if (isWords(layer)) return entriesInto(parent, wordEntries(layer));
  const bar = Object.assign(document.createElement("div"), { className: "bar" });
  bar.style.background = `linear-gradient(to right, ${scaleOf(layer).filter((_, i) => i % 15 === 0).join(", ")})`;
  const scale = Object.assign(document.createElement("div"), { className: "scale" });
  const newtons = (layer.over_weight && content.newtons) || null;
  const first = newtons && leadsInSi ? newtons : 1; // of the unit whose ticks are round
  for (const value of ticksBetween(layer.low * first, layer.top * first, 5).values) scale.append(tickOf(layer, value / first, newtons));
  const about = Object.assign(document.createElement("div"), { className: "about", textContent: aboutLayer(layer) });
  const others = tally ? [...classEntries(tally.apart, tally.all), ...noValue(layer, tally.forceless / tally.all), ...beyond]
    : [...classEntries(apartCounts(layer), toldCells), ...withoutValue(layer)];
  const hasValues = others.reduce((sum, one) => sum + one.share, 0) < 1 - 1e-9; // otherwise the scale's ends are of nothing
  parent.append(about, ...(hasValues ? [bar, scale] : []));
  entriesInto(parent, others);
}

function tickOf(layer, value, newtons) {
  const tick = document.createElement("span");
  tick.style.left = `${(100 * (value - layer.low)) / (layer.top - layer.low)}%`;
  tick.textContent = inOrder(newtons && `${digits(value * newtons, 3)} N`, digits(value, 3)).join("\n");
  return tick;
}

// Its unit after its name, or after what it is.
const inUnit = (words, layer) => (layer.unit && layer.unit !== "1" ? `${words} (${layer.unit})` : words);

const aboutLayer = (layer) => (layer.over_weight && content.newtons
  ? `${layer.title} (${inOrder("N", "weights of the hammer").join(", ")})` : inUnit(layer.about || layer.title, layer));

// share: null of a sweep's attractors that no branch visits.
function entriesInto(parent, entries) {
  const list = Object.assign(document.createElement("ul"), { className: "entries" });
  for (const { label, colour, share: part, number: kind } of entries) {
    const entry = document.createElement("li");
    const patch = Object.assign(document.createElement("i"), { className: label === "not computed yet" ? "hatched" : "" });
    if (label !== "not computed yet") patch.style.background = colour;
    entry.append(patch, document.createTextNode(`${label} `), Object.assign(document.createElement("small"), { textContent: part === null ? "on no branch" : percent(part) }));
    entry.dataset.number = kind;
    list.append(entry);
  }
  parent.append(list);
}

// Branch marks and their descriptions: [shape, words].
function marksInto(parent, marks) {
  const list = Object.assign(document.createElement("ul"), { className: "entries" });
  for (const [shape, words] of marks) {
    const entry = document.createElement("li");
    entry.append(Object.assign(document.createElement("b"), { textContent: { up: "▲", down: "▼" }[shape] ?? (shape === "known" ? "·" : "●") }), document.createTextNode(` ${words}`));
    list.append(entry);
  }
  parent.append(list);
}

const NEARLY_BLACK = ["#000000", "#1A1A1A"];

// Line styles of curves and their descriptions: {words, colour, dash}.
function linesInto(parent, lines) {
  const list = Object.assign(document.createElement("ul"), { className: "entries" });
  for (const { words, colour, dash } of lines) {
    const entry = document.createElement("li");
    const line = Object.assign(document.createElement("i"), { className: "line" });
    line.style.borderTopColor = NEARLY_BLACK.includes(colour) ? "currentColor" : colour; // visible in both themes
    line.style.borderTopStyle = dash.length === 0 ? "solid" : dash[0] > 2 ? "dashed" : "dotted";
    entry.append(line, document.createTextNode(words));
    list.append(entry);
  }
  parent.append(list);
}
