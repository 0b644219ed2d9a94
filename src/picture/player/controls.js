// Buttons, choices and keys of the player.

/** Speeds of playing, in times of the real one. */
const RATES = [0.05, 0.1, 0.25, 0.5, 1, 2, 5, 10, 25, 60, 150];
/** How far a key moves the cloth, pixels. */
const KEY_PAN = 60;
const KEY_ZOOM = 1.3;
/** What happens in phases, by their kinds. */
const WORDS = ["rest", "wait", "travel", "turn", "plunge", "cut", "lift", "stop", "advance"];
/** Buttons that do what a key does. */
const BUTTONS = {
  play: " ", cut_next: "ArrowRight", cut_before: "ArrowLeft", piece_next: "Shift+ArrowRight",
  piece_before: "Shift+ArrowLeft", zoom_in: "+", zoom_out: "-", zoom_fit: "0",
};

class Player {
  /** @param {Motion} motion @param {Colours} colours */
  constructor(motion, colours) {
    this.motion = motion;
    this.colours = colours;
    this.tick = 0;
    this.playing = false;
    this.rate = 1;
    this.following = false;
    /** Jumps of the report, for the keys that go through them. */
    this.jump = -1;
    this.view = new View(element("cloth", HTMLElement), () => {
      this.cloth.renew();
      this.wake();
    });
    this.cloth = new Cloth(motion, colours, this.view);
    this.charts = new Charts(motion, tick => this.seek(tick));
    this.awake = false;
    this.before = 0;
    this.scrub = element("scrub", HTMLInputElement);
    this.scrub.max = String(motion.end);
  }

  /** Has a frame be drawn. */
  wake() {
    if (this.awake) return;
    this.awake = true;
    requestAnimationFrame(now => this.frame(now));
  }

  /** Draws a frame; the next one follows while it plays. @param {number} now */
  frame(now) {
    this.awake = false;
    if (this.playing) {
      const elapsed = this.before ? Math.min(0.25, (now - this.before) / 1000) : 0;
      this.tick = Math.min(this.motion.end, this.tick + elapsed * this.rate / this.motion.period);
      this.before = now;
      if (this.tick >= this.motion.end) this.play(false);
    }
    if (this.following) this.follow();
    this.cloth.draw(this.tick);
    this.charts.draw(this.tick);
    this.tell();
    if (this.playing) this.wake();
  }

  /** Keeps the blade in the window. */
  follow() {
    const [x, y] = this.motion.blade(this.tick, 0), { view } = this;
    const isAmid = (/** @type {number} */ share) => share > 0.2 && share < 0.8;
    if (!isAmid(view.px(x) / view.width) || !isAmid(view.py(y) / view.height)) view.moveTo(x, y);
  }

  /** @param {boolean} on */
  play(on) {
    if (on && this.tick >= this.motion.end) this.tick = 0;
    this.playing = on;
    this.before = 0;
    const button = element("play", HTMLButtonElement);
    button.textContent = on ? "Pause" : "Play";
    button.setAttribute("aria-pressed", String(on));
    this.wake();
  }

  /** Goes to a tick. @param {number} tick */
  seek(tick) {
    this.tick = Math.min(this.motion.end, Math.max(0, tick));
    this.wake();
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
    const first = this.motion.pieces.find(phase => this.motion.columns.phase_part[phase] === part);
    if (first !== undefined && show) this.seek(this.motion.start(first));
    const box = this.motion.facts.pieces[part]?.extent;
    if (box && show && !this.view.sees(box)) this.view.fit(box);
    this.wake();
  }

  /**
   * Goes to a place of the cloth, and to its time if that is known.
   * @param {number} x @param {number} y @param {number | null} time
   */
  goToPlace(x, y, time) {
    this.play(false);
    this.cloth.spot = [x, y];
    const near = 40;
    this.view.fit([x - near, y - near, x + near, y + near]);
    if (time !== null) this.seek(time / this.motion.period);
    element("player", HTMLElement).scrollIntoView({ block: "start" });
  }

  /** Goes through the places of the report. @param {number} by */
  nextPlace(by) {
    const buttons = [...document.querySelectorAll("button.jump")];
    if (buttons.length === 0) return;
    this.jump = (this.jump + by + buttons.length) % buttons.length;
    const button = buttons[this.jump];
    if (button instanceof HTMLButtonElement) button.click();
  }

  /** Shows the whole marker. */
  fit() {
    this.view.measure();
    this.view.fit(this.cloth.box);
  }

  /** Says what happens at the cursor. */
  tell() {
    const { motion, tick } = this, { x, y, c } = motion.at(tick), phase = motion.phase(tick);
    const kind = motion.columns.phase_kind[phase], part = motion.columns.phase_part[phase];
    const words = WORDS[kind] ?? `drill ${kind - KIND.drill}`;
    const piece = motion.facts.pieces[part], named = [piece?.number, piece?.name].filter(Boolean).join(" ");
    const rates = motion.at(tick, true);
    const speed = kind === KIND.cut ? motion.tipSpeed(tick) : Math.hypot(rates.x, rates.y);
    const block = motion.block(tick);
    this.say("time", `${(tick * motion.period).toFixed(3)} / ${motion.duration.toFixed(1)} s`);
    this.say("does", words + (block ? `, block ${block}` : ""));
    this.say("axes", `X ${x.toFixed(2)}  Y ${y.toFixed(2)}  C ${c.toFixed(2)}°`);
    this.say("speed", `${speed.toFixed(0)} mm/s, C ${rates.c.toFixed(0)}°/s`);
    this.say("part", `piece ${named}, cut ${motion.cutsBegun(tick)} of ${motion.cuts.length}`);
    this.scrub.value = String(Math.round(tick));
    this.scrub.setAttribute("aria-valuetext", `${(tick * motion.period).toFixed(1)} seconds`);
  }

  /** @param {string} id @param {string} text */
  say(id, text) {
    const found = document.getElementById(id);
    if (found && found.textContent !== text) found.textContent = text;
  }

  /** @param {number} by Steps of the list of speeds. */
  changeRate(by) {
    const next = RATES[Math.min(RATES.length - 1, Math.max(0, RATES.indexOf(this.rate) + by))];
    this.setRate(next);
  }

  /** @param {number} rate */
  setRate(rate) {
    this.rate = rate;
    element("rate", HTMLSelectElement).value = String(rate);
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

/** Shows what colours mean. @param {Legend} legend */
function showLegend({ colours, words, bounds }) {
  const list = element("legend", HTMLElement);
  list.replaceChildren();
  if (words.length === 0 && colours.length > 0) {
    const bar = document.createElement("canvas");
    [bar.width, bar.height] = [colours.length * 8, 10];
    const to = context(bar);
    colours.forEach((colour, i) => {
      to.fillStyle = colour;
      to.fillRect(8 * i, 0, 8, 10);
    });
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
  const { motion, view } = player;
  const toggle = (/** @type {string} */ id) => element(id, HTMLInputElement).click();
  return {
    " ": () => player.play(!player.playing),
    "ArrowRight": () => player.step(motion.cuts, 1),
    "ArrowLeft": () => player.step(motion.cuts, -1),
    "Shift+ArrowRight": () => player.step(motion.pieces, 1),
    "Shift+ArrowLeft": () => player.step(motion.pieces, -1),
    ".": () => player.seek(Math.floor(player.tick) + 1),
    ",": () => player.seek(Math.ceil(player.tick) - 1),
    "Home": () => player.seek(0),
    "End": () => player.seek(motion.end),
    "]": () => player.changeRate(1),
    "[": () => player.changeRate(-1),
    "+": () => view.zoom(KEY_ZOOM),
    "=": () => view.zoom(KEY_ZOOM),
    "-": () => view.zoom(1 / KEY_ZOOM),
    "0": () => player.fit(),
    "w": () => view.pan(0, KEY_PAN),
    "s": () => view.pan(0, -KEY_PAN),
    "a": () => view.pan(KEY_PAN, 0),
    "d": () => view.pan(-KEY_PAN, 0),
    "f": () => toggle("following"),
    "t": () => toggle("travels"),
    "l": () => toggle("aside"),
    "n": () => player.nextPlace(1),
    "Shift+N": () => player.nextPlace(-1),
  };
}

/** Has buttons, choices and keys move the player. @param {Player} player */
function connect(player) {
  const { motion, view } = player, known = keys(player);
  for (const [id, key] of Object.entries(BUTTONS)) element(id, HTMLButtonElement).addEventListener("click", known[key]);
  player.scrub.addEventListener("input", () => player.seek(Number(player.scrub.value)));
  const rate = element("rate", HTMLSelectElement);
  rate.append(...RATES.map(value => new Option(`${value}×`, String(value), value === 1, value === 1)));
  rate.addEventListener("change", () => player.setRate(Number(rate.value)));
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
  steer(view, (px, py) => player.goToPiece(player.cloth.pieceAt(px, py), false));
  document.addEventListener("keydown", event => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const on = event.target;
    if (on instanceof HTMLSelectElement || (on instanceof HTMLInputElement && on.type === "text")) return;
    if (on instanceof HTMLButtonElement && event.key === " ") return;
    const isLetter = event.key.length === 1, key = isLetter && !event.shiftKey ? event.key.toLowerCase() : event.key;
    const act = known[event.shiftKey ? `Shift+${key}` : key] ?? (isLetter ? known[key] : undefined);
    if (!act) return;
    event.preventDefault();
    act();
  });
  if (motion.facts.aside.length === 0) element("aside_label", HTMLElement).hidden = true;
  if (motion.facts.pieces.every(piece => piece.window === null)) {
    for (const option of [...mode.options]) if (option.value === "window") option.remove();
  }
}
