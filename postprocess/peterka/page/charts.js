// Diagrams of a cell: displacement and force over time, the hardest impact in close-up, the phase plane, the multipliers.

const MARGINS = { left: 58, right: 10, top: 8, bottom: 34 };

// {scale, unit} suited to display a length of time.
function timeUnit(seconds) {
  if (seconds < 2e-3) return { scale: 1e6, unit: "µs" };
  return seconds < 0.5 ? { scale: 1e3, unit: "ms" } : { scale: 1, unit: "s" };
}

function span(count, at, pad = 0.06) {
  let [low, high] = [Infinity, -Infinity];
  for (let i = 0; i < count; ++i) {
    const value = at(i);
    if (value < low) low = value;
    if (value > high) high = value;
  }
  if (!(high > low)) return [low - 1, low + 1];
  return [low - pad * (high - low), high + pad * (high - low)];
}

class Charts {
  constructor(element) {
    const plot = (name, margins = MARGINS) => new Plot(element(name), margins);
    this.displacement = plot("chart-displacement", { ...MARGINS, bottom: 8 });
    this.force = plot("chart-force");
    this.pulse = plot("chart-pulse");
    this.phase = plot("chart-phase");
    this.circle = plot("chart-multipliers", { left: 8, right: 8, top: 8, bottom: 8 });
    this.cursors = ["cursor-displacement", "cursor-force"].map(element);
    this.dot = element("cursor-phase");
    this.shown = null;
    this.basin = null;
    new ResizeObserver(() => this.draw()).observe(element("chart-phase"));
  }
  // shown: {motion, pulse, touch, points, multipliers, scales, gap, starts, window}
  show(shown) {
    this.shown = shown;
    this.draw();
  }
  draw() {
    if (!this.shown) return;
    const { scales } = this.shown;
    this.second = 1 / scales.frequency_rad_per_s;
    this.millimetre = 1000 * scales.length_m;
    this.#drawDisplacement();
    this.#drawForce();
    this.#drawPulse();
    this.drawPhase();
    this.#drawMultipliers();
  }
  // Marks the current position of the animation.
  point({ time, relative, velocity }) {
    if (!this.shown) return;
    const place = (element, plot, x, y) => {
      element.style.transform = `translate(${x}px, ${y}px)`;
      element.hidden = !plot.area;
    };
    for (const [n, plot] of [this.displacement, this.force].entries()) {
      const cursor = this.cursors[n];
      place(cursor, plot, plot.across(time), plot.area.top);
      cursor.style.height = `${plot.area.height}px`;
    }
    place(this.dot, this.phase, this.phase.across(relative), this.phase.up(velocity));
  }
  #time() {
    const { samples } = this.shown.motion;
    const last = samples.at(-5);
    const { scale, unit } = timeUnit(last * this.second);
    return { count: samples.length / 5, samples, range: [0, last], xFactor: scale * this.second, xLabel: `time (${unit})` };
  }
  #drawDisplacement() {
    const { count, samples, range, xFactor } = this.#time();
    const { gap } = this.shown;
    const hammer = (i) => samples[5 * i + 1] + samples[5 * i + 2];
    const stop = (i) => samples[5 * i + 1] + gap;
    const low = Math.min(span(count, hammer)[0], span(count, (i) => samples[5 * i + 1])[0]);
    const cart = span(count, (i) => samples[5 * i + 1])[1];
    const high = Math.max(span(count, hammer)[1], cart, Math.min(span(count, stop)[1], span(count, hammer)[1] + 3));
    const plot = this.displacement;
    plot.frame(range, [low, high]);
    plot.axes({ yLabel: "x, y (mm)", xFactor, yFactor: this.millimetre, xTicks: false });
    const time = (i) => samples[5 * i];
    plot.line(count, time, stop, ink("stop"), 1.2, [4, 3]);
    plot.line(count, time, (i) => samples[5 * i + 1], ink("cart"), 1.2);
    plot.line(count, time, hammer, ink("hammer"), 1.8);
  }
  // Uniform samples would miss the peak of an impact, so each impact's own largest force is drawn at its touch.
  #drawForce() {
    const { count, samples, range, xFactor, xLabel } = this.#time();
    const { impacts } = this.shown.motion;
    const rigid = impacts.length > 0 && Number.isNaN(impacts[3]) && !Number.isNaN(impacts[1]);
    const newton = rigid ? this.millimetre / 1000 / this.second : this.shown.scales.force_n;
    const height = (n) => impacts[5 * n + (rigid ? 2 : 3)] || 0;
    let top = span(count, (i) => samples[5 * i + 4], 0.1)[1];
    for (let n = 0; n < impacts.length / 5; ++n) top = Math.max(top, 1.1 * height(n));
    const plot = this.force;
    plot.frame(range, [0, top > 0 ? top : 1]);
    plot.axes({ xLabel, yLabel: rigid ? "speed (m/s)" : "force (N)", xFactor, yFactor: newton });
    if (!rigid) plot.line(count, (i) => samples[5 * i], (i) => samples[5 * i + 4], ink("strike"), 1.2);
    for (let n = 0; n < impacts.length / 5; ++n) {
      plot.line(2, () => impacts[5 * n], (i) => i * height(n), ink("strike"), 1.6);
    }
    if (impacts.length > 0) {
      plot.dots(impacts.length / 5, (n) => impacts[5 * n], height, ink("strike"), 2.2);
    }
  }
  #drawPulse() {
    const { pulse, touch, scales } = this.shown;
    const plot = this.pulse;
    const has = pulse && pulse.length > 0 && pulse.some((value, i) => i % 5 === 4 && value > 0);
    if (!has) return this.#empty(plot, "no force in time to show");
    const count = pulse.length / 5;
    const time = (i) => pulse[5 * i] - touch;
    const { scale, unit } = timeUnit((pulse.at(-5) - pulse[0]) * this.second);
    plot.frame([time(0), time(count - 1)], [0, span(count, (i) => pulse[5 * i + 4], 0.1)[1]]);
    plot.axes({ xLabel: `time since touch (${unit})`, yLabel: "force (N)", xFactor: scale * this.second, yFactor: scales.force_n });
    plot.line(count, time, (i) => pulse[5 * i + 4], ink("strike"), 1.8);
  }
  drawPhase() {
    if (!this.shown) return;
    const { motion, points, gap, window, starts } = this.shown;
    const plot = this.phase;
    plot.frame(window.x, window.y);
    if (this.basin?.window === window) {
      plot.clipped((pen) => {
        pen.imageSmoothingEnabled = false;
        pen.globalAlpha = BASIN_ALPHA;
        const { left, top, width, height } = plot.area;
        pen.drawImage(this.basin.canvas, left, top, width, height);
      });
    }
    const speed = this.millimetre / this.second;
    plot.axes({ xLabel: "u = x − y (mm)", yLabel: "u′ (mm/s)", xFactor: this.millimetre, yFactor: speed });
    plot.line(2, () => gap, (i) => window.y[i], ink("stop"), 2);
    const { samples } = motion;
    plot.line(samples.length / 5, (i) => samples[5 * i + 2], (i) => samples[5 * i + 3], ink("hammer"), 1.2);
    const many = points.length > 200;
    plot.dots(points.length / 2, (i) => points[2 * i], (i) => points[2 * i + 1], ink("points"), many ? 1.2 : 3.2,
      many ? null : ink("paper"));
    for (const start of starts) plot.dots(1, () => start.u, () => start.v, start.colour, 4, ink("ink"));
  }
  #drawMultipliers() {
    const { multipliers } = this.shown;
    const plot = this.circle;
    if (!multipliers) return this.#empty(plot, "no multipliers");
    const size = Math.max(1.25, ...Array.from(multipliers, (value) => 1.1 * Math.abs(value)));
    plot.frame([-size, size], [-size, size]);
    const turn = (i) => (i / 120) * 2 * Math.PI;
    plot.line(2, (i) => (i ? -size : size), () => 0, ink("grid"), 1);
    plot.line(2, () => 0, (i) => (i ? -size : size), ink("grid"), 1);
    plot.line(121, (i) => Math.cos(turn(i)), (i) => Math.sin(turn(i)), ink("line"), 1.2);
    plot.dots(2, (i) => multipliers[2 * i], (i) => multipliers[2 * i + 1], ink("points"), 4, ink("paper"));
  }
  #empty(plot, words) {
    plot.frame([0, 1], [0, 1]);
    const { left, top, width, height } = plot.area;
    plot.pen.fillStyle = ink("faint");
    plot.pen.textAlign = "center";
    plot.pen.textBaseline = "middle";
    plot.pen.fillText(words, left + width / 2, top + height / 2);
  }
}
