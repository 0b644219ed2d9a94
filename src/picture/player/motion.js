// The way of the axes over time, and what happens when.

/** Kinds of phases, as the page numbers them; from 11 on a drill. */
const KIND = { rest: 0, wait: 1, travel: 2, turn: 3, plunge: 4, cut: 5, lift: 6, stop: 7, advance: 8, drill: 10 };
/** How far the drawn trail may be from the way of the tip, mm. */
const TRAIL_OFF = 0.03;
/** Greatest distance of the tip from a place that it passes, mm. */
const NEAR = 1;

/** @typedef {{x: number, y: number, c: number}} Place X and Y of the C axis on the table, mm, and C, degrees. */
/** @typedef {{first: number, end: number, phase: number, part: number, box: Box}} Stroke Points of one cut. */
/**
 * @typedef {object} Trail
 * @property {Float64Array} x
 * @property {Float64Array} y
 * @property {Float64Array} tick
 * @property {Stroke[]} strokes
 */

/** @typedef {{least: Float64Array, most: Float64Array}} Curve Least and greatest value in each stretch of time. */

class Motion {
  /** @param {Facts} facts @param {Columns} columns */
  constructor(facts, columns) {
    this.facts = facts;
    this.columns = columns;
    this.period = facts.period_s;
    /** Last tick. */
    this.end = Math.max(0, facts.ticks - 1);
    /** Phases in which the knife goes down or a hole is drilled. @type {number[]} */
    this.cuts = [];
    /** First such phase of each piece in turn. @type {number[]} */
    this.pieces = [];
    let part = -1;
    columns.phase_kind.forEach((kind, phase) => {
      if (kind !== KIND.plunge && kind <= KIND.drill) return;
      this.cuts.push(phase);
      if (columns.phase_part[phase] !== part) this.pieces.push(phase);
      part = columns.phase_part[phase];
    });
    /** Name of what is counted. */
    this.unit = columns.phase_kind.some(kind => kind > KIND.drill) ? "cut or hole" : "cut";
    this.starts = Float64Array.from(this.cuts, phase => this.start(phase));
  }

  /** The time of a tick in words. @param {number} tick @param {number} decimals */
  clock(tick, decimals) { return clock(tick * this.period, decimals); }

  /**
   * Place and rates of the axes at a tick, whole or not.
   * @param {number} tick
   * @param {boolean} [rates] Whether the rates in mm or degrees per s are wanted instead of the place.
   * @returns {Place}
   */
  at(tick, rates = false) {
    const { tick: ticks, x, y, c, rate_x, rate_y, rate_c } = this.columns;
    const i = Math.min(lastUpTo(ticks, tick), Math.max(0, ticks.length - 2));
    const span = ticks.length > 1 ? ticks[i + 1] - ticks[i] : 1;
    const j = Math.min(i + 1, ticks.length - 1);
    const u = Math.min(1, Math.max(0, (tick - ticks[i]) / span)), v = 1 - u;
    const [a, b, d, e] = rates
      ? [-6 * u * v / span, 6 * u * v / span, v * (v - 2 * u), u * (u - 2 * v)].map(weight => weight / this.period)
      : [v * v * (1 + 2 * u), u * u * (1 + 2 * v), u * v * v * span, -u * u * v * span];
    /** @param {Float64Array} place @param {Float64Array} rate */
    const axis = (place, rate) => a * place[i] + b * place[j] + d * rate[i] + e * rate[j];
    return { x: axis(x, rate_x), y: axis(y, rate_y), c: axis(c, rate_c) };
  }

  /** Limits that hold in a phase: speed, acceleration and jerk of each axis. @param {number} phase */
  limits(phase) {
    const kind = this.columns.phase_kind[phase], { cut, travel } = this.facts.limits;
    return kind === KIND.plunge || kind === KIND.cut ? cut : travel;
  }

  /** Phase at a tick. @param {number} tick */
  phase(tick) { return lastUpTo(this.columns.phase_tick, tick); }

  /**
   * A point of the blade on the cloth at a tick, so many mm before the C axis.
   * @param {number} tick @param {number} reach @returns {[number, number]}
   */
  blade(tick, reach) {
    const { x, y, c } = this.at(tick), angle = c * Math.PI / 180;
    const station = this.columns.phase_station[this.phase(tick)];
    return [x + station + reach * Math.cos(angle), y + reach * Math.sin(angle)];
  }

  /** Speed of the tip, mm/s. @param {number} tick */
  tipSpeed(tick) {
    const { x, y, c } = this.at(tick, true), angle = this.at(tick).c * Math.PI / 180;
    const swing = this.facts.knife.tip_mm * c * Math.PI / 180;
    return Math.hypot(x - swing * Math.sin(angle), y + swing * Math.cos(angle));
  }

  /**
   * Tick at which the tip passes a place, at its nearest; `null` if it stays away from it.
   * @param {Trail} trail @param {[number, number]} place
   * @param {number} part The piece with which it comes there, by its place in the marker; -1 for any.
   */
  passing({ x, y, tick, strokes }, place, part) {
    let nearest = NEAR, at = 0;
    for (const stroke of strokes) {
      if (part >= 0 && this.facts.pieces[stroke.part]?.whole !== part) continue;
      for (let i = stroke.first + 1; i < stroke.end; i++) {
        const off = offChord(place, [x[i - 1], y[i - 1]], [x[i], y[i]]);
        if (off < nearest) [nearest, at] = [off, i];
      }
    }
    if (at === 0) return null;
    // The tip goes on along the chord, at any speed.
    let from = tick[at - 1], to = tick[at];
    while (to - from > 0.01) {
      const middle = (from + to) / 2, tip = this.blade(middle, this.facts.knife.tip_mm);
      const isBefore = (place[0] - tip[0]) * (x[at] - x[at - 1]) + (place[1] - tip[1]) * (y[at] - y[at - 1]) > 0;
      if (isBefore) from = middle; else to = middle;
    }
    return to;
  }

  /** First tick of a phase. @param {number} phase */
  start(phase) { return this.columns.phase_tick[phase]; }

  /** Number of the cut at a tick: how many have begun. @param {number} tick */
  cutsBegun(tick) { return countUpTo(this.starts, tick); }

  /** Source block that is cut at a tick; 0 when none is. @param {number} tick */
  block(tick) {
    const { block_tick, block, phase_kind } = this.columns;
    const kind = phase_kind[this.phase(tick)];
    if (block.length === 0 || kind < KIND.plunge || kind > KIND.cut) return 0;
    return block[lastUpTo(block_tick, tick)];
  }

  /** Shares of a limit over time, as in `speed_x`. @param {string} name @returns {Curve} */
  curve(name) { return { least: this.columns[`${name}_least`], most: this.columns[`${name}_most`] }; }

  /** The way of the blade through the cloth. @returns {Trail} */
  trail() {
    /** @type {number[]} */
    const points = [];
    /** @type {Stroke[]} */
    const strokes = [];
    const { phase_kind, phase_part, phase_tick } = this.columns;
    const { tip_mm, heel_mm } = this.facts.knife;
    for (let phase = 0; phase < phase_kind.length; phase++) {
      if (phase_kind[phase] !== KIND.plunge) continue;
      const first = points.length / 3, start = phase_tick[phase];
      points.push(...this.blade(start, -heel_mm), start, ...this.blade(start, tip_mm), start);
      let last = phase;
      while (phase_kind[last + 1] === KIND.cut) last++;
      if (last > phase) this.follow(phase_tick[phase + 1], phase_tick[last + 1] ?? this.end, points);
      strokes.push({ first, end: points.length / 3, phase, part: phase_part[phase], box: [0, 0, 0, 0] });
    }
    const length = points.length / 3;
    const [x, y, tick] = [0, 1, 2].map(of => Float64Array.from({ length }, (_, i) => points[3 * i + of]));
    for (const stroke of strokes) stroke.box = boxOf(x, y, stroke.first, stroke.end);
    return { x, y, tick, strokes };
  }

  /**
   * Adds the way of the tip between two ticks as far as chords need points to stay near it.
   * @param {number} from @param {number} to @param {number[]} points
   */
  follow(from, to, points) {
    const tip = this.facts.knife.tip_mm;
    /** @param {number} a @param {[number, number]} p @param {number} b @param {[number, number]} q */
    const split = (a, p, b, q) => {
      const m = (a + b) / 2, at = this.blade(m, tip);
      if (b - a > 1 && offChord(at, p, q) > TRAIL_OFF) {
        split(a, p, m, at);
        split(m, at, b, q);
      } else {
        points.push(...q, b);
      }
    };
    const { tick } = this.columns;
    let last = from, place = this.blade(from, tip);
    for (let i = lastUpTo(tick, from) + 1; last < to; i++) {
      const next = Math.min(to, i < tick.length ? tick[i] : to), middle = (last + next) / 2;
      const between = this.blade(middle, tip), end = this.blade(next, tip);
      split(last, place, middle, between);
      split(middle, between, next, end);
      [last, place] = [next, end];
    }
  }
}

/**
 * Least and greatest value of a curve in some of its stretches, and 0.
 * @param {Curve} curve @param {number} from First stretch. @param {number} to One past the last.
 * @returns {[number, number]}
 */
function peak({ least, most }, from, to) {
  let low = 0, high = 0;
  for (let i = Math.max(0, from), end = Math.min(to, most.length); i < end; i++) {
    if (least[i] < low) low = least[i];
    if (most[i] > high) high = most[i];
  }
  return [low, high];
}

/**
 * Distance of a point from a chord, mm.
 * @param {[number, number]} at @param {[number, number]} p @param {[number, number]} q
 */
function offChord([x, y], [px, py], [qx, qy]) {
  const dx = qx - px, dy = qy - py, square = dx * dx + dy * dy;
  const share = square > 0 ? Math.min(1, Math.max(0, ((x - px) * dx + (y - py) * dy) / square)) : 0;
  return Math.hypot(x - px - share * dx, y - py - share * dy);
}
