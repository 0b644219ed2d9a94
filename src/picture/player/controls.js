// Buttons, choices and keys of the player.

/** Speeds of playing, in times of the real one. */
const RATES = [0.05, 0.1, 0.25, 0.5, 1, 2, 5, 10, 25, 60, 150];
/** What happens in phases, by their kinds. */
const WORDS = [
  "rest at the end", "wait for the knife to be up", "travel", "turn", "plunge", "cut", "lift", "stop of the file",
  "cloth is moved on",
];
/** What is stepped through: messages, broken rules and declared deviations. */
const STEPPED = "#messages, .broken, #deviations";
/** Buttons that do what a key does. */
const BUTTONS = {
  cut_next: "ArrowRight", cut_before: "ArrowLeft", piece_next: "Shift+ArrowRight", piece_before: "Shift+ArrowLeft",
};

class Player extends Stage {
  /** @param {Motion} motion @param {Colours} colours */
  constructor(motion, colours) {
    super(RATES, 1, () => this.cloth.box, elapsed => this.draw(elapsed), (px, py) => {
      this.goToPiece(this.cloth.pieceAt(px, py), false);
    });
    this.frame.addEventListener("pointermove", ({ buttons, offsetX, offsetY }) => {
      const piece = motion.facts.pieces[buttons ? -1 : this.cloth.pieceAt(offsetX, offsetY)];
      this.frame.title = piece ? named(piece) : "";
    });
    this.motion = motion;
    this.colours = colours;
    this.tick = 0;
    this.following = false;
    /** True while a place is shown that the blade does not pass. */
    this.isAside = false;
    /** The place of the report that was gone to last. @type {HTMLButtonElement | null} */
    this.jump = null;
    this.cloth = new Cloth(motion, colours, this.view);
    this.charts = new Charts(motion, tick => this.seek(tick), () => this.wake());
    this.scrub.max = String(motion.end);
    this.rewind = () => {
      if (this.tick >= motion.end) this.tick = 0;
    };
  }

  /** @param {number} elapsed */
  draw(elapsed) {
    this.tick = Math.min(this.motion.end, this.tick + elapsed / this.motion.period);
    if (elapsed > 0) this.leave();
    if (this.playing && this.tick >= this.motion.end) this.play(false);
    if (this.following) this.follow();
    this.cloth.draw(this.tick);
    this.charts.draw(this.tick);
    this.tellAll();
  }

  /** Keeps the blade in the window. */
  follow() {
    const [x, y] = this.motion.blade(this.tick, 0), { view } = this;
    const isAmid = (/** @type {number} */ share) => share > 0.2 && share < 0.8;
    if (!isAmid(view.px(x) / view.width) || !isAmid(view.py(y) / view.height)) view.moveTo(x, y);
  }

  /** Goes to a tick. @param {number} tick */
  seek(tick) {
    this.tick = Math.min(this.motion.end, Math.max(0, tick));
    this.leave();
    this.wake();
  }

  /** Forgets what was said of the place that was gone to. */
  leave() {
    this.isAside = false;
    this.cloth.spot = null;
    this.say("found", "");
  }

  /**
   * Goes to the start of the next or the previous of some phases.
   * @param {number[]} phases @param {number} by 1 or -1.
   */
  step(phases, by) {
    this.play(false);
    const starts = phases.map(phase => this.motion.start(phase));
    const next = by > 0 ? starts.find(tick => tick > this.tick + 0.5) : starts.findLast(tick => tick < this.tick - 0.5);
    this.seek(next ?? (by > 0 ? this.motion.end : 0));
  }

  /**
   * Marks a piece and goes to where its cutting begins.
   * @param {number} part @param {boolean} show Whether the piece is brought into the window.
   */
  goToPiece(part, show) {
    this.cloth.marked = part;
    this.cloth.renew();
    markRow(part);
    const { motion } = this, { phase_part } = motion.columns, { pieces } = motion.facts;
    const sections = motion.pieces.filter(phase => pieces[phase_part[phase]]?.whole === part);
    const times = sections.map(phase => {
      const section = phase_part[phase], { window } = pieces[section];
      const next = phase_part.findIndex((of, i) => i > phase && of !== section);
      const time = [phase, next].map(at => motion.clock(motion.start(at) ?? motion.end, 1)).join(" to ");
      return window === null ? time : `${time} in window ${window + 1}`;
    });
    if (sections.length > 0 && show) this.seek(motion.start(sections[0]));
    const told = `${named(pieces[part])} is ${times.length ? "cut from " : "not cut"}${times.join(", ")}`;
    const shared = times.length && motion.facts.has_common ? "; edges in common with others may be cut with those" : "";
    this.say("found", part < 0 ? "no piece lies there" : `${told}${shared}; its row in the table is marked`);
    const box = pieces[part]?.extent;
    if (box && show) this.show(box);
    this.wake();
  }

  /** Brings a box of the cloth into view, on the cloth and with it. @param {Box} box */
  show(box) {
    this.view.fit(box);
    this.frame.scrollIntoView({ block: "center" });
  }

  /**
   * Goes to a place of the cloth, X and Y in mm, and to the moment at which the blade is there: at a time, s, or with a
   * piece, by its place in the marker, if either is known.
   * @param {DOMStringMap} place @param {HTMLButtonElement} [button] The button of the report that has it.
   */
  goToPlace({ time, part = "-1", told = "", ...at }, button) {
    this.play(false);
    this.jump = button ?? this.jump;
    const x = Number(at.x), y = Number(at.y), { motion } = this, near = 15;
    this.show([x - near, y - near, x + near, y + near]);
    const tick = time === undefined ? motion.passing(this.cloth.trail, [x, y], Number(part))
      : Number(time) / motion.period;
    if (tick !== null) this.seek(tick);
    this.cloth.spot = [x, y];
    this.say("found", told);
    this.isAside = tick === null;
    // What the blade does not pass may be a line that is not cut.
    if (this.isAside && !this.cloth.shown.aside) element("aside", HTMLInputElement).click();
    // The next Space plays.
    this.frame.focus({ preventScroll: true });
  }

  /** Goes to the place of the report after or before the last one. @param {number} by 1 or -1. */
  nextPlace(by) {
    const buttons = [...jumps()].filter(button => button.checkVisibility() && button.closest(STEPPED));
    const from = this.jump ? buttons.indexOf(this.jump) : Math.min(0, -by);
    buttons.at((from + by) % buttons.length)?.click();
  }

  /** Says what happens at the cursor. */
  tellAll() {
    const { motion, tick } = this, phase = motion.phase(tick);
    const { x, y, c } = motion.at(tick), rates = motion.at(tick, true);
    const kind = motion.columns.phase_kind[phase], part = motion.columns.phase_part[phase];
    const words = WORDS[kind] ?? `drill ${kind - KIND.drill}`;
    const piece = motion.facts.pieces[part], station = motion.columns.phase_station[phase];
    const speed = kind === KIND.cut ? motion.tipSpeed(tick) : Math.hypot(rates.x, rates.y);
    const block = motion.block(tick);
    this.say("time", `${motion.clock(tick, 3)} of ${motion.clock(motion.end, 3)}`);
    this.say("does", words + (block ? `, block ${block}` : ""));
    // The heading within half a turn of the X axis.
    const heading = c - 360 * Math.ceil((c - 180) / 360);
    const window = piece?.window ?? null;
    // Rounded first: no zero has a sign.
    const [atX, atY, atC] = [x, y, heading].map(value => (Math.round(100 * value) / 100).toFixed(2));
    const place = `X ${atX}  Y ${atY}  C ${atC}°`;
    this.say("axes", window === null ? place : `${place} on the table`);
    this.say("window", window === null ? "" : `X ${(x + station).toFixed(2)} on the cloth: window ${window + 1}, `
      + `moved on by ${station} mm; the time of moving on is not counted`);
    const [inX, inY, inC] = [rates.x, rates.y, rates.c].map(Math.round);
    const [ofX, ofY, ofC] = motion.limits(phase).map(([most]) => Math.round(most));
    this.say("speed", `${Math.round(speed)} mm/s: X ${inX}/${ofX} mm/s, Y ${inY}/${ofY}, C ${inC}/${ofC}°/s`);
    this.say("part", this.isAside ? "the blade does not pass the place that is shown"
      : `${named(piece)}, ${motion.unit} ${motion.cutsBegun(tick)} of ${motion.cuts.length}`);
    this.scrub.value = String(Math.round(tick));
    this.scrub.setAttribute("aria-valuetext", motion.clock(tick, 1));
  }

  /** @param {string} id @param {string} text */
  say(id, text) {
    const found = document.getElementById(id);
    if (found && found.textContent !== text) found.textContent = text;
  }

  /** @param {Mode} mode */
  setMode(mode) {
    this.colours.mode = mode;
    element("colours", HTMLSelectElement).value = mode;
    showLegend(this.colours.legend());
    this.cloth.renew();
    this.wake();
  }

  /** Draws all anew: the size or the style has changed. */
  renew() {
    this.cloth.renew();
    this.charts.renew();
    this.wake();
  }
}

/** A piece as the report names it. @param {Piece | undefined} piece */
function named(piece) { return piece?.title ?? "no piece yet"; }

/** Shows what colours mean. @param {Legend} legend */
function showLegend({ colours, words, bounds }) {
  const list = element("legend", HTMLElement);
  list.replaceChildren();
  if (words.length === 0 && colours.length > 0) {
    const bar = document.createElement("b");
    bar.style.background = `linear-gradient(90deg, ${colours.join()})`;
    list.append(bar);
  }
  words.forEach((word, i) => {
    const entry = document.createElement("span"), swatch = document.createElement("i");
    swatch.style.background = colours[i];
    entry.append(swatch, word);
    list.append(entry);
  });
  list.append(bounds);
}

/** What each key does. @param {Player} player @returns {Record<string, () => void>} */
function keys(player) {
  const { motion } = player, list = element("keys", HTMLDetailsElement);
  const toggle = (/** @type {string} */ id) => element(id, HTMLInputElement).click();
  return {
    "ArrowRight": () => player.step(motion.cuts, 1),
    "ArrowLeft": () => player.step(motion.cuts, -1),
    "Shift+ArrowRight": () => player.step(motion.pieces, 1),
    "Shift+ArrowLeft": () => player.step(motion.pieces, -1),
    ".": () => player.seek(Math.floor(player.tick) + 1),
    ",": () => player.seek(Math.ceil(player.tick) - 1),
    "Home": () => player.seek(0),
    "End": () => player.seek(motion.end),
    "f": () => toggle("following"),
    "t": () => toggle("travels"),
    "l": () => toggle("aside"),
    "p": () => toggle("names"),
    "m": () => toggle("marks"),
    "?": () => list.toggleAttribute("open") && list.scrollIntoView({ block: "nearest" }),
    "n": () => player.nextPlace(1),
    "Shift+N": () => player.nextPlace(-1),
  };
}

/** Has buttons, choices and keys move the player. @param {Player} player */
function connect(player) {
  const { motion } = player;
  player.connect(keys(player), BUTTONS);
  player.scrub.addEventListener("input", () => player.seek(Number(player.scrub.value)));
  const mode = element("colours", HTMLSelectElement);
  mode.addEventListener("change", () => player.setMode(/** @type {Mode} */ (mode.value)));
  /** @param {string} id @param {(on: boolean) => void} act */
  const check = (id, act) => {
    const box = element(id, HTMLInputElement);
    box.addEventListener("change", () => {
      act(box.checked);
      player.renew();
    });
  };
  for (const id of /** @type {(keyof Shown)[]} */ (["travels", "aside", "names", "marks"])) {
    check(id, on => { player.cloth.shown[id] = on; });
  }
  check("following", on => { player.following = on; });
  if (motion.facts.aside.length === 0) element("aside_label", HTMLElement).hidden = true;
  if (motion.facts.pieces.every(piece => piece.window === null)) mode.querySelector("[value=window]")?.remove();
}
