// The window onto the cloth: which part of it is shown how large, and how it is moved by mouse, touch and keys.

/** Greatest size of a millimetre, pixels, and the least in shares of that at which all is seen. */
const MOST_SCALE = 200, LEAST_SHARE = 0.5;
/** Free space around what is fitted, pixels. */
const MARGIN = 24;

class View {
  /** @param {HTMLElement} frame What is looked through. @param {() => void} changed */
  constructor(frame, changed) {
    this.frame = frame;
    this.changed = changed;
    /** Middle, mm, and size of a millimetre, pixels. */
    this.x = 0; this.y = 0; this.scale = 1;
    this.width = 1; this.height = 1;
    /** The origin of the cloth, on a whole pixel of the screen: what is drawn can be moved. */
    this.left = 0; this.top = 0;
    /** What is being drawn of the frame, pixels. @type {Box} */
    this.window = [0, 0, 1, 1];
    /** All there is to see, mm: its middle stays near. @type {Box} */
    this.whole = [0, 0, 1, 1];
  }

  /** Size of a millimetre at which a box fits. @param {Box} box */
  fitting([left, low, right, high]) {
    const across = (this.width - 2 * MARGIN) / Math.max(right - left, 1);
    return Math.max(1e-6, Math.min(MOST_SCALE, across, (this.height - 2 * MARGIN) / Math.max(high - low, 1)));
  }

  /** Size of the frame, pixels. */
  measure() {
    this.width = Math.max(1, this.frame.clientWidth);
    this.height = Math.max(1, this.frame.clientHeight);
    this.window = [0, 0, this.width, this.height];
    this.place();
  }

  place() {
    const ratio = globalThis.devicePixelRatio || 1;
    const whole = (/** @type {number} */ px) => Math.round(px * ratio) / ratio;
    this.left = whole(this.width / 2 - this.x * this.scale);
    this.top = whole(this.height / 2 + this.y * this.scale);
  }

  /** @param {number} x */
  px(x) { return this.left + x * this.scale; }
  /** @param {number} y */
  py(y) { return this.top - y * this.scale; }
  /** @param {number} px */
  mmX(px) { return (px - this.width / 2) / this.scale + this.x; }
  /** @param {number} py */
  mmY(py) { return (this.height / 2 - py) / this.scale + this.y; }

  /** Whether some of a box is seen. @param {Box} box */
  sees([left, low, right, high]) {
    const [first, top, last, bottom] = this.window, near = 20;
    const inWidth = this.px(right) > first - near && this.px(left) < last + near;
    return inWidth && this.py(low) > top - near && this.py(high) < bottom + near;
  }

  /** Shows a box as large as it fits. @param {Box} box */
  fit(box) {
    const [left, low, right, high] = box;
    this.scale = this.fitting(box);
    this.moveTo((left + right) / 2, (low + high) / 2);
  }

  /** Shows a place in the middle. @param {number} x @param {number} y */
  moveTo(x, y) {
    const [left, low, right, high] = this.whole;
    this.x = Math.min(right + 200, Math.max(left - 200, x));
    this.y = Math.min(high + 200, Math.max(low - 200, y));
    this.place();
    this.changed();
  }

  /** Moves the cloth by pixels. @param {number} dx @param {number} dy */
  pan(dx, dy) { this.moveTo(this.x - dx / this.scale, this.y + dy / this.scale); }

  /**
   * Changes the size, a place of the window staying where it is.
   * @param {number} factor @param {number} [px] @param {number} [py]
   */
  zoom(factor, px = this.width / 2, py = this.height / 2) {
    const x = this.mmX(px), y = this.mmY(py);
    this.scale = Math.min(MOST_SCALE, Math.max(LEAST_SHARE * this.fitting(this.whole), this.scale * factor));
    this.moveTo(x - (px - this.width / 2) / this.scale, y + (py - this.height / 2) / this.scale);
  }
}

/**
 * Has a frame moved by mouse, touch and wheel.
 * @param {View} view @param {(px: number, py: number) => void} clicked Called for a press that moves nothing.
 */
function steer(view, clicked) {
  /** Fingers or the mouse that are down, by their ids. @type {Map<number, {x: number, y: number}>} */
  const down = new Map();
  let moved = 0;
  const { frame } = view;
  const place = (/** @type {MouseEvent} */ event) => {
    const box = frame.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  };
  frame.addEventListener("pointerdown", event => {
    frame.setPointerCapture(event.pointerId);
    if (down.size === 0) moved = 0;
    down.set(event.pointerId, place(event));
  });
  frame.addEventListener("pointermove", event => {
    const before = down.get(event.pointerId), now = place(event);
    if (!before) return;
    moved += Math.hypot(now.x - before.x, now.y - before.y);
    if (down.size === 1) {
      // A finger alone scrolls the page.
      if (moved > 4 && event.pointerType !== "touch") view.pan(now.x - before.x, now.y - before.y);
    } else {
      const other = [...down].find(([id]) => id !== event.pointerId)?.[1] ?? now;
      /** @param {{x: number, y: number}} at */
      const apart = at => Math.max(1, Math.hypot(at.x - other.x, at.y - other.y));
      view.pan((now.x - before.x) / 2, (now.y - before.y) / 2);
      view.zoom(apart(now) / apart(before), (now.x + other.x) / 2, (now.y + other.y) / 2);
    }
    down.set(event.pointerId, now);
  });
  const up = (/** @type {PointerEvent} */ event) => {
    const at = down.get(event.pointerId);
    down.delete(event.pointerId);
    if (event.type === "pointerup" && at && down.size === 0 && moved <= 4) clicked(at.x, at.y);
  };
  frame.addEventListener("pointerup", up);
  frame.addEventListener("pointercancel", up);
  frame.addEventListener("touchstart", event => {
    if (event.touches.length > 1) event.preventDefault();
  }, { passive: false });
  frame.addEventListener("wheel", event => {
    event.preventDefault();
    const { x, y } = place(event);
    const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 16 : 1;
    view.zoom(Math.exp(-event.deltaY * lines / 400), x, y);
  }, { passive: false });
}
