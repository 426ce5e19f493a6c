// The motions a small step to either side of a curve, to which the engine continues from the orbit on the curve. That orbit's
// motion exists on one side; on the other it has become a different one.

const STEPS = [1e-3, 2.5e-4, 6e-5, 1.5e-5, 4e-6, 1e-6]; // relative to the window: shorter steps where other edges lie within the longer ones

// A promise of {step, sides: [{values, cell, found, keeps}, ...]}, the side with the smaller coordinate first, for the longest
// step with the motion on one side and a different one across, or else the longest of all.
async function besideCurve(workers, curve, point) {
  let first = null;
  for (const step of STEPS) {
    const sides = await Promise.all([-1, 1].map((way) => sideOf(workers, curve, point, way * step)));
    sides.sort((a, b) => a.values[0] - b.values[0] || a.values[1] - b.values[1]);
    if (curves.list[curve].kind === "fold" && sides.every(({ keeps }) => keeps)) leaveTheNearer(sides, curve, point);
    if (sides[0].keeps !== sides[1].keeps) return { step, sides };
    first ??= { step, sides };
  }
  return first;
}

async function sideOf(workers, curve, point, step) {
  const values = valuesBeside(curve, point, step);
  // curves are computed for springs without their cubic term
  const rig = Object.assign({ ...content.cell, cubic_stiffness_n_per_m3: 0 }, ...file.sides.map((side, n) => changeOf(side, values[n])));
  const [u, v] = ["orbit_displacement", "orbit_velocity"].map((name) => curves.number(name, curve, point));
  const cell = startingAt(settled(rig), u, v);
  const found = await workers.solve(cell, [], []);
  return { values, cell, found, keeps: isMotionOf(curves.list[curve], found) };
}

// A fold's orbit exists on one side only: if both sides have its z, the
// one whose force is farther from that on the curve is another orbit.
function leaveTheNearer(sides, curve, point) {
  const off = sides.map(({ found }) => Math.abs(found.peak_force_ratio - curves.number("peak_force_ratio", curve, point)));
  if (off[0] !== off[1]) sides[off[0] < off[1] ? 1 : 0].keeps = false;
}

function isMotionOf({ impacts, period }, found) {
  if (impacts === 0) return found.regime === NO_IMPACT;
  return found.regime === PERIODIC && found.impacts === impacts && found.period === period;
}

// [across, up] one step away, normal to the curve as displayed in the window.
function valuesBeside(curve, point, step) {
  const axes = [file.columns, file.rows];
  const widths = axes.map(({ edges }) => edges.at(-1) - edges[0]);
  const last = curves.list[curve].to - curves.list[curve].from - 1;
  const [before, after] = [Math.max(point - 1, 0), Math.min(point + 1, last)].map((at) => curves.place(curve, at));
  const along = widths.map((width, n) => (after[n] - before[n]) / width);
  const length = Math.hypot(...along) || 1;
  const across = Math.hypot(...along) > 0 ? [-along[1] / length, along[0] / length] : [1, 0];
  const here = curves.place(curve, point);
  return axes.map((axis, n) => valueInside(axis, here[n] + step * across[n] * widths[n]));
}
