// The engine's answers in words.

const number = (value, unit, count = 4) => (Number.isFinite(value) ? `${digits(value, count)}${unit ? ` ${unit}` : ""}` : "–");

const PREFIXES = [[1e-9, "n"], [1e-6, "µ"], [1e-3, "m"], [1, ""], [1e3, "k"], [1e6, "M"], [1e9, "G"]];

// With the prefix that keeps the number between 1 and 1000, as plotting/units.py has it.
function amount(value, unit, count = 4) {
  if (!Number.isFinite(value)) return number(value, unit, count);
  const size = Math.abs(Number(value.toPrecision(count))); // 999.96 is 1 k
  const [one, letter] = PREFIXES.findLast(([prefix]) => size >= prefix * (1 - 1e-12)) ?? (size > 0 ? PREFIXES[0] : [1, ""]);
  return number(value / one, `${letter}${unit}`, count);
}

// Bounds of a number, rounded outward to as many digits as tell them apart, 7 at most.
function between(lower, upper, unit) {
  const size = Math.floor(Math.log10(upper));
  const decimals = Math.min(Math.max(6 - size, 0), 12);
  const power = 10 ** decimals;
  const [from, to] = [Math.floor(lower * power * (1 - 1e-15)), Math.ceil(upper * power * (1 + 1e-15))];
  return `${(from / power).toFixed(decimals)} … ${(to / power).toFixed(decimals)} ${unit}`;
}

function timeWords(seconds) {
  if (!(seconds > 0)) return seconds === 0 ? "0 s" : "–";
  const { scale, unit } = timeUnit(seconds);
  return number(scale * seconds, unit);
}

const BEYOND = "Its cubic spring is too strong for the closed form, and the integrator that carries it is not in the page.";

function meaning({ regime, impacts, period }) {
  if (regime === PERIODIC) {
    const blows = impacts === 1 ? "one blow" : `${impacts} blows`;
    return `${blows} in ${period === 1 ? "each cycle" : `${period} cycles`} of the cart, then the same again`;
  }
  return {
    [NO_IMPACT]: "the hammer swings free of the stop",
    [CHAOTIC]: "blows that never repeat",
    [SUSTAINED_CONTACT]: "the hammer never leaves the stop",
    [UNRESOLVED]: "none of the regimes was verified",
    [FAILED]: "the cell left physics or the range of numbers",
    [NOT_COMPUTED]: "",
  }[regime];
}

const ROUNDING = 6; // a status number
const EXACT = 0; // an engine
// By status number; a verified result, too, may leave something open.
const WHY = {
  1: "the budget ran out before anything was verified",
  2: "nothing dissipates, so nothing settles",
  3: "there were too many contacts in one cycle",
  4: "the numbers ran out of range",
  5: "the start lies inside the rigid stop, or an integrator gave up",
  [ROUNDING]: "errors of rounding grew by e^20 or more on the way, so that they may decide where it ends",
  7: "its peak force may be off by more than the job's tolerance",
  8: "the budget ran out before chaos could be told from a long transient",
};

// What the file's certificate of a cell says, as the name and the value of a row. The proof is of the whole equation.
function proofWords({ reason, fromStart, lower, upper, unit }, { engine }, cell) {
  if (reason) return ["not proved", reason];
  const cubic = cell.cubic_stiffness_n_per_m3 && engine === EXACT ? " with the cubic spring, which the engine left out" : "";
  const what = upper > 0 ? between(lower, upper, unit) + cubic : "the motion";
  return ["proved", fromStart ? `${what}, and that the start leads there` : what];
}

// What the rigs drawn for a cell end in; "" in a file without any.
function outcomeWords(row, column) {
  const kept = file.outcomes(row, column);
  const words = kept.map(({ regime, impacts, period, probability }) => `${percent(probability)} ${labelWords(regime, impacts, period).replace("z = ", "")}`);
  const rest = 1 - kept.reduce((sum, { probability }) => sum + probability, 0);
  return [...words, kept.length > 0 && rest > 1e-9 ? `${percent(rest)} others` : ""].filter(Boolean).join(", ");
}

// The proof behind the engine's answer.
function proof(answer, multipliers) {
  const open = answer.regime < UNRESOLVED && answer.status > 0 ? ` But ${WHY[answer.status]}.` : "";
  return reason(answer, multipliers) + open;
}

function reason({ regime, cycles, lyapunov, sensitivity, status }, multipliers) {
  const spent = `${cycles.toLocaleString("en")} ${cycles === 1 ? "cycle" : "cycles"}`;
  if (regime === PERIODIC) {
    return `Newton's method found the orbit, its multipliers ${multiplierWords(multipliers)} lie inside the unit circle, ` +
      `and the motion contracts to it; ${spent}.`;
  }
  if (regime === NO_IMPACT) return `What is left of the decaying free motion can't reach the stop any more; ${spent}.`;
  if (regime === SUSTAINED_CONTACT) return `What is left of the decaying motion in contact can't part them any more; ${spent}.`;
  if (regime === CHAOTIC) {
    return `A perturbation grew by e^${digits(sensitivity, 3)}, and the largest Lyapunov exponent is ${digits(lyapunov, 3)} ` +
      `a cycle, positive by three standard errors; ${spent}. It may still be a long transient.`;
  }
  const why = WHY[status] ?? "the engine gives no reason";
  return `${why[0].toUpperCase()}${why.slice(1)}; ${spent}.`;
}

function multiplierWords(multipliers) {
  if (!multipliers) return "";
  const [re, im, other] = multipliers;
  const size = (value) => (Math.abs(value) < 1e-9 ? "0" : digits(value, 3)); // rounding, where contraction is complete
  return im === 0 ? `${size(re)} and ${size(other)}` : `${size(re)} ± ${size(Math.abs(im))} i`;
}

// Where a start ends, beside where the cell's own does.
function endWords(answer, home) {
  if ([UNRESOLVED, FAILED].includes(answer.regime)) return "no motion was verified";
  if (sameMotion(answer, home)) return answer.regime === CHAOTIC ? "ends in chaos as well" : "ends in the same motion";
  return "ends in another motion";
}

// {same, words}: whether a live result equals that of the file's cell.
function agreement(answer, stored) {
  const one = content.kind === "sweep" ? "point" : "cell";
  if (stored.regime === NOT_COMPUTED) return { same: null, words: `the file has no result of this ${one} yet` };
  const label = labelWords(stored.regime, stored.impacts, stored.period);
  const same = sameLabel(stored, answer);
  if (!same && stored.regime === UNRESOLVED && content.kind === "sweep") {
    return { same: null, words: "the file left this point unresolved; from there the engine goes on" };
  }
  if (!same && stored.filled) return { same: null, words: `the file has ${label} here, filled from the cells around` };
  if (!same && answer.status === ROUNDING) {
    return { same: null, words: `the file has ${label}: on this way errors of rounding grow by e^20 or more, so that the page’s engine may end elsewhere` };
  }
  if (!same) return { same, words: `differs from the file, which has ${label}` };
  const [live, kept] = [answer.peak_force_ratio, stored.peak_force_ratio];
  if (!Number.isFinite(live) || !Number.isFinite(kept) || kept === 0) return { same, words: `equals the file’s ${one}` };
  if (answer.regime >= CHAOTIC && answer.regime !== SUSTAINED_CONTACT && content.kind === "sweep") {
    return { same, words: "equals the file’s point; of such a motion another stretch is seen" };
  }
  const off = Math.abs(live - kept) / kept;
  if (stored.filled) return { same, words: `equals the file’s cell, which is filled from those around, force to ${digits(off, 1)}` };
  return { same, words: `equals the file’s ${one}, force to ${off === 0 ? "the last bit" : digits(off, 1)}` };
}

// Why the page's engine cannot run a cell; null if it can.
function whyNot(cell) {
  if (cell.contact_law === 2) {
    return "This stop follows Hunt and Crossley’s law, which only the program’s integrators carry; the page shows the file’s values.";
  }
  if (cell.engine_choice >= 3) {
    return "The job asks for an integrator (cvode or arkode), which the page hasn’t; it shows the file’s values.";
  }
  return null;
}
