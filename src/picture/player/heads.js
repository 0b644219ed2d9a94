// The page of several heads in rows over a conveyor that cut while the cloth moves.

/** @typedef {{row: number, color: string}} Head */
/**
 * @typedef {object} HeadFacts Lengths in mm, times in s.
 * @property {number} speed
 * @property {number} step
 * @property {number} travel
 * @property {number} room
 * @property {number[]} stations
 * @property {number} radius
 * @property {number} width
 * @property {number} ticks
 * @property {Head[]} heads
 * @property {[string, number, number][]} columns
 */

class Heads {
  /** @param {HeadFacts} facts @param {Columns} columns */
  constructor(facts, columns) {
    this.facts = facts;
    this.columns = columns;
    this.tick = 0;
    this.last = Math.max(0, facts.ticks - 1);
    /** Box of the cloth where it lies before the conveyor moves. @type {Box} */
    this.cloth = [0, 0, 0, 0];
    const { cut_x, cut_y } = columns;
    if (cut_x.length > 0) this.cloth = boxOf(cut_x, cut_y);
    this.used = facts.heads.reduce((most, head) => Math.max(most, head.row), 0);
    this.top = element("top", HTMLCanvasElement);
    /** Trails on the cloth as far as they are drawn, mm. @type {Path2D[]} */
    this.trails = [];
    this.drawn = Infinity;
    this.stage = new Stage([0.1, 0.5, 1, 4, 16], 1, () => this.box, elapsed => this.draw(elapsed));
  }

  /** What the window shows at first: rows, and the cloth as it comes. @returns {Box} */
  get box() {
    const { stations, travel, room } = this.facts, first = stations[0], last = stations[this.used];
    const [, low, , high] = this.cloth;
    return [first - Math.max(500, 0.6 * (last - first)), low - room, last + travel + 200, high + room];
  }

  /**
   * Place of a head over the table, mm, its heading, rad, and whether its knife is down.
   * @param {number} head @param {number} tick
   */
  at(head, tick) {
    const { head_x, head_y, head_c, head_knife } = this.columns, i = head * this.facts.ticks + tick;
    const x = this.facts.stations[this.facts.heads[head].row] + head_x[i];
    return { x, y: head_y[i], c: head_c[i] * Math.PI / 180, down: head_knife[i] > 0 };
  }

  /** @param {number} elapsed */
  draw(elapsed) {
    const { facts, stage } = this, { view } = stage;
    this.tick = Math.min(this.last, this.tick + elapsed / facts.step);
    if (this.tick >= this.last && stage.playing) stage.play(false);
    const k = Math.floor(this.tick), way = facts.speed * k * facts.step;
    const to = sharpen(this.top, view.width, view.height), [left, low, right, high] = this.cloth;
    to.fillStyle = themed("cloth");
    to.fillRect(view.px(left + way), view.py(high), (right - left) * view.scale, (high - low) * view.scale);
    this.drawRows(to);
    this.drawCuts(to, way);
    this.drawTrails(to, k, way);
    const down = facts.heads.filter((_, head) => this.drawHead(to, head, k)).length;
    stage.scrub.value = String(k);
    stage.tell(`${(k * facts.step).toFixed(2)} s`,
      `conveyor ${way.toFixed(0)} mm, ${down} of ${facts.heads.length} heads cut`);
  }

  /** @param {CanvasRenderingContext2D} to */
  drawRows(to) {
    const { view } = this.stage, { stations, travel } = this.facts;
    for (let row = 0; row <= this.used; row++) {
      to.fillStyle = themed("accent");
      to.globalAlpha = 0.1;
      to.fillRect(view.px(stations[row]), 0, travel * view.scale, view.height);
      to.globalAlpha = 1;
      write(to, `row ${row + 1}`, [view.px(stations[row]) + 4, 4], { size: 12, baseline: "top" });
    }
  }

  /** @param {CanvasRenderingContext2D} to @param {number} way */
  drawCuts(to, way) {
    const { cut_points, cut_x, cut_y } = this.columns, { view } = this.stage;
    to.strokeStyle = themed("line");
    to.lineWidth = 1;
    to.beginPath();
    let first = 0;
    for (const count of cut_points) {
      for (let i = first; i < first + count; i++) {
        const x = view.px(cut_x[i] + way), y = view.py(cut_y[i]);
        if (i === first) to.moveTo(x, y); else to.lineTo(x, y);
      }
      first += count;
    }
    to.stroke();
  }

  /**
   * Draws what each head cut up to a tick; paths grow while time goes on.
   * @param {CanvasRenderingContext2D} to @param {number} k @param {number} way
   */
  drawTrails(to, k, way) {
    const { facts } = this, { view } = this.stage;
    if (k < this.drawn) {
      this.trails = facts.heads.map(() => new Path2D());
      this.drawn = 0;
    }
    facts.heads.forEach((_, head) => {
      for (let n = this.drawn; n <= k; n++) {
        const { x, y, down } = this.at(head, n), on = x - facts.speed * n * facts.step;
        if (!down) continue;
        if (n > 0 && this.at(head, n - 1).down) this.trails[head].lineTo(on, y); else this.trails[head].moveTo(on, y);
      }
    });
    this.drawn = k + 1;
    to.save();
    to.translate(view.px(way), view.py(0));
    to.scale(view.scale, -view.scale);
    to.lineWidth = 2 / view.scale;
    facts.heads.forEach(({ color }, head) => {
      to.strokeStyle = color;
      to.stroke(this.trails[head]);
    });
    to.restore();
  }

  /**
   * Draws a head and its blade, and tells whether its knife is down.
   * @param {CanvasRenderingContext2D} to @param {number} head @param {number} k
   */
  drawHead(to, head, k) {
    const { room, radius, width, heads } = this.facts, { view } = this.stage, { x, y, c, down } = this.at(head, k);
    to.strokeStyle = heads[head].color;
    to.lineWidth = down ? 2.5 : 1;
    const across = 0.7 * room * view.scale, along = room * view.scale;
    to.strokeRect(view.px(x) - across / 2, view.py(y) - along / 2, across, along);
    const reach = Math.max(width, 14), lead = width ? radius / width * reach : reach / 2;
    /** @param {number} by @returns {[number, number]} */
    const onBlade = by => [view.px(x + by * Math.cos(c)), view.py(y + by * Math.sin(c))];
    drawLine(to, [onBlade(lead - reach), onBlade(lead)], down ? "bad" : "quiet", 4);
    return down;
  }
}

begin(async () => {
  const facts = /** @type {HeadFacts} */ (JSON.parse(element("facts", HTMLScriptElement).text));
  const heads = new Heads(facts, await pageColumns(facts.columns)), { scrub } = heads.stage;
  element("loading", HTMLElement).hidden = true;
  scrub.max = String(heads.last);
  scrub.addEventListener("input", () => {
    heads.tick = Number(scrub.value);
    heads.stage.wake();
  });
  heads.stage.rewind = () => {
    if (heads.tick >= heads.last) heads.tick = 0;
  };
  heads.stage.connect();
  heads.tick = Math.min(heads.last, Number(new URLSearchParams(location.search).get("t") ?? 0) / facts.step || 0);
  Object.assign(globalThis, { cutc: { facts, heads } });
});
