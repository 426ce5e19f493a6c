// The basin of the selected cell: the motion in which each start ends, drawn behind its phase plane. A start at forcing phase 0
// is a point of that plane, because the cart then passes its centre: x = u, x' = u' + eta.

const BASIN_SIZE = 96;
const BASIN_ALPHA = 0.55; // behind the phase plane

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
    colour: (...numbers) => motions.colourOf(Object.fromEntries(LISTED_NUMBERS.map((name, n) => [name, numbers[n]]))),
  });
  plane.motions = motions;
  plane.window = window;
  return plane;
}

const sameLabel = (one, other) => ["regime", "impacts", "period"].every((name) => one[name] === other[name]);

// Whether two answers of the engine tell one motion: src/regime/same_orbit.hpp, whose second tolerance is for an orbit with the cubic
// spring and one without.
function sameMotion(one, other) {
  if (!sameLabel(one, other)) return false;
  if (one.regime !== PERIODIC) return true;
  const tolerance = one.engine === other.engine ? 1e-6 : 5e-3;
  return ["orbit_displacement", "orbit_velocity"].map((name) => [one[name], other[name]])
    .every(([a, b]) => Math.abs(a - b) <= tolerance * (1 + Math.max(Math.abs(a), Math.abs(b))));
}

// The motions in which starts end, each with its colour and its number of starts. Motions of one class are distinguished by their
// orbit's point at forcing phase 0: further ones have shades of the class's colour.
class Motions {
  constructor() {
    this.all = [];
  }
  // answer: {name of LISTED_NUMBERS: number}.
  colourOf(answer) {
    let motion = this.all.find((one) => sameMotion(one, answer));
    if (!motion) {
      const kind = classOf(answer.regime, answer.impacts, answer.period);
      const colour = answer.regime === NOT_COMPUTED ? NO_VALUE_COLOUR
        : shade(content.classes[kind].colour, this.all.filter((one) => sameLabel(one, answer)).length);
      motion = { ...answer, colour, painted: abgr(colour), count: 0 };
      this.all.push(motion);
    }
    ++motion.count;
    return motion.painted;
  }
  // For a legend, largest first. On a rigid stop, which has no force, u at forcing phase 0 distinguishes those with one label.
  entries({ weight_n: newtons, length_m: metres }) {
    const sum = this.all.reduce((so_far, one) => so_far + one.count, 0);
    const told = ({ peak_force_ratio: force, orbit_displacement: u }, places) =>
      (force > 0 ? `${digits(force * newtons, places)} N` : `u = ${digits(1000 * u * metres, places)} mm`);
    // As many digits as distinguish it from the others with its label.
    const apart = (one) => {
      const others = this.all.filter((other) => other !== one && sameLabel(other, one));
      if (!(one.peak_force_ratio > 0) && others.length === 0) return "";
      let places = 3;
      while (places < 9 && others.some((other) => told(other, places) === told(one, places))) ++places;
      return `, ${told(one, places)}`;
    };
    return [...this.all].sort((a, b) => b.count - a.count).slice(0, 8).map((one) => ({
      label: one.regime === NOT_COMPUTED ? BEYOND_LABEL : labelWords(one.regime, one.impacts, one.period) + (one.regime === PERIODIC ? apart(one) : ""),
      colour: `color-mix(in srgb, ${one.colour} ${100 * BASIN_ALPHA}%, var(--paper))`, share: one.count / sum,
    }));
  }
}
