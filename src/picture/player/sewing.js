// The page of a pattern that is sewn: stitches, needle, and the turn of the spindle.

/** What entries are, by their numbers. */
const ENTRY_WORDS = ["stitch", "jump", "trim", "stop", "thread"];
/** Time of an entry that waits for somebody, s. */
const PAUSE = 0.3;

/**
 * @typedef {object} SewFacts Angles in degrees, lengths in mm, times in s.
 * @property {number} start_deg
 * @property {number} end_deg
 * @property {number} step
 * @property {number} start
 * @property {number} acceleration
 * @property {number | null} cap
 * @property {boolean} fill
 * @property {number} trim
 * @property {[string, number, number][]} columns
 */

class Pattern {
  /** @param {SewFacts} facts @param {Columns} columns */
  constructor(facts, columns) {
    this.facts = facts;
    this.columns = columns;
    this.count = columns.op.length;
    /** Entry, and time in it, s. */
    this.entry = 0;
    this.time = 0;
    /** Share of a turn in which the cloth may move. */
    this.open = (((facts.end_deg - facts.start_deg) % 360) + 360) % 360 / 360;
    this.base = element("base", HTMLCanvasElement);
    this.top = element("top", HTMLCanvasElement);
    this.dial = element("dial", HTMLCanvasElement);
    this.stage = new Stage([0.001, 0.005, 0.02, 0.1, 1], 0.02, () => this.box, elapsed => this.draw(elapsed));
  }

  /** @returns {Box} */
  get box() {
    const [left, low, right, high] = boxOf(this.columns.x, this.columns.y);
    return [Math.min(0, left), Math.min(0, low), Math.max(0, right), Math.max(0, high)];
  }

  /**
   * Way of an axis after a time, as the motor makes it: up from the start speed, on, down (manual page `sewing`).
   * @param {number} pulses @param {number} time @param {number} window
   */
  way(pulses, time, window) {
    const { step, start: v0, acceleration, fill } = this.facts, cap = this.facts.cap ?? Infinity;
    const p = Math.abs(pulses) * step;
    if (p === 0) return 0;
    let a = acceleration, v = Math.sqrt(v0 * v0 + a * p), ramp = (v - v0) / a, total = 2 * ramp;
    if (v > cap) {
      v = cap;
      ramp = (cap - v0) / a;
      total = 2 * ramp + (p - (cap * cap - v0 * v0) / a) / cap;
    }
    if (window && fill) {
      total = window;
      if (p <= v0 * window) return Math.sign(pulses) * p * Math.min(1, time / window);
      a = 4 * (p - v0 * window) / (window * window);
      v = v0 + a * window / 2;
      ramp = window / 2;
      if (v > cap) {
        ramp = (cap * window - p) / (cap - v0);
        a = (cap - v0) / ramp;
        v = cap;
      }
    }
    const up = (/** @type {number} */ t) => v0 * t + a * t * t / 2;
    if (time >= total) return Math.sign(pulses) * p;
    const amid = time < total - ramp ? up(ramp) + v * (time - ramp) : p - up(total - time);
    return Math.sign(pulses) * (time < ramp ? up(time) : amid);
  }

  /** Time of an entry, s. @param {number} i */
  duration(i) {
    const { op, rpm, pulses_x, pulses_y } = this.columns;
    if (op[i] === 0) return 60 / rpm[i];
    if (op[i] > 1) return op[i] === 2 ? this.facts.trim : PAUSE;
    const done = (/** @type {number} */ pulses, /** @type {number} */ t) =>
      Math.abs(this.way(pulses, t, 0)) >= Math.abs(pulses) * this.facts.step - 1e-6;
    let time = 0;
    while (!done(pulses_x[i], time) || !done(pulses_y[i], time)) time += 0.001;
    return time;
  }

  /** @param {number} elapsed */
  draw(elapsed) {
    const { stage } = this;
    this.time += elapsed;
    while (this.entry < this.count - 1 && this.time >= this.duration(this.entry)) {
      this.time -= this.duration(this.entry);
      this.entry++;
    }
    if (stage.playing && this.entry === this.count - 1 && this.time >= this.duration(this.entry)) stage.play(false);
    if (this.count === 0) return;
    this.drawCloth();
    this.drawSpindle();
    stage.scrub.value = String(this.entry);
  }

  drawCloth() {
    const { op, x, y, rpm, pulses_x, pulses_y } = this.columns, { view } = this.stage, i = this.entry;
    const to = sharpen(this.base, view.width, view.height);
    // Stitches and jumps, those before the entry and those behind it.
    for (const [jumps, past, colour, width] of /** @type {[boolean, boolean, string, number][]} */ ([
      [true, false, "rule", 0.5], [false, false, "aside", 1.5],
      [true, true, "travel", 0.5], [false, true, "accent", 1.5],
    ])) {
      to.strokeStyle = themed(colour);
      to.lineWidth = width;
      to.beginPath();
      for (let k = past ? 0 : i, end = past ? i : this.count; k < end; k++) {
        if (op[k] > 1 || (op[k] === 1) !== jumps) continue;
        to.moveTo(view.px(k ? x[k - 1] : 0), view.py(k ? y[k - 1] : 0));
        to.lineTo(view.px(x[k]), view.py(y[k]));
      }
      to.stroke();
    }
    const window = op[i] === 0 ? this.open * 60 / rpm[i] : 0;
    const hereX = (i ? x[i - 1] : 0) + this.way(pulses_x[i], this.time, window);
    const hereY = (i ? y[i - 1] : 0) + this.way(pulses_y[i], this.time, window);
    const needle = sharpen(this.top, view.width, view.height);
    needle.fillStyle = themed("bad");
    needle.beginPath();
    needle.arc(view.px(hereX), view.py(hereY), 4, 0, 2 * Math.PI);
    needle.fill();
    this.stage.tell(`entry ${i + 1} of ${this.count}: ${ENTRY_WORDS[op[i]]}`,
      `${rpm[i].toFixed(0)} stitches/min, X ${hereX.toFixed(2)} mm, Y ${hereY.toFixed(2)} mm`);
  }

  /** The turn of the spindle, which begins where the window does, and the needle over the cloth. */
  drawSpindle() {
    const { op, rpm, pulses_x, pulses_y } = this.columns, i = this.entry, sews = op[i] === 0;
    const turn = sews ? this.time * rpm[i] / 60 : 0, angle = (this.facts.start_deg + 360 * turn) % 360;
    const rad = (/** @type {number} */ degrees) => (degrees - 90) * Math.PI / 180;
    const to = sharpen(this.dial, 420, 170);
    for (const [colour, share] of /** @type {[string, number][]} */ ([["rule", 1], ["good", this.open]])) {
      to.strokeStyle = themed(colour);
      to.lineWidth = 13;
      to.beginPath();
      to.arc(85, 85, 60, rad(this.facts.start_deg), rad(this.facts.start_deg + 360 * share));
      to.stroke();
    }
    drawLine(to, [[85, 85], [85 + 66 * Math.cos(rad(angle)), 85 + 66 * Math.sin(rad(angle))]], "ink", 3);
    // The needle is lowest amid the closed part of the turn.
    const lowest = this.facts.start_deg - 180 * (1 - this.open), shut = Math.cos(Math.PI * (1 - this.open));
    const height = sews ? Math.cos((angle - lowest) * Math.PI / 180) : -1, tip = 120 + (height - shut) * 40;
    drawLine(to, [[190, 120], [290, 120]], "travel", 5);
    drawLine(to, [[240, tip - 90], [240, tip]], "ink", 4);
    const moves = (pulses_x[i] || pulses_y[i]) && (sews ? turn < this.open : this.time < this.duration(i));
    write(to, `${angle.toFixed(0)}°`, [310, 66], { size: 13, colour: "ink" });
    write(to, moves ? "the cloth moves" : "the cloth rests", [310, 88], { size: 13, colour: "ink" });
  }
}

begin(async () => {
  const facts = /** @type {SewFacts} */ (JSON.parse(element("facts", HTMLScriptElement).text));
  const pattern = new Pattern(facts, await pageColumns(facts.columns)), { scrub } = pattern.stage;
  element("loading", HTMLElement).hidden = true;
  scrub.max = String(Math.max(0, pattern.count - 1));
  scrub.addEventListener("input", () => {
    pattern.entry = Number(scrub.value);
    pattern.time = 0;
    pattern.stage.wake();
  });
  pattern.stage.rewind = () => {
    if (pattern.entry === pattern.count - 1 && pattern.time >= pattern.duration(pattern.entry)) {
      pattern.entry = pattern.time = 0;
    }
  };
  pattern.stage.connect();
  Object.assign(globalThis, { cutc: { facts, pattern } });
});
