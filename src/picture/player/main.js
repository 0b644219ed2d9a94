// The start of the page.

/** Starts the player of a page that has one. */
async function start() {
  makeSortable();
  const facts = /** @type {Facts} */ (JSON.parse(element("facts", HTMLScriptElement).text));
  if (!document.getElementById("player")) return;
  const motion = new Motion(facts, await pageColumns(facts.columns));
  const player = new Player(motion, new Colours(motion, motion.trail()));
  connect(player);
  linkPieces(part => player.goToPiece(part, true));
  linkPlaces((x, y, time) => player.goToPlace(x, y, time));
  element("loading", HTMLElement).hidden = true;
  const frame = element("cloth", HTMLElement), [left, low, right, high] = player.cloth.box;
  frame.style.setProperty("--shape", String((right - left + 1) / (high - low + 1)));
  player.setMode("piece");
  player.fit();
  let fitted = player.view.scale;
  new ResizeObserver(() => {
    // A window that shows the whole goes on showing it.
    if (player.view.scale === fitted) {
      player.fit();
      fitted = player.view.scale;
    }
    player.renew();
  }).observe(frame);
  for (const query of ["(prefers-color-scheme: dark)", "print"]) {
    matchMedia(query).addEventListener("change", () => player.renew());
  }
  // Frames wait while a page is printed: what is printed is drawn at once.
  addEventListener("beforeprint", () => {
    player.cloth.renew();
    player.cloth.drawForPaper(player.tick);
    frame.style.setProperty("--screen", String(player.view.width / player.view.height));
  });
  addEventListener("afterprint", () => player.renew());
  Object.assign(globalThis, { cutc: { facts, motion, player } });
}

begin(start);
