// The start of the page.

/** Starts the player of a page that has one. */
async function start() {
  makeSortable();
  const facts = /** @type {Facts} */ (JSON.parse(element("facts", HTMLScriptElement).text));
  if (!document.getElementById("player")) return;
  const motion = new Motion(facts, await pageColumns(facts.columns));
  const player = new Player(motion, new Colours(motion, motion.trail()));
  linkPieces(part => player.goToPiece(part, true));
  for (const button of jumps()) button.addEventListener("click", () => player.goToPlace(button.dataset, button));
  element("loading", HTMLElement).hidden = true;
  const frame = element("cloth", HTMLElement), [left, low, right, high] = player.cloth.box;
  frame.style.setProperty("--shape", String((right - left + 1) / (high - low + 1)));
  connect(player);
  player.setMode("piece");
  // Frames wait while a page is printed: what is printed is drawn at once.
  addEventListener("beforeprint", () => {
    forgetColours();
    player.cloth.drawForPaper(player.tick);
    frame.style.setProperty("--screen", String(player.view.width / player.view.height));
  });
  addEventListener("afterprint", () => player.renew());
  Object.assign(globalThis, { cutc: { facts, motion, player } });
}

begin(start);
