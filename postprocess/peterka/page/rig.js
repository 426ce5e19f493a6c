// The sliders: numbers of the rig that a live map is computed for, and the place of the cell that is looked at.

class Rig {
  // changed(kind): "rig" for the sliders of the rig, "place" for frequency and gap.
  constructor(parent, changed) {
    this.changed = changed;
    this.changes = {}; // of the file's cell numbers
    this.sliders = [...rigSliders(), ...placeSliders()].map((slider) => new Slider(parent, slider, (value) => {
      Object.assign(this.changes, slider.change(value));
      changed(slider.kind);
    }));
  }
  get cell() {
    return { ...content.cell, ...this.changes };
  }
  get differs() {
    return this.sliders.some((slider) => slider.moved && (slider.kind === "rig" || file.isBasin));
  }
  reset() {
    for (const slider of this.sliders.filter((one) => one.kind === "rig" || file.isBasin)) slider.reset();
    const { frequency_ratio, gap_ratio } = this.changes;
    this.changes = file.isBasin ? {} : { frequency_ratio, gap_ratio };
    this.changed("rig");
  }
  // The sliders follow a picked cell.
  setPlace(values) {
    Object.assign(this.changes, values);
    for (const slider of this.sliders) if (values[slider.name] !== undefined) slider.set(values[slider.name]);
  }
  // For the address.
  values() {
    return this.sliders.filter((one) => one.kind === "rig" && one.moved).map((one) => [one.name, one.value]);
  }
  take(name, value) {
    const slider = this.sliders.find((one) => one.name === name && one.kind === "rig");
    if (!slider || !Number.isFinite(value)) return;
    slider.set(value);
    Object.assign(this.changes, slider.change(slider.value));
  }
}

function rigSliders() {
  const cell = content.cell;
  const damping = {
    kind: "rig", name: "damping_ratio", label: "damping ratio", unit: "", log: true, from: 1e-4, to: 0.5,
    value: content.damping_ratio, change: (value) => ({ damping_ratio: value, damping_ns_per_m: null }),
  };
  if (cell.contact_law === 1) {
    return [{
      kind: "rig", name: "contact_first", label: "restitution of the stop", unit: "", from: 0, to: 1,
      value: cell.contact_first, change: (value) => ({ contact_first: value }),
    }, damping];
  }
  if (cell.contact_law === 2) return [];
  const stop = (name, label, unit, low, high) => ({
    kind: "rig", name, label, unit, log: cell[name] > 0, from: cell[name] > 0 ? cell[name] / low : 0,
    to: cell[name] > 0 ? cell[name] * high : 1e4, value: cell[name], change: (value) => ({ [name]: value }),
  });
  return [stop("contact_first", "stop stiffness", "N/m", 1000, 100), stop("contact_second", "stop damping", "Ns/m", 100, 10), damping];
}

// In Hz and mm; for a map within its axes.
function placeSliders() {
  const { hertz, amplitude_m: amplitude } = content;
  const slider = (name, label, factor, unit) => {
    const axis = [file.columns, file.rows].find((one) => one.name === name);
    const middle = content.place[name] ?? content.cell[name] ?? 1;
    const [from, to] = axis ? [axis.values[0], axis.values.at(-1)] : [0.25 * middle, Math.max(2 * middle, 1)];
    return {
      kind: "place", name, label, unit, factor, from: name === "frequency_ratio" ? Math.max(from, 0.05) : Math.max(from, 0), to,
      value: axis ? (from + to) / 2 : middle, change: (value) => ({ [name]: value }),
    };
  };
  return [
    slider("frequency_ratio", "frequency", hertz ?? 1, hertz ? "Hz" : "Ω/ω"),
    slider("gap_ratio", "gap", amplitude ? 1000 * amplitude : 1, amplitude ? "mm" : "A₀"),
  ];
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
