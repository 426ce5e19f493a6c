// The basin of the selected cell: the motion in which each start ends, drawn behind its phase plane. A start at forcing phase 0
// is a point of that plane, because the cart then passes its centre: x = u, x' = u' + eta.

const BASIN_SIZE = 96;

function liveBasin(workers, cell, window, changed) {
  const motions = new Motions();
  const at = ([from, to], n) => from + ((n + 0.5) / BASIN_SIZE) * (to - from);
  const plane = new LivePlane({
    workers, cell, size: BASIN_SIZE, changed,
    sides: [{ sets: "displacement_ratio", clears: ["displacement_m"] }, { sets: "velocity_ratio", clears: ["velocity_m_per_s"] }],
    valuesAt: (i, j) => {
      const u = at(window.x, i);
      return u > cell.gap_ratio ? null : [u, at(window.y, j) + cell.frequency_ratio];
    },
    colour: (...result) => motions.colourOf(...result),
  });
  plane.motions = motions;
  plane.window = window;
  return plane;
}

// Whether two coordinates of orbits are the same, of one engine or of one with the cubic spring and one without: src/regime/same_orbit.hpp.
const coincide = (a, b, alike) => Math.abs(a - b) <= (alike ? 1e-6 : 5e-3) * (1 + Math.max(Math.abs(a), Math.abs(b)));

// The motions in which starts end, each with its colour and its number of starts. Motions of one class are distinguished by their
// orbit's point at forcing phase 0: further ones have shades of the class's colour.
class Motions {
  constructor() {
    this.all = [];
  }
  colourOf(regime, p, q, force, engine, u, rate) {
    const kind = classOf(regime, p, q);
    const same = this.all.filter((one) => one.regime === regime && one.p === p && one.q === q);
    let motion = regime === PERIODIC
      ? same.find((one) => coincide(one.u, u, one.engine === engine) && coincide(one.rate, rate, one.engine === engine)) : same[0];
    if (!motion) {
      const colour = shade(content.classes[kind].colour, same.length);
      motion = { regime, p, q, force, engine, u, rate, colour, painted: abgr(colour), count: 0 };
      this.all.push(motion);
    }
    ++motion.count;
    return motion.painted;
  }
  // For a legend, largest first. On a rigid stop, which has no force, u at forcing phase 0 distinguishes those with one label.
  entries({ weight_n: newtons, length_m: metres }) {
    const sum = this.all.reduce((so_far, one) => so_far + one.count, 0);
    const told = ({ force, u }, places) => (force > 0 ? `${digits(force * newtons, places)} N` : `u = ${digits(1000 * u * metres, places)} mm`);
    // As many digits as distinguish it from the others with its label.
    const apart = (one) => {
      const others = this.all.filter((other) => other !== one && other.regime === one.regime && other.p === one.p && other.q === one.q);
      if (!(one.force > 0) && others.length === 0) return "";
      let places = 3;
      while (places < 9 && others.some((other) => told(other, places) === told(one, places))) ++places;
      return `, ${told(one, places)}`;
    };
    return [...this.all].sort((a, b) => b.count - a.count).slice(0, 8).map((one) => ({
      label: labelWords(one.regime, one.p, one.q) + (one.regime === PERIODIC ? apart(one) : ""),
      colour: one.colour, share: one.count / sum,
    }));
  }
}
