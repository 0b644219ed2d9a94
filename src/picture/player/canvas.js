// Canvases, as sharp as the screen, in the colours of the style.

/** The context of a canvas. @param {HTMLCanvasElement} canvas */
function context(canvas) {
  const found = canvas.getContext("2d");
  if (!found) throw new Error("this browser draws no canvas");
  return found;
}

/**
 * Makes a canvas as sharp as the screen.
 * @param {HTMLCanvasElement} canvas @param {number} width @param {number} height
 */
function sharpen(canvas, width, height) {
  const ratio = globalThis.devicePixelRatio || 1;
  const [w, h] = [Math.round(width * ratio), Math.round(height * ratio)];
  if (canvas.width !== w || canvas.height !== h) [canvas.width, canvas.height] = [w, h];
  const to = context(canvas);
  to.setTransform(ratio, 0, 0, ratio, 0, 0);
  to.clearRect(0, 0, width, height);
  return to;
}

/** Colours of the style as long as a frame is drawn, by their names. @type {Map<string, string>} */
const palette = new Map();

/** Has colours be asked for anew: the style may have changed since the last frame. */
function forgetColours() { palette.clear(); }

/** A colour of the style. @param {string} name */
function themed(name) {
  let colour = palette.get(name);
  if (colour === undefined) {
    colour = getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
    palette.set(name, colour);
  }
  return colour;
}

/**
 * @typedef {object} Writing
 * @property {number} size Pixels.
 * @property {number} weight
 * @property {string} colour
 * @property {CanvasTextAlign} align
 * @property {CanvasTextBaseline} baseline
 */

/**
 * Writes a text of some pixels in a colour of the style.
 * @param {CanvasRenderingContext2D} to @param {string} text @param {[number, number]} at
 * @param {Partial<Writing>} [how]
 */
function write(to, text, [x, y], how = {}) {
  const { size = 11, weight = 400, colour = "quiet", align = "left", baseline = "middle" } = how;
  to.font = `${weight} ${size}px system-ui, sans-serif`;
  to.fillStyle = themed(colour);
  to.textAlign = align;
  to.textBaseline = baseline;
  to.fillText(text, x, y);
}

/**
 * Draws a line through points in a colour of the style.
 * @param {CanvasRenderingContext2D} to @param {[number, number][]} points
 * @param {string} colour @param {number} width
 */
function drawLine(to, points, colour, width) {
  to.strokeStyle = themed(colour);
  to.lineWidth = width;
  to.beginPath();
  for (const [x, y] of points) to.lineTo(x, y);
  to.stroke();
}

/**
 * Draws a ring in a colour of the style.
 * @param {CanvasRenderingContext2D} to @param {[number, number]} at @param {number} radius Pixels.
 * @param {string} colour @param {number} width
 */
function drawRing(to, [x, y], radius, colour, width) {
  to.strokeStyle = themed(colour);
  to.lineWidth = width;
  to.beginPath();
  to.arc(x, y, radius, 0, 2 * Math.PI);
  to.stroke();
}

/**
 * Moves what a canvas shows and has the strips drawn that come into view.
 * @param {HTMLCanvasElement} canvas @param {View} view
 * @param {[number, number]} by Pixels to the right and down, whole ones of the screen.
 * @param {(to: CanvasRenderingContext2D) => void} draw Draws what the window of the view shows.
 */
function scroll(canvas, view, [dx, dy], draw) {
  const to = context(canvas), ratio = globalThis.devicePixelRatio || 1, { width, height } = view;
  to.save();
  to.setTransform(1, 0, 0, 1, 0, 0);
  to.globalCompositeOperation = "copy";
  to.drawImage(canvas, Math.round(dx * ratio), Math.round(dy * ratio));
  to.restore();
  /** @type {Box[]} */
  const strips = [
    [dx > 0 ? 0 : width + dx, 0, dx > 0 ? dx : width, height],
    [0, dy > 0 ? 0 : height + dy, width, dy > 0 ? dy : height],
  ];
  for (const [left, top, right, bottom] of strips) {
    if (right <= left || bottom <= top) continue;
    to.save();
    to.beginPath();
    to.rect(left, top, right - left, bottom - top);
    to.clip();
    to.clearRect(left, top, right - left, bottom - top);
    view.window = [left, top, right, bottom];
    draw(to);
    to.restore();
  }
  view.window = [0, 0, width, height];
}
