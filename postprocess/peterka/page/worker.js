// Runs the engine in the background: single cells with their motion, which newer messages cancel, and lists of cells for live
// maps, as many as fit into a time slice.

const TURN_MS = 40;
const CYCLES_AT_ONCE = 1000;
const SAMPLES_PER_CYCLE = 400;
const PULSE_SAMPLES = 600;
const MOST_CYCLES_SHOWN = 24;
const POINTS_OF_CHAOS = 4000; // at forcing phase 0, enough to draw a chaotic attractor
let engine = null;
let newest = 0; // number of the newest request for a single cell

const otherMessages = () => new Promise((done) => setTimeout(done));

onmessage = async ({ data }) => {
  if (data.bytes) engine = Engine.from(data.bytes);
  else if (data.cells) postMessage(await solveCells(data));
  else if (data.cell) await solveCell(data);
  else newest = data.number; // cancels the current one
};

async function solveCells({ number, cell, sides, cells }) {
  const solver = await engine;
  const count = LISTED_NUMBERS.length;
  const results = new Float64Array(count * (cells.length / 2));
  const begun = performance.now();
  let done = 0;
  while (2 * done < cells.length && (done === 0 || performance.now() - begun < TURN_MS)) {
    const changes = sides.map((side, n) => changeOf(side, cells[2 * done + n]));
    solver.begin(settled(Object.assign({ ...cell }, ...changes)), false);
    solver.advance(0);
    const answer = solver.answer();
    results.set(LISTED_NUMBERS.map((name) => answer[name]), count * done);
    ++done;
  }
  return { number, done, results: results.slice(0, count * done) };
}

async function solveCell({ number, cell, knocked }) {
  newest = number;
  const solver = await engine;
  const begun = performance.now();
  let spent = 0;
  solver.begin(cell, true);
  while (!solver.advance(CYCLES_AT_ONCE)) {
    spent += CYCLES_AT_ONCE;
    postMessage({ number, spent });
    await otherMessages();
    if (newest !== number) return;
  }
  const answer = solver.answer();
  const points = answer.period > 0 ? solver.points() : solver.follow(true, POINTS_OF_CHAOS, 1).points;
  postMessage({ number, answer, points, milliseconds: performance.now() - begun, ...motionsOf(solver, answer, knocked) });
}

// The steady motion over a few of its periods, its multipliers, a close-up of its hardest impact, and the transient from the start.
function motionsOf(solver, answer, knocked) {
  const q = answer.period;
  const multipliers = q > 0 ? solver.follow(true, q, 1).multipliers : null;
  const shown = q > 0 ? Math.min(Math.max(q, q * Math.ceil(2 / q)), 2 * MOST_CYCLES_SHOWN) : MOST_CYCLES_SHOWN;
  const steady = solver.follow(true, shown, SAMPLES_PER_CYCLE);
  const hardest = hardestOf(steady.impacts);
  const pulse = hardest >= 0 ? solver.lookClosely(hardest, PULSE_SAMPLES) : null;
  const touch = hardest >= 0 ? steady.impacts[5 * hardest] : NaN;
  const way = solver.follow(false, MOST_CYCLES_SHOWN, SAMPLES_PER_CYCLE / 2);
  return { steady, pulse, touch, way, multipliers, knocked };
}

// By force, on a rigid stop by speed; impacts that outlast the motion come last.
function hardestOf(impacts) {
  let hardest = -1;
  let most = -1;
  for (let i = 0; i < impacts.length / 5; ++i) {
    const [, end, speed, force] = impacts.subarray(5 * i, 5 * i + 4);
    const hardness = Number.isNaN(end) ? 0 : Number.isNaN(force) ? speed : force;
    if (hardness > most * (1 + 1e-9)) [hardest, most] = [i, hardness];
  }
  return hardest;
}
