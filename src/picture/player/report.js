// The report: tables that are sorted and searched, rows that lead to the cloth.

/** Rows from which on a table is searched. */
const MANY_ROWS = 10;
/** What of a row is searched: texts, marks, and codes of messages. Their words name other pieces. */
const SEARCHED = "td:not(.number, .count), .marks, .count code";

/**
 * Value of a cell to sort by: its number, or its text.
 * @param {HTMLTableRowElement} row @param {number} column @returns {number | string}
 */
function sortValue(row, column) {
  const cell = row.cells[column];
  return cell.dataset.value === undefined ? cell.textContent?.trim() ?? "" : Number(cell.dataset.value);
}

/**
 * Order of two rows by a column; texts as people order them, with numbers in them as numbers.
 * @param {HTMLTableRowElement} a @param {HTMLTableRowElement} b @param {number} column
 */
function byColumn(a, b, column) {
  const [x, y] = [sortValue(a, column), sortValue(b, column)];
  if (typeof x === "number" && typeof y === "number") return x - y;
  return String(x).localeCompare(String(y), "en", { numeric: true });
}

/** Has every head of a sortable table sort by its column, up and down in turn. */
function makeSortable() {
  for (const table of /** @type {NodeListOf<HTMLTableElement>} */ (document.querySelectorAll("table.sortable"))) {
    const body = table.tBodies[0];
    const heads = [...table.querySelectorAll("thead th")];
    heads.forEach((head, column) => {
      const button = document.createElement("button");
      Object.assign(button, { type: "button", textContent: head.textContent });
      head.replaceChildren(button);
      button.addEventListener("click", () => {
        // Numbers begin with the greatest, texts with A.
        const before = head.getAttribute("aria-sort"), isNumber = head.classList.contains("number");
        const down = before ? before === "ascending" : isNumber;
        heads.forEach(other => other.removeAttribute("aria-sort"));
        head.setAttribute("aria-sort", down ? "descending" : "ascending");
        body.append(...[...body.rows].toSorted((a, b) => byColumn(a, b, column) * (down ? -1 : 1)));
      });
    });
    if (body.rows.length >= MANY_ROWS) table.parentElement?.before(searchField(body));
  }
}

/** A field whose words, and numbers as a whole, the rows that are shown hold. @param {HTMLTableSectionElement} body */
function searchField(body) {
  const field = document.createElement("input");
  Object.assign(field, { type: "search", placeholder: "Search", ariaLabel: "Search the rows" });
  field.addEventListener("input", () => {
    // A number belongs to the word before it, and is meant as a whole.
    const words = plain(field.value).match(/\S+(\s\d+)?/g)?.map(word => word.replace(/^(?=\d)|(?<=\d)$/g, " ")) ?? [];
    for (const row of body.rows) {
      const cells = /** @type {NodeListOf<HTMLElement>} */ (row.querySelectorAll(SEARCHED));
      const text = plain([...cells].map(cell => `${cell.dataset.name ?? ""} ${cell.textContent}`).join(" "));
      row.hidden = !words.every(word => text.includes(word));
    }
  });
  return field;
}

/** Words and numbers of a text, with blanks around them. @param {string} text */
function plain(text) { return ` ${text.toLowerCase().replace(/[^\p{L}\d.]+/gu, " ")} `; }

/** Rows of the table of pieces. @returns {NodeListOf<HTMLTableRowElement>} */
function pieceRows() { return document.querySelectorAll("#pieces tr[data-part]"); }

/** Places of the report, in its order. @returns {NodeListOf<HTMLButtonElement>} */
function jumps() { return document.querySelectorAll("button.jump"); }

/** Has a row of the table of pieces lead to its piece. @param {(part: number) => void} go */
function linkPieces(go) {
  for (const row of pieceRows()) {
    row.tabIndex = 0;
    row.addEventListener("click", ({ target }) => {
      if (!(target instanceof Element && target.closest("details"))) go(Number(row.dataset.part));
    });
    row.addEventListener("keydown", ({ key, target }) => key === "Enter" && target === row && row.click());
  }
}

/** Marks the row of a piece. @param {number} part */
function markRow(part) {
  for (const row of pieceRows()) row.classList.toggle("marked", Number(row.dataset.part) === part);
}
