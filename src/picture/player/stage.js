// The stage of pages that play other machines: a clock, its buttons and keys, and a window onto the cloth.

class Stage {
  /**
   * @param {number[]} rates Speeds, in times of the real one. @param {number} rate The first of them that holds.
   * @param {() => Box} box What the window shows at first.
   * @param {(elapsed: number) => void} draw Draws a frame so many seconds later, at the speed that was chosen.
   */
  constructor(rates, rate, box, draw) {
    this.rate = rate;
    this.playing = false;
    this.awake = false;
    this.before = 0;
    /** Called before it plays: what is at its end begins anew. */
    this.rewind = () => {};
    this.draw = draw;
    this.box = box;
    this.frame = element("cloth", HTMLElement);
    this.view = new View(this.frame, () => this.wake());
    this.scrub = element("scrub", HTMLInputElement);
    const choice = element("rate", HTMLSelectElement);
    choice.append(...rates.map(value => new Option(`${value}×`, String(value), value === rate, value === rate)));
    choice.addEventListener("change", () => { this.rate = Number(choice.value); });
    steer(this.view, () => {});
    this.connect();
  }

  connect() {
    /** @type {Record<string, () => void>} */
    const keys = {
      " ": () => this.play(!this.playing), "+": () => this.view.zoom(1.3), "-": () => this.view.zoom(1 / 1.3),
      "0": () => this.fit(),
    };
    for (const [id, key] of [["play", " "], ["zoom_in", "+"], ["zoom_out", "-"], ["zoom_fit", "0"]]) {
      element(id, HTMLButtonElement).addEventListener("click", keys[key]);
    }
    document.addEventListener("keydown", event => {
      const isTyped = event.target instanceof HTMLSelectElement || event.target instanceof HTMLButtonElement;
      if (isTyped || event.ctrlKey || event.metaKey || event.altKey || !keys[event.key]) return;
      event.preventDefault();
      keys[event.key]();
    });
    new ResizeObserver(() => this.fit()).observe(this.frame);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.wake());
  }

  /** Shows all. */
  fit() {
    this.view.measure();
    this.view.fit(this.box());
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

  /** Has a frame be drawn. */
  wake() {
    if (this.awake) return;
    this.awake = true;
    requestAnimationFrame(now => {
      this.awake = false;
      const elapsed = this.playing && this.before ? Math.min(0.25, (now - this.before) / 1000) : 0;
      this.before = now;
      this.draw(elapsed * this.rate);
      if (this.playing) this.wake();
    });
  }

  /** @param {string} time @param {string} told */
  tell(time, told) {
    element("time", HTMLOutputElement).textContent = time;
    element("told", HTMLElement).textContent = told;
  }
}
