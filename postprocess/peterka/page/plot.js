// A canvas with axes: frames, ticks, lines and points, sharp on any screen and in the page's colours.

const ink = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();

// About `count` round numbers between two values.
function ticksBetween(low, high, count) {
  const rough = (high - low) / Math.max(count, 1);
  if (!(rough > 0) || !Number.isFinite(rough)) return { values: [], step: 1 };
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((n) => n * power).find((n) => n >= rough * (1 - 1e-9));
  const values = [];
  for (let n = Math.ceil(low / step - 1e-9); n * step <= high + 1e-9 * step; ++n) values.push(n * step);
  return { values, step };
}

// 1, 2, 5, 10, ... between two values, at most `count`.
function logTicks(low, high, count) {
  const all = [];
  for (let n = Math.floor(Math.log10(low)); n <= Math.ceil(Math.log10(high)); ++n) {
    for (const digit of [1, 2, 5]) all.push(digit * 10 ** n);
  }
  const inside = all.filter((value) => value >= low * (1 - 1e-9) && value <= high * (1 + 1e-9));
  if (inside.length < 2) return ticksBetween(low, high, count);
  return { values: inside.length <= count ? inside : inside.filter((value) => /^1/.test(value.toPrecision(1))), step: 0 };
}

function tickText(value, step) {
  if (value === 0 || Math.abs(value) < 1e-9 * step) return "0";
  const digits = step > 0 ? Math.max(0, -Math.floor(Math.log10(step) + 1e-9)) : Math.max(0, -Math.floor(Math.log10(value)));
  const size = Math.abs(value);
  const power = (of) => Math.floor(Math.log10(of) + 1e-9);
  if (size >= 1e6 || digits > 6) return withPower(value, step > 0 ? Math.max(power(size) - power(step), 0) : 0);
  return signed(value.toFixed(digits));
}

const signed = (text) => text.replace("-", "−");

// A number for display, with at most `count` digits.
function digits(value, count = 4) {
  if (value === null || value === undefined || Number.isNaN(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (!Number.isFinite(value)) return signed(String(value));
  if (size >= 1e6 || size < 1e-4) {
    return withPower(value, Math.max(count - 2, 0));
  }
  return signed(value.toPrecision(count).includes("e") ? String(Math.round(value)) : value.toPrecision(count));
}

// 2.5·10⁶, with this many digits behind the point.
function withPower(value, decimals) {
  const [mantissa, power] = value.toExponential(Math.min(decimals, 15)).split("e");
  return signed(`${mantissa}·10${superscript(Number(power))}`);
}

const superscript = (number) => [...String(number)].map((letter) => (letter === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[letter])).join("");

class Plot {
  // margins: {left, right, top, bottom} in CSS pixels.
  constructor(canvas, margins) {
    this.canvas = canvas;
    this.margins = margins;
    this.pen = canvas.getContext("2d");
  }
  // Clears the canvas and sets these ranges [from, to] along both axes.
  frame(x, y) {
    const box = this.canvas.getBoundingClientRect();
    const scale = window.devicePixelRatio || 1;
    const [width, height] = [Math.round(box.width * scale), Math.round(box.height * scale)];
    if (this.canvas.width !== width || this.canvas.height !== height) Object.assign(this.canvas, { width, height });
    this.letter = parseFloat(getComputedStyle(this.canvas).fontSize) / 14; // 1 on a screen of standard size
    const [left, right, top, bottom] = ["left", "right", "top", "bottom"].map((side) => this.letter * this.margins[side]);
    this.area = { left, top, width: Math.max(box.width - left - right, 1), height: Math.max(box.height - top - bottom, 1) };
    [this.x, this.y] = [x, y];
    this.pen.setTransform(scale, 0, 0, scale, 0, 0);
    this.pen.clearRect(0, 0, box.width, box.height);
    this.write(11);
    this.pen.lineWidth = 1;
  }
  // Font of this size [CSS pixels, on a screen of standard size].
  write(size) {
    this.pen.font = `${size * this.letter}px ${ink("numbers")}`;
  }
  across(value) {
    return this.area.left + ((value - this.x[0]) / (this.x[1] - this.x[0])) * this.area.width;
  }
  up(value) {
    return this.area.top + this.area.height - ((value - this.y[0]) / (this.y[1] - this.y[0])) * this.area.height;
  }
  // The values under a pointer event; null outside the plot area.
  valuesAt(event) {
    const box = this.canvas.getBoundingClientRect();
    const { left, top, width, height } = this.area;
    const across = (event.clientX - box.left - left) / width;
    const up = 1 - (event.clientY - box.top - top) / height;
    if (across < 0 || across > 1 || up < 0 || up > 1) return null;
    return [this.x[0] + across * (this.x[1] - this.x[0]), this.y[0] + up * (this.y[1] - this.y[0])];
  }
  clipped(draw) {
    const { left, top, width, height } = this.area;
    this.pen.save();
    this.pen.beginPath();
    this.pen.rect(left, top, width, height);
    this.pen.clip();
    draw(this.pen);
    this.pen.restore();
  }
  // For the sides "x", "y": grid lines, ticks and a label; factor: from the values to the displayed numbers.
  axes({ xLabel = "", yLabel = "", xFactor = 1, yFactor = 1, xTicks = true }) {
    const { left, top, width, height } = this.area;
    const pen = this.pen;
    pen.strokeStyle = ink("grid");
    pen.fillStyle = ink("faint");
    const alongX = ticksBetween(this.x[0] * xFactor, this.x[1] * xFactor, Math.max(2, width / (62 * this.letter)));
    const alongY = ticksBetween(this.y[0] * yFactor, this.y[1] * yFactor, Math.min(Math.max(2, height / (24 * this.letter)), 8));
    pen.textAlign = "center";
    pen.textBaseline = "top";
    for (const value of alongX.values) {
      const at = Math.round(this.across(value / xFactor)) + 0.5;
      this.#line(at, top, at, top + height);
      if (xTicks) pen.fillText(tickText(value, alongX.step), at, top + height + 4 * this.letter);
    }
    pen.textAlign = "right";
    pen.textBaseline = "middle";
    for (const value of alongY.values) {
      const at = Math.round(this.up(value / yFactor)) + 0.5;
      this.#line(left, at, left + width, at);
      pen.fillText(tickText(value, alongY.step), left - 5, at);
    }
    pen.strokeStyle = ink("line");
    pen.strokeRect(left + 0.5, top + 0.5, width - 1, height - 1);
    pen.textAlign = "right";
    pen.textBaseline = "bottom";
    if (xLabel) pen.fillText(xLabel, left + width, top + height + (xTicks ? 30 : 16) * this.letter);
    this.sideways(yLabel, 11 * this.letter, top + height / 2);
  }
  sideways(text, x, y) {
    const pen = this.pen;
    pen.save();
    pen.translate(x, y);
    pen.rotate(-Math.PI / 2);
    pen.textAlign = "center";
    pen.textBaseline = "middle";
    pen.fillText(text, 0, 0);
    pen.restore();
  }
  #line(x0, y0, x1, y1) {
    this.pen.beginPath();
    this.pen.moveTo(x0, y0);
    this.pen.lineTo(x1, y1);
    this.pen.stroke();
  }
  // A line through xAt(i) and yAt(i) for `count` points.
  line(count, xAt, yAt, colour, width = 1.4, dash = []) {
    this.clipped((pen) => {
      pen.strokeStyle = colour;
      pen.lineWidth = width;
      pen.setLineDash(dash);
      pen.lineJoin = "round";
      pen.beginPath();
      for (let i = 0; i < count; ++i) pen.lineTo(this.across(xAt(i)), this.up(yAt(i)));
      pen.stroke();
    });
  }
  dots(count, xAt, yAt, colour, radius, rim = null) {
    this.clipped((pen) => {
      pen.fillStyle = colour;
      for (let i = 0; i < count; ++i) {
        pen.beginPath();
        pen.arc(this.across(xAt(i)), this.up(yAt(i)), radius, 0, 2 * Math.PI);
        pen.fill();
        if (rim) {
          pen.strokeStyle = rim;
          pen.lineWidth = 1;
          pen.stroke();
        }
      }
    });
  }
}
