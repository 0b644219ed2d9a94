// Speed, acceleration and jerk of the axes over time against their limits, and what the machine does.

/** Rows of the chart: the name of their columns, and what people call them. */
const ROWS = [["speed", "speed"], ["acc", "acceleration"], ["jerk", "jerk"]];
/** Share of a limit that a row reaches up to. */
const ROW_TOP = 1.15;
/** Height of the stripe of what the machine does, and of the scale of times, pixels. */
const STRIPE = 12, TIMES = 18;
/** Room for words on the left, pixels. */
const LEFT = 86;

class Charts {
  /** @param {Motion} motion @param {(tick: number) => void} seek @param {() => void} changed */
  constructor(motion, seek, changed) {
    this.motion = motion;
    this.changed = changed;
    this.frame = element("charts", HTMLElement);
    this.base = element("curves", HTMLCanvasElement);
    this.top = element("cursor", HTMLCanvasElement);
    /** Stretch of time that is shown, ticks. */
    this.from = 0;
    this.to = Math.max(1, motion.end);
    this.stale = true;
    /** Tick of the cursor. */
    this.cursor = 0;
    this.steer(seek);
  }

  /** @param {(tick: number) => void} seek */
  steer(seek) {
    const at = (/** @type {MouseEvent} */ event) => this.tick(event.clientX - this.frame.getBoundingClientRect().left);
    this.frame.addEventListener("pointerdown", event => {
      this.frame.setPointerCapture(event.pointerId);
      seek(at(event));
    });
    this.frame.addEventListener("pointermove", event => {
      if (event.buttons) seek(at(event));
    });
    this.frame.addEventListener("wheel", event => {
      event.preventDefault();
      this.zoom(Math.exp(event.deltaY / 400), at(event));
    }, { passive: false });
  }

  /** Shows more or less time around a tick. @param {number} factor @param {number} tick */
  zoom(factor, tick) {
    const { end } = this.motion, span = Math.max(20, Math.min(end || 1, (this.to - this.from) * factor));
    const share = (tick - this.from) / (this.to - this.from);
    this.show(tick - share * span, span);
    this.changed();
  }

  /** Shows a stretch of time. @param {number} from @param {number} span Ticks. */
  show(from, span) {
    this.from = Math.max(0, Math.min(this.motion.end - span, from));
    this.to = this.from + span;
    this.stale = true;
  }

  /** @param {number} px */
  tick(px) {
    const share = Math.min(1, Math.max(0, (px - LEFT) / Math.max(1, this.width - LEFT)));
    return this.from + share * (this.to - this.from);
  }

  /** @param {number} tick */
  px(tick) { return LEFT + (tick - this.from) / (this.to - this.from) * (this.width - LEFT); }

  get width() { return this.frame.clientWidth; }
  get height() { return this.frame.clientHeight; }

  /** Has the curves be drawn anew. */
  renew() { this.stale = true; }

  /** Draws the charts with their cursor at a tick; the stretch of time goes with it. @param {number} tick */
  draw(tick) {
    const span = this.to - this.from;
    if (tick !== this.cursor && (tick < this.from || tick > this.to)) this.show(tick - 0.1 * span, span);
    this.cursor = tick;
    if (this.stale) {
      this.drawCurves();
      this.stale = false;
    }
    const to = sharpen(this.top, this.width, this.height), x = this.px(tick);
    if (x < LEFT || x > this.width) return;
    to.fillStyle = themed("ink");
    to.fillRect(x - 0.5, 0, 1, this.height);
  }

  drawCurves() {
    const to = sharpen(this.base, this.width, this.height);
    const tall = (this.height - STRIPE - TIMES) / ROWS.length;
    ROWS.forEach(([name, words], row) => {
      const middle = (row + 0.5) * tall, unit = (tall / 2 - 2) / ROW_TOP;
      this.drawScale(to, words, middle, unit);
      AXIS_NAMES.forEach((axis, i) => this.drawAxis(to, `${name}_${axis}`, AXES[i], middle, unit));
    });
    this.drawStripe(to, this.height - STRIPE - TIMES);
    this.drawTimes(to);
  }

  /**
   * The lines of rest and of both limits of a row.
   * @param {CanvasRenderingContext2D} to @param {string} words @param {number} middle @param {number} unit
   */
  drawScale(to, words, middle, unit) {
    write(to, words, [2, middle], { size: 12, colour: "ink" });
    write(to, "+limit", [LEFT - 4, middle - unit], { size: 10, align: "right" });
    write(to, "−limit", [LEFT - 4, middle + unit], { size: 10, align: "right" });
    for (const level of [-1, 0, 1]) {
      to.fillStyle = themed(level ? "limit" : "rule");
      to.fillRect(LEFT, Math.round(middle - level * unit), this.width - LEFT, 1);
    }
  }

  /**
   * One curve: in every column of pixels from the least value to the greatest.
   * @param {CanvasRenderingContext2D} to @param {string} name @param {string} colour @param {number} middle
   * @param {number} unit
   */
  drawAxis(to, name, colour, middle, unit) {
    const { motion } = this, ticks = motion.facts.peak_ticks;
    const y = (/** @type {number} */ share) => middle - Math.max(-ROW_TOP, Math.min(ROW_TOP, share)) * unit;
    /** @type {[number, number][]} */
    const below = [];
    to.beginPath();
    const curve = motion.curve(name), { width } = this, perPixel = (this.to - this.from) / (width - LEFT) / ticks;
    for (let x = LEFT; x <= width; x++) {
      const at = this.from / ticks + (x - LEFT) * perPixel, first = Math.floor(at);
      const [least, most] = peak(curve, first, Math.max(first + 1, Math.floor(at + perPixel)));
      if (x === LEFT) to.moveTo(x, y(most)); else to.lineTo(x, y(most));
      below.push([x, y(least)]);
    }
    for (const [x, low] of below.toReversed()) to.lineTo(x, low);
    to.closePath();
    to.fillStyle = to.strokeStyle = colour;
    to.lineWidth = 1;
    to.globalAlpha = 0.35;
    to.fill();
    to.globalAlpha = 0.9;
    to.stroke();
    to.globalAlpha = 1;
  }

  /**
   * What the machine does: a stripe of cuts, with plunges, lifts and drills between them.
   * @param {CanvasRenderingContext2D} to @param {number} y
   */
  drawStripe(to, y) {
    const { phase_kind, phase_tick } = this.motion.columns;
    write(to, "knife down", [LEFT - 4, y + STRIPE / 2], { size: 10, align: "right" });
    to.fillStyle = themed("rule");
    to.fillRect(LEFT, y + 1, this.width - LEFT, STRIPE - 2);
    for (let phase = this.motion.phase(this.from); phase < phase_kind.length && phase_tick[phase] < this.to; phase++) {
      const kind = phase_kind[phase];
      const name = kind > KIND.lift ? "bad" : ["", "", "", "", "quiet", "ink", "quiet"][kind];
      if (!name) continue;
      const from = Math.max(LEFT, this.px(phase_tick[phase])), end = this.px(phase_tick[phase + 1] ?? this.motion.end);
      to.fillStyle = themed(name);
      to.fillRect(from, y + 1, Math.max(0.5, Math.min(this.width, end) - from), STRIPE - 2);
    }
  }

  /** @param {CanvasRenderingContext2D} to */
  drawTimes(to) {
    const seconds = (this.to - this.from) * this.motion.period;
    const steps = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 30, 60, 120, 300, 600, 1800];
    const every = steps.find(step => seconds / step <= (this.width - LEFT) / 70) ?? 3600;
    const decimals = every < 0.1 ? 2 : every < 1 ? 1 : 0;
    for (let i = Math.ceil(this.from * this.motion.period / every); i * every <= this.to * this.motion.period; i++) {
      const x = this.px(i * every / this.motion.period);
      if (x < LEFT + 8 || x > this.width - 16) continue;
      write(to, clock(i * every, decimals), [x, this.height - 2], { align: "center", baseline: "bottom" });
    }
  }
}
