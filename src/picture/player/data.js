// Facts and columns of the page, as they were written.

/** @typedef {[number, number, number, number]} Box Left, lower, right and upper edge, mm. */
/**
 * @typedef {object} Piece A piece, or an early section of one that windows of a conveyor split.
 * @property {number} whole Its place in the marker, of a section that of its piece.
 * @property {string} number
 * @property {string} name
 * @property {string} title Both of them, as the report has them.
 * @property {number | null} window
 * @property {Box | null} extent
 */
/**
 * @typedef {object} Facts
 * @property {number} period_s
 * @property {number} ticks
 * @property {number} peak_ticks
 * @property {{width_mm: number, tip_mm: number, heel_mm: number}} knife
 * @property {{cut: number[][], travel: number[][]}} limits Speed, acceleration and jerk of X, Y (mm) and C (degrees).
 * @property {boolean} has_common Whether edges are cut once for two pieces.
 * @property {Box | null} extent
 * @property {string[]} aside
 * @property {Piece[]} pieces
 * @property {number | null} window_mm Length of the window of a conveyor; `null` where the cloth lies still.
 * @property {[number, number][]} broken Places of broken rules and of errors, mm.
 * @property {[number, number][]} warned Places of warnings, mm.
 * @property {[number, number][]} declared Places of declared deviations, mm.
 * @property {[string, number, number][]} columns Name, length and unit.
 */
/** @typedef {Record<string, Float64Array>} Columns */

/** An element of the page. @template {HTMLElement} T @param {string} id @param {new () => T} type @returns {T} */
function element(id, type) {
  const found = document.getElementById(id);
  if (!(found instanceof type)) throw new Error(`the page has no ${id}`);
  return found;
}

/** A time as people say it, as in `2 min 05.3 s`. @param {number} seconds @param {number} decimals */
function clock(seconds, decimals) {
  const text = seconds.toFixed(decimals), minutes = Math.floor(Number(text) / 60);
  if (minutes === 0) return `${text} s`;
  const rest = (Number(text) - 60 * minutes).toFixed(decimals);
  return `${minutes} min ${rest.padStart(decimals ? decimals + 3 : 2, "0")} s`;
}

/** Bytes behind base64 and deflate. @param {string} text @returns {Promise<Uint8Array>} */
async function unpack(text) {
  const letters = atob(text.trim()), packed = new Uint8Array(letters.length);
  for (let i = 0; i < packed.length; i++) packed[i] = letters.charCodeAt(i);
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/**
 * Columns of differences, each in groups of seven bits, as numbers.
 * @param {Uint8Array} bytes @param {[string, number, number][]} names @returns {Columns}
 */
function readColumns(bytes, names) {
  /** @type {Columns} */
  const columns = {};
  let at = 0;
  for (const [name, count, unit] of names) {
    const column = new Float64Array(count);
    let sum = 0;
    for (let i = 0; i < count; i++) {
      let value = 0, weight = 1;
      for (;;) {
        const byte = bytes[at++];
        value += (byte & 0x7f) * weight;
        if (byte < 0x80) break;
        weight *= 128;
      }
      sum += value % 2 ? -(value + 1) / 2 : value / 2;
      column[i] = sum * unit;
    }
    columns[name] = column;
  }
  return columns;
}

/**
 * Place of the last number of a sorted column that is at most `value`; 0 when all are greater.
 * @param {Float64Array} column @param {number} value
 */
function lastUpTo(column, value) {
  let low = 0, high = column.length;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (column[middle] <= value) low = middle; else high = middle;
  }
  return low;
}

/** How many numbers of a sorted column are at most `value`. @param {Float64Array} column @param {number} value */
function countUpTo(column, value) { return column[0] <= value ? lastUpTo(column, value) + 1 : 0; }

/**
 * Box of some points.
 * @param {Float64Array} x @param {Float64Array} y @param {number} [first] @param {number} [end] One past the last.
 */
function boxOf(x, y, first = 0, end = x.length) {
  /** @type {Box} */
  const box = [Infinity, Infinity, -Infinity, -Infinity];
  for (let i = first; i < end; i++) {
    box[0] = Math.min(box[0], x[i]);
    box[1] = Math.min(box[1], y[i]);
    box[2] = Math.max(box[2], x[i]);
    box[3] = Math.max(box[3], y[i]);
  }
  return box;
}

/** Starts a page, and says in it what kept it from starting. @param {() => Promise<void>} start */
function begin(start) {
  start().catch(error => {
    const place = document.getElementById("loading");
    if (place) place.textContent = `The page cannot be played: ${error}`;
    throw error;
  });
}

/** Columns of the page. @param {[string, number, number][]} names */
async function pageColumns(names) {
  if (typeof DecompressionStream === "undefined") throw new Error("this browser is too old");
  return readColumns(await unpack(element("columns", HTMLScriptElement).text), names);
}
