// Animation of hammer and cart, to scale and slowed down. The cart is a frame from whose top the hammer hangs on two beam
// springs; the stop is a post of the cart.

const SECONDS_PER_CYCLE = 1.6; // on the screen

class Stage {
  constructor(canvas, tell) {
    this.plot = new Plot(canvas, { left: 0, right: 0, top: 0, bottom: 0 });
    this.tell = tell; // called with the time in tau at each frame
    this.plays = !matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.motion = null;
    this.place = 0; // index of the sample shown, with its fraction
    new ResizeObserver(() => this.draw()).observe(canvas);
    requestAnimationFrame((now) => this.#frame(now));
  }
  // motion: {samples, impacts, cycles}; scales: lengths of the model and the screen
  show(motion, { gap, period }) {
    Object.assign(this, { motion, gap, period, place: 0 });
    this.count = motion.samples.length / 5;
    this.reach = 0; // largest displacement of hammer and cart from their centre, in A0
    this.swing = 0; // largest displacement of the hammer relative to the cart
    for (let i = 0; i < this.count; ++i) {
      const [, cart, relative] = motion.samples.subarray(5 * i, 5 * i + 3);
      this.reach = Math.max(this.reach, Math.abs(cart), Math.abs(cart + relative));
      this.swing = Math.max(this.swing, Math.abs(relative));
    }
    this.draw();
  }
  toggle() {
    this.plays = !this.plays;
    return this.plays;
  }
  #frame(now) {
    requestAnimationFrame((later) => this.#frame(later));
    const passed = Math.min((now - (this.before ?? now)) / 1000, 0.1);
    this.before = now;
    if (!this.motion || this.count < 2 || !this.plays || document.hidden) return;
    const perCycle = (this.count - 1) / this.motion.cycles;
    this.place = (this.place + (passed / SECONDS_PER_CYCLE) * perCycle) % (this.count - 1);
    this.draw();
  }
  draw() {
    if (!this.motion || this.count < 2) return;
    const i = Math.floor(this.place);
    const share = this.place - i;
    const number = (n) => {
      const [a, b] = [this.motion.samples[5 * i + n], this.motion.samples[5 * i + 5 + n]];
      return a + share * (b - a);
    };
    const now = { time: number(0), cart: number(1), relative: Math.min(number(2), this.gap + 0.02), velocity: number(3) };
    this.#paint(now);
    this.tell(now);
  }
  // Normalised speed, 0 to 1, of an impact within the last fraction of a cycle.
  #struck(time) {
    const { impacts } = this.motion;
    let glow = 0;
    for (let i = 0; i < impacts.length; i += 5) {
      const since = (time - impacts[i]) / this.period;
      if (since >= 0 && since < 0.12) glow = Math.max(glow, 1 - since / 0.12);
    }
    return glow;
  }
  #paint({ time, cart, relative }) {
    const { canvas, pen } = this.plot;
    this.plot.frame([0, 1], [0, 1]);
    const { width, height } = canvas.getBoundingClientRect();
    const hammerWidth = Math.min(46 * this.plot.letter, width / 9);
    const room = (width - 3.2 * hammerWidth) / 2;
    const scale = room / (this.reach + this.swing + Math.max(this.gap, 0) + 1.5);
    const x = (length) => width / 2 + scale * length; // position of the hammer's right face
    const [floor, ceiling] = [height - 26, 16];
    const struck = this.#struck(time);
    const left = x(cart - this.swing - 0.8) - hammerWidth;
    const post = x(cart + this.gap);
    this.#ground(width, floor);
    this.#cart(left, post, ceiling, floor);
    this.#beams(x(cart) - hammerWidth, x(cart + relative) - hammerWidth, hammerWidth, ceiling, floor);
    pen.fillStyle = struck > 0 ? ink("strike") : ink("hammer");
    pen.fillRect(x(cart + relative) - hammerWidth, floor - 46, hammerWidth, 32);
    if (struck > 0) this.#flash(post, floor - 30, struck);
    this.#scaleBar(scale, floor);
  }
  #ground(width, floor) {
    const pen = this.plot.pen;
    pen.strokeStyle = ink("grid");
    pen.beginPath();
    pen.moveTo(0, floor + 12.5);
    pen.lineTo(width, floor + 12.5);
    pen.stroke();
  }
  #cart(left, post, ceiling, floor) {
    const pen = this.plot.pen;
    const right = post + 14;
    pen.fillStyle = ink("cart");
    pen.fillRect(left - 8, ceiling - 6, right - left + 8, 6);
    pen.fillRect(left - 8, ceiling - 6, 6, floor - ceiling + 6);
    pen.fillRect(left - 8, floor - 6, right - left + 8, 6);
    pen.fillRect(post + 8, ceiling - 6, 6, floor - ceiling + 6);
    pen.fillStyle = ink("stop");
    pen.fillRect(post, floor - 40, 8, 20);
    for (const wheel of [left + 12, right - 14]) {
      pen.strokeStyle = ink("cart");
      pen.lineWidth = 2;
      pen.beginPath();
      pen.arc(wheel, floor + 6, 5.5, 0, 2 * Math.PI);
      pen.stroke();
    }
    pen.lineWidth = 1;
  }
  // Clamped at both ends: zero slope at the top and at the hammer.
  #beams(top, bottom, hammerWidth, ceiling, floor) {
    const pen = this.plot.pen;
    pen.strokeStyle = ink("spring");
    pen.lineWidth = 2;
    for (const place of [0.12, 0.88]) {
      const [from, to] = [top + place * hammerWidth, bottom + place * hammerWidth];
      const middle = (ceiling + floor - 46) / 2;
      pen.beginPath();
      pen.moveTo(from, ceiling);
      pen.bezierCurveTo(from, middle, to, middle, to, floor - 46);
      pen.stroke();
    }
    pen.lineWidth = 1;
  }
  #flash(x, y, struck) {
    const pen = this.plot.pen;
    pen.strokeStyle = ink("strike");
    pen.globalAlpha = struck;
    pen.lineWidth = 2;
    for (const [across, up] of [[-10, -26], [-2, -30], [-10, 26], [-2, 30]]) {
      pen.beginPath();
      pen.moveTo(x + across / 2, y + 0.7 * up);
      pen.lineTo(x + across, y + 1.1 * up);
      pen.stroke();
    }
    pen.globalAlpha = 1;
    pen.lineWidth = 1;
  }
  #scaleBar(scale, floor) {
    const pen = this.plot.pen;
    const millimetre = scale / (1000 * this.length);
    const size = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20].filter((mm) => mm * millimetre < 90).at(-1);
    if (!size || !Number.isFinite(millimetre)) return;
    pen.fillStyle = ink("faint");
    pen.fillRect(10, floor + 18, size * millimetre, 2);
    pen.textAlign = "left";
    pen.textBaseline = "middle";
    pen.fillText(`${size} mm`, 16 + size * millimetre, floor + 19);
  }
}
