// The cloth: pieces, the trail of what is cut, travels, findings, and the blade.

/** Kinds of lines, as the page numbers them. */
const LINE = { closed: 0, open: 1, notch: 2, aside: 3, hole: 4 };
/** Points of a line that are nearer than this on the screen are left out, pixels. */
const LEAST_STEP = 0.6;

/** Least size of letters, pixels: a number may be twice as wide as its piece. */
const LEAST_LETTERS = 8;

/** @typedef {{kind: number, part: number, first: number, end: number, box: Box}} Line */
/** @typedef {{travels: boolean, aside: boolean, names: boolean, marks: boolean}} Shown */

class Cloth {
  /** @param {Motion} motion @param {Colours} colours @param {View} view */
  constructor(motion, colours, view) {
    this.motion = motion;
    this.colours = colours;
    this.view = view;
    this.trail = colours.trail;
    /** @type {Shown} */
    this.shown = { travels: true, aside: false, names: true, marks: true };
    /** Piece that is marked, by its place in the marker; -1 for none. */
    this.marked = -1;
    /** Place that is marked, mm. @type {[number, number] | null} */
    this.spot = null;
    this.base = element("base", HTMLCanvasElement);
    this.cut = element("cut", HTMLCanvasElement);
    this.top = element("top", HTMLCanvasElement);
    /** Points of the trail that are drawn; -1 when all must be drawn anew. */
    this.drawn = -1;
    this.stale = true;
    /** How the view stood when it was drawn: origin and scale, width and height, pixels. @type {number[]} */
    this.stood = [];
    this.lines = this.readLines();
  }

  /** @returns {Line[]} */
  readLines() {
    const { line_kind, line_part, line_points, line_x, line_y } = this.motion.columns;
    let first = 0;
    return Array.from(line_kind, (kind, i) => {
      const end = first + line_points[i];
      const line = { kind, part: line_part[i], first, end, box: boxOf(line_x, line_y, first, end) };
      first = end;
      return line;
    });
  }

  /** Box of the marker, and of home when there is nothing else. @returns {Box} */
  get box() { return this.motion.facts.extent ?? [-50, -50, 50, 50]; }

  /** Has all be drawn anew. */
  renew() { this.stale = true; }

  /** Draws the cloth at a tick. @param {number} tick */
  draw(tick) {
    const { view } = this, [left, top, ...size] = this.stood;
    const stands = [view.left, view.top, view.scale, view.width, view.height];
    if (this.stale || size.some((value, i) => value !== stands[i + 2])) {
      this.drawBase(sharpen(this.base, view.width, view.height));
      this.drawn = -1;
      this.stale = false;
    } else if (left !== view.left || top !== view.top) {
      /** @type {[number, number]} */
      const by = [view.left - left, view.top - top];
      scroll(this.base, view, by, to => this.drawBase(to));
      scroll(this.cut, view, by, to => this.drawStrokes(to, 0, this.drawn));
    }
    this.stood = stands;
    this.drawTrail(tick);
    this.drawTop(tick);
  }

  /** Draws all on one canvas: printers paint over what lies below a second one. @param {number} tick */
  drawForPaper(tick) {
    this.view.measure();
    this.renew();
    this.draw(tick);
    const to = context(this.base);
    to.save();
    to.setTransform(1, 0, 0, 1, 0, 0);
    for (const canvas of [this.cut, this.top]) to.drawImage(canvas, 0, 0);
    to.restore();
  }

  /** Draws pieces and other lines. @param {CanvasRenderingContext2D} to */
  drawBase(to) {
    const { view } = this, [left, low, right, high] = this.box;
    to.fillStyle = themed("cloth");
    to.fillRect(view.px(left) - 8, view.py(high) - 8, (right - left) * view.scale + 16, (high - low) * view.scale + 16);
    /** Outlines by piece: they are filled together, so that cut-outs stay open. @type {Map<number, Path2D>} */
    const areas = new Map();
    for (const line of this.lines) {
      if (!view.sees(line.box) || (line.kind === LINE.aside && !this.shown.aside)) continue;
      const path = this.path(line);
      if (line.kind === LINE.closed) {
        const area = areas.get(line.part) ?? new Path2D();
        area.addPath(path);
        areas.set(line.part, area);
      }
      to.lineWidth = line.kind === LINE.notch ? 2 : 1;
      to.strokeStyle = themed(line.kind === LINE.aside ? "aside" : "line");
      to.stroke(path);
    }
    for (const [part, area] of areas) {
      to.fillStyle = this.colours.ofPiece(part);
      to.globalAlpha = part === this.marked ? 0.42 : 0.13;
      to.fill(area, "evenodd");
      to.globalAlpha = 1;
      if (part === this.marked) {
        to.lineWidth = 2.5;
        to.strokeStyle = themed("accent");
        to.stroke(area);
      }
    }
    this.drawOrigin(to);
    if (this.shown.names) this.drawNames(to);
  }

  /** A line as it is drawn on the screen. @param {Line} line */
  path(line) {
    const { line_x, line_y } = this.motion.columns, { view } = this, path = new Path2D();
    if (line.kind === LINE.hole) {
      path.arc(view.px(line_x[line.first]), view.py(line_y[line.first]), Math.max(2.5, 2 * view.scale), 0, 2 * Math.PI);
      return path;
    }
    let lastX = Infinity, lastY = Infinity;
    for (let i = line.first; i < line.end; i++) {
      const x = view.px(line_x[i]), y = view.py(line_y[i]);
      if (i > line.first && i < line.end - 1 && Math.abs(x - lastX) + Math.abs(y - lastY) < LEAST_STEP) continue;
      if (i === line.first) path.moveTo(x, y); else path.lineTo(x, y);
      [lastX, lastY] = [x, y];
    }
    if (line.kind === LINE.closed) path.closePath();
    return path;
  }

  /** The origin of the table and the directions of its axes. @param {CanvasRenderingContext2D} to */
  drawOrigin(to) {
    const x = this.view.px(0), y = this.view.py(0);
    drawLine(to, [[x, y - 22], [x, y], [x + 22, y]], "quiet", 1);
    write(to, "X", [x + 25, y]);
    write(to, "Y", [x, y - 29], { align: "center" });
  }

  /** @param {CanvasRenderingContext2D} to */
  drawNames(to) {
    const { view } = this;
    this.motion.facts.pieces.forEach(piece => {
      if (!piece.extent || !view.sees(piece.extent)) return;
      const [left, low, right, high] = piece.extent;
      const wide = (right - left) * view.scale, tall = (high - low) * view.scale;
      const size = Math.min(13, wide / piece.number.length / 0.6, tall);
      if (2 * size < LEAST_LETTERS) return;
      const x = view.px((left + right) / 2), y = view.py((low + high) / 2);
      const name = piece.name && piece.name !== piece.number && tall > 40 ? piece.name : "";
      const letters = { size: Math.max(size, LEAST_LETTERS), weight: 600 };
      write(to, piece.number, [x, name ? y - 8 : y], { ...letters, colour: "ink", align: "center" });
      if (name && to.measureText(name).width < wide) write(to, name, [x, y + 8], { colour: "ink", align: "center" });
    });
  }

  /** Draws what was cut up to a tick; goes on from what is drawn where it can. @param {number} tick */
  drawTrail(tick) {
    const { trail, view } = this;
    const end = countUpTo(trail.tick, tick);
    let to = context(this.cut);
    if (this.drawn < 0 || end < this.drawn) {
      to = sharpen(this.cut, view.width, view.height);
      this.drawn = 0;
    }
    if (end === this.drawn) return;
    this.drawStrokes(to, this.drawn, end);
    this.drawn = end;
  }

  /**
   * Draws points of the trail, all strokes.
   * @param {CanvasRenderingContext2D} to @param {number} begin @param {number} end One past the last.
   */
  drawStrokes(to, begin, end) {
    const of = this.colours.ofTrail(), { table } = this.colours;
    to.lineWidth = 2.2;
    to.lineCap = to.lineJoin = "round";
    for (const stroke of this.trail.strokes) {
      if (stroke.end <= begin) continue;
      if (stroke.first >= end) break;
      if (!this.view.sees(stroke.box)) continue;
      const from = Math.max(stroke.first, begin - 1), until = Math.min(stroke.end, end);
      this.drawStroke(to, from, until, i => of ? table[of[i]] : this.colours.ofPiece(stroke.part));
    }
  }

  /**
   * Draws points of the trail in the colours of their chords.
   * @param {CanvasRenderingContext2D} to @param {number} from @param {number} until One past the last.
   * @param {(i: number) => string} colour
   */
  drawStroke(to, from, until, colour) {
    const { x, y } = this.trail, { view } = this;
    let lastX = view.px(x[from]), lastY = view.py(y[from]), now = "";
    for (let i = from + 1; i < until; i++) {
      const toX = view.px(x[i]), toY = view.py(y[i]), next = colour(i);
      if (next === now && i < until - 1 && Math.abs(toX - lastX) + Math.abs(toY - lastY) < LEAST_STEP) continue;
      if (next !== now) {
        if (now) to.stroke();
        to.strokeStyle = now = next;
        to.beginPath();
        to.moveTo(lastX, lastY);
      }
      to.lineTo(toX, toY);
      [lastX, lastY] = [toX, toY];
    }
    if (now) to.stroke();
  }

  /** Draws what moves: travels, marks, the blade. @param {number} tick */
  drawTop(tick) {
    const to = sharpen(this.top, this.view.width, this.view.height);
    if (this.shown.travels) this.drawTravels(to, tick);
    if (this.shown.marks) this.drawMarks(to);
    this.drawWindow(to, tick);
    this.drawRuler(to);
    this.drawTip(to, tick);
    if (this.motion.end > 0) this.drawBlade(to, tick);
  }

  /**
   * The stretch of the cloth that is on the table of a conveyor.
   * @param {CanvasRenderingContext2D} to @param {number} tick
   */
  drawWindow(to, tick) {
    const { motion, view } = this, { window_mm } = motion.facts, [, low, , high] = this.box;
    if (window_mm === null) return;
    const station = motion.columns.phase_station[motion.phase(tick)];
    const [left, right] = [station, station + window_mm].map(x => view.px(x));
    const top = view.py(high) - 8, bottom = view.py(low) + 8;
    write(to, "on the table", [left + 2, top - 7], { colour: "accent" });
    drawLine(to, [[left, top], [right, top], [right, bottom], [left, bottom], [left, top]], "accent", 1.5);
  }

  /** A length of 1, 2 or 5 by a power of ten that is at most 120 pixels long. @param {CanvasRenderingContext2D} to */
  drawRuler(to) {
    const { scale, height } = this.view, ten = 10 ** Math.floor(Math.log10(120 / scale)), y = height - 12;
    const length = [5, 2, 1].find(times => times * ten * scale <= 120) ?? 1, end = 12 + length * ten * scale;
    drawLine(to, [[12, y - 5], [12, y], [end, y], [end, y - 5]], "ink", 1.5);
    const words = ten >= 1000 ? `${length * ten / 1000} m` : `${Number((length * ten).toPrecision(1))} mm`;
    write(to, words, [18, y - 8], { colour: "ink" });
  }

  /** @param {CanvasRenderingContext2D} to @param {number} tick */
  drawTravels(to, tick) {
    const { phase_kind, phase_tick } = this.motion.columns, { view } = this;
    to.strokeStyle = themed("travel");
    to.lineWidth = 1;
    to.setLineDash([5, 4]);
    to.beginPath();
    for (let phase = 0; phase < phase_kind.length && phase_tick[phase] <= tick; phase++) {
      if (phase_kind[phase] !== KIND.travel) continue;
      const [fromX, fromY] = this.motion.blade(phase_tick[phase], 0);
      const [toX, toY] = this.motion.blade(Math.min(tick, (phase_tick[phase + 1] ?? tick) - 1e-6), 0);
      to.moveTo(view.px(fromX), view.py(fromY));
      to.lineTo(view.px(toX), view.py(toY));
    }
    to.stroke();
    to.setLineDash([]);
  }

  /** @param {CanvasRenderingContext2D} to */
  drawMarks(to) {
    const { view } = this, { broken, warned, declared } = this.motion.facts;
    // Many of them would hide the cloth: they grow with it.
    const arm = Math.min(4, Math.max(1.5, 5 * view.scale));
    for (const [x, y] of declared) {
      if (!view.sees([x, y, x, y])) continue;
      const px = view.px(x), py = view.py(y), low = py + arm;
      drawLine(to, [[px, low], [px + arm, py], [px, py - arm], [px - arm, py], [px, low]], "declared", 1.2);
    }
    for (const [x, y] of warned) drawRing(to, [view.px(x), view.py(y)], 2 * arm, "warn", 1.5);
    for (const [x, y] of broken) drawRing(to, [view.px(x), view.py(y)], 12, "bad", 2.5);
    if (this.spot) {
      const px = view.px(this.spot[0]), py = view.py(this.spot[1]);
      drawRing(to, [px, py], 16, "accent", 2);
      for (const [dx, dy] of [[1, 0], [-1, 0], [0, 1], [0, -1]]) {
        drawLine(to, [[px + 11 * dx, py + 11 * dy], [px + 21 * dx, py + 21 * dy]], "accent", 2);
      }
    }
  }

  /**
   * Draws the stretch of the cut between the last point of the trail and the blade.
   * @param {CanvasRenderingContext2D} to @param {number} tick
   */
  drawTip(to, tick) {
    const { trail, view } = this, phase = this.motion.phase(tick), last = this.drawn - 1;
    if (this.motion.columns.phase_kind[phase] !== KIND.cut || last < 0) return;
    const [x, y] = this.motion.blade(tick, this.motion.facts.knife.tip_mm);
    const of = this.colours.ofTrail();
    to.strokeStyle = of ? this.colours.table[of[last]] : this.colours.ofPiece(this.motion.columns.phase_part[phase]);
    to.lineWidth = 2.2;
    to.lineCap = "round";
    to.beginPath();
    to.moveTo(view.px(trail.x[last]), view.py(trail.y[last]));
    to.lineTo(view.px(x), view.py(y));
    to.stroke();
  }

  /**
   * The blade seen from above, from heel to tip: filled when it is down, hollow when it is up.
   * @param {CanvasRenderingContext2D} to @param {number} tick
   */
  drawBlade(to, tick) {
    const { motion, view } = this, { tip_mm, heel_mm } = motion.facts.knife;
    const kind = motion.columns.phase_kind[motion.phase(tick)], down = kind === KIND.plunge || kind === KIND.cut;
    const [x, y] = motion.blade(tick, 0), angle = -motion.at(tick).c * Math.PI / 180;
    to.save();
    to.translate(view.px(x), view.py(y));
    drawRing(to, [0, 0], 13, down ? "bad" : "ink", 1.2);
    to.rotate(angle);
    const tip = Math.max(tip_mm * view.scale, tip_mm > 0 ? 1 : 0), heel = heel_mm * view.scale;
    const half = Math.max(1.6, 0.1 * (tip + heel)), shoulder = tip - 0.35 * (tip + heel);
    to.beginPath();
    const outline = [[tip, 0], [shoulder, half], [-heel, 0.6 * half], [-heel, -0.6 * half], [shoulder, -half]];
    for (const [along, across] of outline) to.lineTo(along, across);
    to.closePath();
    to.fillStyle = themed(down ? "bad" : "paper");
    to.fill();
    to.stroke();
    drawLine(to, [[13, 0], [19, 0]], down ? "bad" : "ink", 1.2);
    to.beginPath();
    to.arc(0, 0, 1.6, 0, 2 * Math.PI);
    to.fillStyle = themed(down ? "paper" : "ink");
    to.fill();
    to.restore();
  }

  /**
   * The piece at a place of the window, by its place in the marker; -1 when there is none.
   * @param {number} px @param {number} py
   */
  pieceAt(px, py) {
    const to = context(this.base), ratio = globalThis.devicePixelRatio || 1;
    const x = this.view.mmX(px), y = this.view.mmY(py);
    const near = this.lines.filter(({ kind, box: [left, low, right, high] }) =>
      kind === LINE.closed && left <= x && x <= right && low <= y && y <= high);
    const inside = near.filter(line => to.isPointInPath(this.path(line), px * ratio, py * ratio));
    const size = (/** @type {Line} */ line) => (line.box[2] - line.box[0]) * (line.box[3] - line.box[1]);
    inside.sort((a, b) => size(a) - size(b));
    return inside[0]?.part ?? -1;
  }
}
