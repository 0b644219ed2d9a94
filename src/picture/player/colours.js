// Colours of pieces and of the trail, by what people ask for.

/** Colours of like weight for things that stand beside each other. */
const PALETTE = [
  "#3f78b5", "#4c9a3f", "#9068c0", "#a8693a", "#22918f", "#98962a", "#6470d6", "#c2695a", "#4b8a69", "#8095bd",
];
/** Colours from little to much. */
const SCALE = [
  "#3b4cc0", "#4a69d6", "#5f86e6", "#77a2ee", "#4fb3bf", "#3fb38a", "#5fb454",
  "#96b53a", "#c9ae2f", "#e39a2c", "#e8792c", "#dd5530", "#c4302f", "#9c1632",
];
/** Names of the axes in columns. */
const AXIS_NAMES = ["x", "y", "c"];
/** Colours of what bounds a cut: X, Y, C, nothing of these. */
const AXES = ["#2f7ed8", "#2fa35a", "#d9822b", "#8d939c"];
/** From this share of a limit on an axis is said to be at it. */
const AT_LIMIT = 0.92;

/** @typedef {"piece" | "order" | "speed" | "axis" | "heading" | "window"} Mode */
/** @typedef {{colours: string[], words: string[], bounds: string}} Legend */

class Colours {
  /** @param {Motion} motion @param {Trail} trail */
  constructor(motion, trail) {
    this.motion = motion;
    this.trail = trail;
    /** @type {Mode} */
    this.mode = "piece";
    /** Colour of each point of the trail, where it has one of its own. @type {Map<Mode, Uint8Array>} */
    this.known = new Map();
  }

  /** Colours that the numbers of the trail stand for. */
  get table() {
    return this.mode === "axis" ? AXES : this.mode === "piece" || this.mode === "window" ? PALETTE : SCALE;
  }

  /** Colour of a piece by its place in the marker. @param {number} part */
  ofPiece(part) {
    const { pieces } = this.motion.facts;
    if (this.mode === "order") return SCALE[step(part / Math.max(1, pieces.length - 1))];
    if (this.mode === "window") return PALETTE[(pieces[part]?.window ?? 0) % PALETTE.length];
    return PALETTE[(pieces[part]?.whole ?? part) % PALETTE.length];
  }

  /**
   * Colour of each point of the trail, by its place in the table; `null` where strokes have the colour of their piece.
   * @returns {Uint8Array | null}
   */
  ofTrail() {
    if (this.mode === "piece" || this.mode === "order" || this.mode === "window") return null;
    let found = this.known.get(this.mode);
    if (!found) {
      found = this.measure();
      this.known.set(this.mode, found);
    }
    return found;
  }

  measure() {
    const { tick } = this.trail, { motion } = this;
    if (this.mode === "axis") {
      const curves = AXIS_NAMES.map(axis => ["speed", "acc", "jerk"].map(order => motion.curve(`${order}_${axis}`)));
      return Uint8Array.from(tick, at => bound(curves, Math.floor(at / motion.facts.peak_ticks)));
    }
    const speed = this.mode === "speed";
    const values = new Float64Array(tick.length);
    for (const { first, end } of this.trail.strokes) {
      // The first two points are heel and tip of the blade that plunges.
      for (let i = first + 2; i < end; i++) {
        const middle = (tick[i - 1] + tick[i]) / 2;
        values[i] = speed ? motion.tipSpeed(middle) : Math.abs(motion.at(middle, true).c);
      }
    }
    const most = Math.max(1e-9, values.reduce((a, b) => Math.max(a, b), 0));
    if (speed) this.fastest = most; else this.sharpest = most;
    return Uint8Array.from(values, value => step(value / most));
  }

  /** What the colours mean. @returns {Legend} */
  legend() {
    this.ofTrail();
    switch (this.mode) {
      case "axis":
        return { colours: AXES, words: ["X at a limit", "Y at a limit", "C at a limit", "other"], bounds: "" };
      case "order": return { colours: SCALE, words: [], bounds: "first piece to last" };
      case "speed": return { colours: SCALE, words: [], bounds: `0 to ${Math.round(this.fastest ?? 0)} mm/s` };
      case "heading": return { colours: SCALE, words: [], bounds: `0 to ${Math.round(this.sharpest ?? 0)}°/s` };
      case "window": {
        const windows = new Set(this.motion.facts.pieces.map(piece => piece.window ?? 0));
        const shown = [...windows].slice(0, PALETTE.length), words = shown.map(window => `window ${window + 1}`);
        return { colours: shown.map(window => PALETTE[window % PALETTE.length]), words, bounds: "" };
      }
      case "piece": return { colours: [], words: [], bounds: "a colour a piece" };
    }
  }

  /** Speed and heading rate that the scale ends with. @type {number | undefined} */
  fastest;
  /** @type {number | undefined} */
  sharpest;
}

/** Place in the scale of a share of all. @param {number} share */
function step(share) {
  return Math.min(SCALE.length - 1, Math.max(0, Math.floor(share * SCALE.length)));
}

/**
 * Which axis is at one of its limits in a stretch of time: 0 to 2, or 3 for none.
 * @param {Curve[][]} curves Those of each axis. @param {number} stretch
 */
function bound(curves, stretch) {
  let best = 3, worst = AT_LIMIT;
  curves.forEach((orders, axis) => {
    for (const { least, most } of orders) {
      const share = Math.max(-least[stretch], most[stretch]);
      if (share > worst) [best, worst] = [axis, share];
    }
  });
  return best;
}
