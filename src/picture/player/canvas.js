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

/** A colour of the style. @param {string} name */
function themed(name) { return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim(); }
