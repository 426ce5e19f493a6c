// The program's own engine in WebAssembly: src/page/interface.hpp names its functions and the order of its numbers.

const CELL_NUMBERS = [
  "mass_kg", "natural_frequency_hz", "stiffness_n_per_m", "damping_ns_per_m", "damping_ratio",
  "cubic_stiffness_n_per_m3", "cubic_form", "amplitude_m", "contact_law", "contact_first", "contact_second",
  "contact_third", "max_cycles", "max_period", "chaos_cycles", "engine_choice", "tolerance", "omit_tolerance",
  "frequency_ratio", "gap_ratio", "displacement_ratio", "velocity_ratio",
];
const ANSWER_NUMBERS = [
  "regime", "status", "engine", "impacts", "period", "cycles", "peak_force_ratio", "impact_rate", "chatter", "lyapunov",
  "sensitivity", "impact_speed", "impulse", "contact_time", "contact_power_w", "max_displacement", "orbit_displacement",
  "orbit_velocity", "length_m", "frequency_rad_per_s", "force_n", "weight_n",
];

const FIRST_INTEGRATOR = 2; // of the numbers of engines
const NO_REGIME = -128;

// What a list of cells is solved for: these numbers of each.
const LISTED_NUMBERS = ["regime", "impacts", "period", "peak_force_ratio", "engine", "orbit_displacement", "orbit_velocity"];

// A cell with `hertz`, its natural frequency, and with frequency, gap and start
// as ratios; values given in SI units are converted for the cell's own rig.
function settled(cell) {
  const hertz = cell.natural_frequency_hz ?? Math.sqrt(cell.stiffness_n_per_m / cell.mass_kg) / (2 * Math.PI);
  const metres = cell.amplitude_m;
  const units = { frequency: ["hz", hertz], gap: ["m", metres], displacement: ["m", metres],
    velocity: ["m_per_s", 2 * Math.PI * hertz * metres] };
  const ratios = Object.entries(units).flatMap(([name, [unit, one]]) => {
    const value = cell[`${name}_${unit}`];
    return value === null || value === undefined ? [] : [[`${name}_ratio`, value / one]];
  });
  return { ...cell, hertz, ...Object.fromEntries(ratios) };
}

// The change of a cell when an axis, {sets, clears}, takes a value.
function changeOf(axis, value) {
  return { ...Object.fromEntries(axis.clears.map((name) => [name, null])), [axis.sets]: value };
}

// A settled cell from another start at forcing phase 0: u in A0, its rate in
// A0 omega. There x = u, and x' = u' + eta; no start lies inside a rigid stop.
function startingAt(cell, u, v) {
  const rigid = cell.contact_law === 1;
  return { ...cell, displacement_m: null, velocity_m_per_s: null,
    displacement_ratio: rigid ? Math.min(u, cell.gap_ratio) : u, velocity_ratio: v + cell.frequency_ratio };
}

class Engine {
  // Stubs of the C library's output calls, which the engine does not need.
  static async from(bytes) {
    const nothing = () => 0;
    const wasi = { fd_close: nothing, fd_seek: nothing, fd_write: nothing };
    const { instance } = await WebAssembly.instantiate(bytes, { wasi_snapshot_preview1: wasi });
    instance.exports._initialize();
    return new Engine(instance.exports);
  }
  constructor(functions) {
    this.functions = functions;
  }
  // A cell: an object of CELL_NUMBERS, null for numbers not given.
  begin(cell, measures) {
    const numbers = this.#numbers(this.functions.peterka_cell(), CELL_NUMBERS.length);
    CELL_NUMBERS.forEach((name, place) => (numbers[place] = cell[name] ?? NaN));
    this.functions.peterka_begin(measures ? 1 : 0);
  }
  // True once the cell is solved; 0 cycles: run to the end.
  advance(cycles) {
    return this.functions.peterka_advance(cycles) === 1;
  }
  // Of a cell that the program would go on with in an integrator, which the page hasn't, nothing is told: regime NOT_COMPUTED.
  answer() {
    const numbers = this.#numbers(this.functions.peterka_answer(), ANSWER_NUMBERS.length);
    const answer = Object.fromEntries(ANSWER_NUMBERS.map((name, place) => [name, numbers[place]]));
    return answer.engine >= FIRST_INTEGRATOR ? { ...answer, regime: NO_REGIME, impacts: 0, period: 0, peak_force_ratio: NaN } : answer;
  }
  points() {
    const count = this.functions.peterka_count_points();
    return this.#numbers(this.functions.peterka_points(), 2 * count).slice();
  }
  // The transient from the cell's start, or the steady motion: samples (tau, cart, x - y, its rate, force), impacts (touch, end,
  // speed, peak force, time in contact), points at the end of each cycle.
  follow(steady, cycles, samples) {
    const followed = this.functions.peterka_follow(steady ? 1 : 0, cycles, samples);
    const impacts = this.functions.peterka_count_impacts();
    return {
      cycles: followed,
      samples: this.#samples(),
      impacts: this.#numbers(this.functions.peterka_impacts(), 5 * impacts).slice(),
      points: this.points(),
      multipliers: this.#numbers(this.functions.peterka_multipliers(), 4).slice(),
    };
  }
  lookClosely(impact, samples) {
    this.functions.peterka_look_closely(impact, samples);
    return this.#samples();
  }
  #samples() {
    return this.#numbers(this.functions.peterka_samples(), 5 * this.functions.peterka_count_samples()).slice();
  }
  #numbers(address, count) {
    return new Float64Array(this.functions.memory.buffer, address, count);
  }
}
