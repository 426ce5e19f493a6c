// The sliders: numbers of the rig for which a live map is computed, and the place of the selected cell.

class Rig {
  // changed(kind): "rig" for sliders of the rig, "place" for sliders of the axes.
  constructor(parent, changed) {
    this.changed = changed;
    this.changes = {}; // relative to the file's cell numbers
    const axes = new Set(file.sides.flatMap(({ sets, clears }) => [sets, ...clears]));
    const others = [...rigSliders(), ...placeSliders()].filter(({ name, twin }) => !axes.has(name) && !axes.has(twin));
    const onAxes = file.isBasin ? [] : [file.columns, file.rows].map(axisSlider);
    this.sliders = [...others, ...onAxes].map((slider) => new Slider(parent, slider, (value) => {
      Object.assign(this.changes, slider.change(value));
      changed(slider.kind);
    }));
  }
  get cell() {
    return settled({ ...content.cell, ...this.changes });
  }
  get differs() {
    return this.sliders.some((slider) => slider.moved && slider.kind === "rig");
  }
  reset() {
    for (const slider of this.sliders.filter((one) => one.kind === "rig")) slider.reset();
    const kept = file.sides.flatMap(({ sets, clears }) => [sets, ...clears]);
    this.changes = Object.fromEntries(Object.entries(this.changes).filter(([name]) => kept.includes(name)));
    this.changed("rig");
  }
  // Moves the sliders to a picked place: [across, up].
  setPlace(values) {
    file.sides.forEach((side, n) => {
      Object.assign(this.changes, changeOf(side, values[n]));
      for (const slider of this.sliders) if (slider.name === side.sets) slider.set(values[n]);
    });
  }
  // [across, up] of the cell.
  get place() {
    const { cell } = this;
    return file.sides.map(({ sets }) => cell[sets]);
  }
  // For the address.
  values() {
    return this.sliders.filter((one) => one.kind === "rig" && one.moved).map((one) => [one.name, one.value]);
  }
  takes(name, value) {
    const slider = this.sliders.find((one) => one.name === name && one.kind === "rig");
    const slack = 1e-6; // addresses have nine digits
    return slider !== undefined && value >= slider.from * (1 - slack) && value <= slider.to * (1 + slack);
  }
  take(name, value) {
    if (!this.takes(name, value)) return;
    const slider = this.sliders.find((one) => one.name === name && one.kind === "rig");
    slider.set(value);
    Object.assign(this.changes, slider.change(slider.value));
  }
}

function rigSliders() {
  const cell = content.cell;
  const number = (name, label, unit, low, high) => ({
    kind: "rig", name, label, unit, log: cell[name] > 0, from: cell[name] > 0 ? cell[name] / low : 0,
    to: cell[name] > 0 ? cell[name] * high : 1e4, value: cell[name], change: (value) => ({ [name]: value }),
  });
  const hasRatio = content.damping_ratio !== null || cell.damping_ns_per_m === null; // one that is common to all cells
  const damping = !hasRatio ? number("damping_ns_per_m", "spring damping", "Ns/m", 100, 100) : {
    kind: "rig", name: "damping_ratio", label: "damping ratio", unit: "", log: true, from: 1e-4, to: 0.5,
    value: content.damping_ratio ?? cell.damping_ratio, change: (value) => ({ damping_ratio: value, damping_ns_per_m: null }),
  };
  if (cell.contact_law === 1) {
    return [{
      kind: "rig", name: "contact_first", label: "restitution of the stop", unit: "", from: 0, to: 1,
      value: cell.contact_first, change: (value) => ({ contact_first: value }),
    }, damping];
  }
  if (cell.contact_law === 2) return [];
  return [number("contact_first", "stop stiffness", "N/m", 1000, 100), number("contact_second", "stop damping", "Ns/m", 100, 10), damping];
}

// Slider of a map's axis, within its range.
function axisSlider(axis) {
  const [first, last] = [axis.values[0], axis.values.at(-1)];
  const from = axis.sets.startsWith("frequency") ? Math.max(first, 0.05 * (axis.sets === "frequency_ratio" ? 1 : last)) : first;
  return {
    kind: "place", name: axis.sets, label: axis.about.replace("excitation ", ""), log: axis.log, from, to: last,
    unit: !axis.factor && axis.unit && axis.name.endsWith("_ratio") ? axis.symbol : axis.unit, // that of a ratio is what it is over
    factor: axis.factor ?? 1, value: axis.log ? Math.sqrt(from * last) : (from + last) / 2, change: (value) => changeOf(axis, value),
  };
}

// Frequency and gap common to all cells, in Hz and mm if the file gives them.
function placeSliders() {
  const { hertz, amplitude_m: amplitude, cell } = content;
  const slider = (ratio, si, label, factor, unit, siFactor, siUnit) => {
    const inSi = (cell[ratio] ?? null) === null && (cell[si] ?? null) !== null;
    const [name, value] = inSi ? [si, cell[si]] : [ratio, content.place[ratio] ?? cell[ratio] ?? 1];
    return { kind: "rig", name, twin: inSi ? ratio : si, label, unit: inSi ? siUnit : unit, factor: inSi ? siFactor : factor,
      from: ratio === "frequency_ratio" ? Math.max(0.25 * value, inSi ? 0 : 0.05) : 0, to: Math.max(2 * value, inSi ? 0 : 1), value,
      change: (one) => ({ [name]: one }) };
  };
  const gap = slider("gap_ratio", "gap_m", "gap", amplitude ? 1000 * amplitude : 1, amplitude ? "mm" : "A₀", 1000, "mm");
  return [slider("frequency_ratio", "frequency_hz", "frequency", hertz ?? 1, hertz ? "Hz" : "Ω/ω", 1, "Hz"), gap];
}

const SLIDER_STEPS = 400;

class Slider {
  constructor(parent, description, changed) {
    Object.assign(this, { factor: 1, ...description });
    this.initial = this.value;
    this.moved = false;
    const row = document.createElement("label");
    row.className = "slider";
    this.input = Object.assign(document.createElement("input"), { type: "range", min: 0, max: SLIDER_STEPS, step: 1 });
    this.input.id = `slider-${this.name}`;
    const name = Object.assign(document.createElement("span"), { textContent: this.label });
    this.output = document.createElement("output");
    row.append(name, this.input, this.output);
    parent.append(row);
    this.set(this.value);
    this.moved = false;
    this.input.addEventListener("input", () => {
      this.value = this.#valueAt(Number(this.input.value) / SLIDER_STEPS);
      this.moved = true;
      this.#write();
      changed(this.value);
    });
  }
  set(value) {
    this.value = value;
    this.moved = value !== this.initial;
    const share = this.log ? Math.log(value / this.from) / Math.log(this.to / this.from) : (value - this.from) / (this.to - this.from);
    this.input.value = Math.round(SLIDER_STEPS * Math.min(Math.max(share, 0), 1));
    this.#write();
  }
  reset() {
    this.set(this.initial);
  }
  #valueAt(share) {
    return this.log ? this.from * (this.to / this.from) ** share : this.from + share * (this.to - this.from);
  }
  #write() {
    this.output.textContent = `${digits(this.value * this.factor, 3)}${this.unit ? ` ${this.unit}` : ""}`;
    this.input.setAttribute("aria-valuetext", this.output.textContent);
  }
}
