// The stage of a page that plays: a clock, its buttons and keys, and a window onto the cloth.

/** How far a key moves the cloth, pixels. */
const KEY_PAN = 60;
const KEY_ZOOM = 1.3;

class Stage {
  /**
   * @param {number[]} rates Speeds, in times of the real one. @param {number} rate The first of them that holds.
   * @param {() => Box} box What the window shows at first.
   * @param {(elapsed: number) => void} draw Draws a frame so many seconds later, at the speed that was chosen.
   * @param {(px: number, py: number) => void} [clicked] Called for a press that moves nothing.
   */
  constructor(rates, rate, box, draw, clicked = () => {}) {
    this.rates = rates;
    this.rate = rate;
    this.playing = false;
    this.awake = false;
    this.before = 0;
    /** Called before it plays: what is at its end begins anew. */
    this.rewind = () => {};
    this.drawFrame = draw;
    this.box = box;
    this.frame = element("cloth", HTMLElement);
    this.view = new View(this.frame, () => this.wake());
    /** Scale at which all is seen, while the window is left so. */
    this.fitted = -1;
    this.scrub = element("scrub", HTMLInputElement);
    this.rateChoice = element("rate", HTMLSelectElement);
    this.rateChoice.append(...rates.map(value => new Option(`${value}×`, String(value))));
    this.rateChoice.addEventListener("change", () => this.setRate(Number(this.rateChoice.value)));
    this.setRate(rate);
    steer(this.view, clicked);
  }

  /**
   * Has buttons, keys, the size of the window and the style of the page act.
   * @param {Record<string, () => void>} [keys] Keys beside those of every stage.
   * @param {Record<string, string>} [buttons] Buttons that do what a key does.
   */
  connect(keys = {}, buttons = {}) {
    const { view } = this;
    /** @type {Record<string, () => void>} */
    const known = {
      " ": () => this.play(!this.playing),
      "]": () => this.changeRate(1),
      "[": () => this.changeRate(-1),
      "+": () => view.zoom(KEY_ZOOM),
      "=": () => view.zoom(KEY_ZOOM),
      "-": () => view.zoom(1 / KEY_ZOOM),
      "0": () => this.fit(),
      "w": () => view.pan(0, KEY_PAN),
      "s": () => view.pan(0, -KEY_PAN),
      "a": () => view.pan(KEY_PAN, 0),
      "d": () => view.pan(-KEY_PAN, 0),
      ...keys,
    };
    for (const [id, key] of Object.entries({ play: " ", zoom_in: "+", zoom_out: "-", zoom_fit: "0", ...buttons })) {
      element(id, HTMLButtonElement).addEventListener("click", known[key]);
    }
    document.addEventListener("keydown", event => {
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      // A control that has the focus takes its own keys.
      const takers = event.key === " " ? "button, summary, select, input:not([type=range])" : "select, [type=search]";
      if (event.target instanceof Element && event.target.matches(takers)) return;
      const isLetter = event.key.length === 1, key = isLetter && !event.shiftKey ? event.key.toLowerCase() : event.key;
      const act = known[event.shiftKey ? `Shift+${key}` : key] ?? (isLetter ? known[key] : undefined);
      if (!act) return;
      event.preventDefault();
      act();
    });
    this.fit();
    new ResizeObserver(() => {
      view.measure();
      // A window that shows the whole goes on showing it.
      if (view.scale === this.fitted) this.fit();
      this.renew();
    }).observe(this.frame);
    for (const query of ["(prefers-color-scheme: dark)", "print"]) {
      matchMedia(query).addEventListener("change", () => this.renew());
    }
  }

  /** Draws all anew: the size or the style has changed. */
  renew() { this.wake(); }

  /** Shows all. */
  fit() {
    this.view.measure();
    this.view.whole = this.box();
    this.view.fit(this.view.whole);
    this.fitted = this.view.scale;
  }

  /** @param {boolean} on */
  play(on) {
    if (on) this.rewind();
    this.playing = on;
    this.before = 0;
    const button = element("play", HTMLButtonElement);
    button.textContent = on ? "Pause" : "Play";
    button.setAttribute("aria-pressed", String(on));
    this.wake();
  }

  /** @param {number} rate */
  setRate(rate) {
    this.rate = rate;
    this.rateChoice.value = String(rate);
  }

  /** @param {number} by Steps of the list of speeds. */
  changeRate(by) {
    const { rates } = this;
    this.setRate(rates[Math.min(rates.length - 1, Math.max(0, rates.indexOf(this.rate) + by))]);
  }

  /** Has a frame be drawn; the next one follows while it plays. */
  wake() {
    if (this.awake) return;
    this.awake = true;
    requestAnimationFrame(now => {
      this.awake = false;
      const elapsed = this.playing && this.before ? Math.min(0.25, (now - this.before) / 1000) : 0;
      this.before = now;
      forgetColours();
      this.drawFrame(elapsed * this.rate);
      if (this.playing) this.wake();
    });
  }

  /** @param {string} time @param {string} told */
  tell(time, told) {
    element("time", HTMLOutputElement).textContent = time;
    element("told", HTMLElement).textContent = told;
  }
}
