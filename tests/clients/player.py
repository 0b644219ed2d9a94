"""Leads the player of a page: browser, page, setpoints. Says what is wrong and ends with 1."""

import csv
import pathlib
import random
import re
import sys
import tempfile

from browser import Browser

#: How far the page may be from the setpoints, mm and degrees.
PROMISED = 0.01


def check(holds, words):
    """Ends where something does not hold."""
    if not holds:
        raise SystemExit(words)


def places(browser, rows):
    """The page is where the setpoints are at random times, on a tick and between two of them."""
    dice = random.Random(7)
    last = len(rows) - 1
    # Between two setpoints a straight line is within a micrometre: a cycle of 1 ms at 5 m/s2.
    for at in [0, last] + [dice.randrange(last) for _ in range(20)] + [dice.uniform(0, last) for _ in range(20)]:
        before, share = min(int(at), last - 1), at - min(int(at), last - 1)
        found = browser.evaluate(f"Object.values(cutc.motion.at({at}))")
        for axis, value in zip(["x_mm", "y_mm", "c_deg"], found):
            here, there = (float(rows[tick][axis]) for tick in [before, before + 1])
            told = here + (there - here) * share
            check(abs(value - told) <= PROMISED, f"tick {at}: {axis} {value} instead of {told}")


def trail(browser):
    """The drawn trail stays near the way of the tip."""
    off = browser.evaluate("""(() => {
      const { motion, player } = cutc, { trail } = player.cloth, tip = motion.facts.knife.tip_mm;
      let most = 0;
      for (const { first, end } of trail.strokes) {
        for (let i = first + 2; i < end; i++) {
          const [a, b] = [i - 1, i].map(k => [trail.x[k], trail.y[k]]), from = trail.tick[i - 1], span = trail.tick[i] - from;
          for (let t = 1; t < 8; t++) {
            const [x, y] = motion.blade(from + span * t / 8, tip), dx = b[0] - a[0], dy = b[1] - a[1], d = dx * dx + dy * dy;
            const u = d > 0 ? Math.min(1, Math.max(0, ((x - a[0]) * dx + (y - a[1]) * dy) / d)) : 0;
            most = Math.max(most, Math.hypot(x - a[0] - u * dx, y - a[1] - u * dy));
          }
        }
      }
      return most;
    })()""")
    check(off <= 0.05, f"the trail is {off} mm off the way of the tip")


def ways(browser):
    """It plays, is scrubbed, and goes from cut to cut and from piece to piece."""
    browser.evaluate("cutc.player.seek(0); document.activeElement.blur()")
    browser.click("#play")
    browser.wait("cutc.player.tick * cutc.motion.period > 0.2")
    check(browser.evaluate("document.getElementById('play').textContent") == "Pause", "the button says what it does")
    browser.press(" ", "Space")
    check(not browser.evaluate("cutc.player.playing"), "the space bar on the button pauses")
    tick = browser.evaluate("cutc.player.tick")
    browser.settle()
    check(browser.evaluate("cutc.player.tick") == tick, "it stands still")
    browser.evaluate("const s = document.getElementById('scrub'); s.value = s.max / 2; s.dispatchEvent(new Event('input'))")
    check(abs(browser.evaluate("cutc.player.tick / cutc.motion.end") - 0.5) < 0.01, "it is scrubbed")
    browser.evaluate("document.activeElement.blur()")
    browser.press("Home")
    check(browser.evaluate("cutc.player.tick") == 0, "Home is the start")
    starts = browser.evaluate("cutc.motion.cuts.map(phase => cutc.motion.start(phase))")
    for start in starts[:3]:
        browser.press("ArrowRight")
        check(browser.evaluate("cutc.player.tick") == start, "an arrow goes to the next cut")
    pieces = browser.evaluate("cutc.motion.pieces.map(phase => cutc.motion.start(phase))")
    browser.press("ArrowRight", shift=True)
    check(browser.evaluate("cutc.player.tick") == pieces[1], "with Shift to the next piece")
    browser.press(".")
    check(browser.evaluate("cutc.player.tick") == pieces[1] + 1, "a point goes on by a cycle")
    browser.press("End")
    check(browser.evaluate("cutc.player.tick") == browser.evaluate("cutc.motion.end"), "End is the end")
    told, cuts = browser.evaluate("[document.getElementById('part').textContent, cutc.motion.cuts.length]")
    last = browser.evaluate("cutc.motion.facts.pieces.at(-1).number")
    # The four pieces have holes, which are steps, too.
    check(told.startswith(f"piece {last}") and told.endswith(f", cut or hole {cuts} of {cuts}"), f"at the end it says {told}")
    browser.press("]")
    check(browser.evaluate("cutc.player.rate") == 2, "a bracket is faster")


def controls(browser):
    """The space bar acts on a control that has the focus, and plays everywhere else; keys switch what is shown."""
    browser.evaluate("cutc.player.play(false); cutc.player.seek(0); document.getElementById('names').focus()")
    for switched in [False, True]:
        browser.press(" ", "Space")
        check(browser.evaluate("cutc.player.cloth.shown.names") == switched, "the space bar switches a box")
    browser.evaluate("document.querySelector('#keys summary').focus(); scrollTo(0, 0)")
    for key, code, opened in [(" ", "Space", True), ("?", "Slash", False), ("?", "Slash", True)]:
        browser.press(key, code, shift=key == "?")
        check(browser.evaluate("document.getElementById('keys').open") == opened, f"{key} on the list of keys")
    bottom = browser.evaluate("document.getElementById('keys').getBoundingClientRect().bottom - innerHeight")
    check(bottom <= 1, f"the list of keys ends {bottom} pixels below the window")
    check(not browser.evaluate("cutc.player.playing"), "and nothing plays")
    for key, name in [("p", "names"), ("m", "marks")]:
        browser.press(key)
        check(not browser.evaluate(f"cutc.player.cloth.shown.{name}"), f"{key} hides {name}")
        browser.press(key)
    browser.click("button.jump")
    browser.press(" ", "Space")
    check(browser.evaluate("cutc.player.playing"), "it plays after a place of the report was pressed")
    browser.press(" ", "Space")


def rates(browser, rows):
    """Under the cloth are the speeds of the axes and their limits; C is within half a turn."""
    period = browser.evaluate("cutc.motion.period")
    cuts = [tick for tick in range(1, len(rows) - 1, 97)]
    for tick in cuts:
        browser.evaluate(f"cutc.player.seek({tick}); cutc.player.tellAll()")
        line = browser.evaluate("document.getElementById('speed').textContent")
        found = re.search(r": X (-?\d+)/(\d+) mm/s, Y (-?\d+)/(\d+), C (-?\d+)/(\d+)", line)
        check(found and "-0/" not in line, f"no speeds in {line}")
        for axis, at in [("x_mm", 1), ("y_mm", 3), ("c_deg", 5)]:
            before, after = (float(rows[tick + by][axis]) for by in [-1, 1])
            rate, limit = int(found[at]), int(found[at + 1])
            near = abs(rate - (after - before) / 2 / period) <= 1 + 0.02 * limit
            check(near and abs(rate) <= limit + 1, f"tick {tick}: {line}")
        turn = float(re.search(r"C (\S+)°", browser.evaluate("document.getElementById('axes').textContent"))[1])
        off = (turn - float(rows[tick]["c_deg"])) % 360
        check("-0.00" not in browser.evaluate("document.getElementById('axes').textContent"), "no zero has a sign")
        check(-180 <= turn <= 180 and min(off, 360 - off) < 0.02, f"tick {tick}: C at {turn}")


def curves(browser):
    """The wheel on the curves shows more of them at once, and not another time."""
    browser.evaluate("cutc.player.seek(0)")
    browser.settle()
    shown = "[cutc.player.charts.from, cutc.player.charts.to]"
    check(browser.evaluate(f"{shown}[1] === cutc.motion.end"), "all of the program is shown at first")
    x, y = browser.evaluate("(() => { const e = document.getElementById('charts'); e.scrollIntoView({ block: 'center' });"
                            " const b = e.getBoundingClientRect(); return [b.right - 20, b.y + b.height / 2]; })()")
    pixels = "document.getElementById('curves').toDataURL()"
    before, drawn = browser.evaluate(shown), browser.evaluate(pixels)
    for _ in range(3):
        browser.call("Input.dispatchMouseEvent", type="mouseWheel", x=x, y=y, deltaX=0, deltaY=-300)
    browser.wait(f"cutc.player.charts.from > {before[0]}")
    browser.settle()
    now = browser.evaluate(shown)
    check(now[1] - now[0] < before[1] - before[0], f"the wheel shows less time: {before}, then {now}")
    check(browser.evaluate(pixels) != drawn, "and the curves are drawn anew")
    browser.press("End")
    check(browser.evaluate(f"cutc.motion.end <= {shown}[1]"), "they go with the cursor when that moves")


def cloth(browser):
    """The cloth is zoomed and moved, and shows what is cut."""
    browser.press("0")
    before = browser.evaluate("cutc.player.view.scale")
    browser.press("+")
    check(browser.evaluate("cutc.player.view.scale") > before, "plus is larger")
    at = browser.evaluate("[cutc.player.view.x, cutc.player.view.y]")
    browser.press("d")
    check(browser.evaluate("cutc.player.view.x") > at[0], "a key moves the cloth")
    for key, times in [("-", 30), ("+", 60)]:
        for _ in range(times):
            browser.press(key)
        fitting, scale = browser.evaluate("[cutc.player.fitted, cutc.player.view.scale]")
        check(0.4 * fitting < scale <= 200, f"{scale} pixels a millimetre where all is seen at {fitting}")
    for _ in range(200):
        browser.evaluate("cutc.player.view.pan(-900, 0)")
    right, x = browser.evaluate("[cutc.player.cloth.box[2], cutc.player.view.x]")
    check(x <= right + 200, f"the cloth ends at {right} and the middle of the window is at {x}")
    browser.press("0")
    drawn = ("(() => { const c = document.getElementById('cut'), k = new OffscreenCanvas(c.width, c.height);"
             " const to = k.getContext('2d', {willReadFrequently: true}); to.drawImage(c, 0, 0); let n = 0;"
             " to.getImageData(0, 0, c.width, c.height).data.forEach((v, i) => { n += i % 4 === 3 && v > 0; }); return n; })()")
    amounts = []
    for key in ["Home", "End"]:
        browser.press(key)
        amounts.append(browser.evaluate(drawn))
    check(amounts[0] == 0 and amounts[1] > 500, f"the trail grows: {amounts}")
    for mode in ["order", "speed", "axis", "heading", "piece"]:
        browser.evaluate(f"cutc.player.setMode('{mode}')")
        browser.settle()
        check(browser.evaluate(drawn) > 500, f"the trail is drawn by {mode}")


def moved(browser):
    """What is moved on the screen is what is drawn anew."""
    pixels = """(() => [cutc.player.cloth.base, cutc.player.cloth.cut].map(canvas => {
      const copy = new OffscreenCanvas(canvas.width, canvas.height);
      const to = copy.getContext('2d', { willReadFrequently: true });
      to.drawImage(canvas, 0, 0);
      return Array.from(to.getImageData(0, 0, copy.width, copy.height).data);
    }))()"""
    browser.evaluate("cutc.player.seek(cutc.motion.end * 0.6)")
    for key in "++aadwsd":
        browser.press(key)
    seen = browser.evaluate(pixels)
    browser.evaluate("cutc.player.renew()")
    browser.settle()
    for canvas, before, now in zip(["pieces", "trail"], seen, browser.evaluate(pixels)):
        check(any(before), f"{canvas}: nothing is drawn")
        # Where the trail went on from what was drawn its rounded ends lie on each other: some edge pixels differ.
        differ = sum(abs(a - b) > 32 for a, b in zip(before, now))
        check(differ <= len(now) / 10_000, f"{canvas}: {differ} of {len(now)} bytes differ")
    browser.press("0")


def touch(browser):
    """Two fingers make the cloth larger and move it, one scrolls the page."""
    browser.evaluate("scrollTo(0, 0)")
    x, y = browser.evaluate("(() => { const b = document.getElementById('cloth').getBoundingClientRect();"
                            " return [b.x + b.width / 2, b.y + b.height / 2]; })()")
    told = "[cutc.player.view.scale, cutc.player.view.x]"
    scale, at = browser.evaluate(told)
    for kind, apart in [("touchStart", 40), ("touchMove", 60), ("touchMove", 80), ("touchEnd", None)]:
        fingers = [] if apart is None else [{"x": x - apart, "y": y, "id": 1}, {"x": x + apart, "y": y, "id": 2}]
        browser.call("Input.dispatchTouchEvent", type=kind, touchPoints=fingers)
    browser.settle()
    check(abs(browser.evaluate(told)[0] / scale - 2) < 0.05, "two fingers at twice the distance double the size")
    browser.press("0")
    scale, at = browser.evaluate(told)
    for kind, by in [("touchStart", 0), ("touchMove", 30), ("touchMove", 60), ("touchEnd", None)]:
        fingers = [] if by is None else [{"x": x + by + i, "y": y, "id": 1 + i} for i in [0, 50]]
        browser.call("Input.dispatchTouchEvent", type=kind, touchPoints=fingers)
    browser.settle()
    check(browser.evaluate(told)[1] < at and browser.evaluate("scrollY") == 0, "two fingers move the cloth")
    browser.press("0")
    for kind, by in [("touchStart", 0), *[("touchMove", 25 * step) for step in range(1, 9)], ("touchEnd", None)]:
        fingers = [] if by is None else [{"x": x, "y": y - by, "id": 1}]
        browser.call("Input.dispatchTouchEvent", type=kind, touchPoints=fingers)
    browser.wait("scrollY > 50")
    # A page goes on scrolling for a while.
    browser.wait("globalThis.stood === scrollY || [globalThis.stood = scrollY] === 0")
    check(browser.evaluate(told) == [scale, at], "a finger scrolls the page over the cloth")
    browser.evaluate("scrollTo(0, 0)")


def paper(browser):
    """Printed, the page has its report on sheets of paper."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder, "page.pdf")
        browser.pdf(path)
        printed = path.read_bytes()
    check(printed.startswith(b"%PDF") and len(printed) > 20_000, f"a PDF of {len(printed)} bytes")


def search(browser):
    """The rows that hold the words are shown."""
    shown = "[...document.querySelectorAll('#pieces tr[data-part]')].filter(row => !row.hidden).length"
    every = browser.evaluate(shown)
    found = []
    # A number is meant as a whole, of the word before it.
    for words in ["piece 12", "12", "no such piece", ""]:
        browser.evaluate(f"""(() => {{ const field = document.querySelector('#pieces input[type=search]');
          field.value = '{words}'; field.dispatchEvent(new Event('input')); }})()""")
        found.append(browser.evaluate(shown))
        empty = browser.evaluate("getComputedStyle(document.querySelector('#pieces tbody'), '::after').content")
        check((found[-1] == 0) == ("no row" in empty), f"with {found[-1]} rows it says {empty}")
    check(found == [1, 1, 0, every], f"{found} of {every} rows are found")


def heads(browser):
    """Names of the columns of pieces."""
    return browser.evaluate("[...document.querySelectorAll('#pieces thead th')].map(head => head.textContent)")


def report(browser):
    """Tables are sorted, rows and places lead to the player."""
    numbers = "[...document.querySelectorAll('#pieces tr[data-part]')].map(row => Number(row.dataset.part))"
    order = browser.evaluate(numbers)
    at = heads(browser).index("Lines, m")
    browser.click(f"#pieces thead th:nth-child({at + 1}) button")
    cuts = ("[...document.querySelectorAll('#pieces tr[data-part]')]"
            f".map(row => Number(row.cells[{at}].dataset.value))")
    sorted_down = browser.evaluate(cuts)
    check(sorted_down == sorted(sorted_down)[::-1] and browser.evaluate(numbers) != order, "numbers begin with the greatest")
    browser.click(f"#pieces thead th:nth-child({at + 1}) button")
    check(browser.evaluate(cuts) == sorted_down[::-1], "and the other way round")
    part = browser.evaluate(numbers)[0]
    browser.press("0")
    browser.click("#pieces tbody tr:first-child td:nth-child(2)")
    in_view(browser, part)
    check(browser.evaluate("cutc.player.cloth.marked") == part, "a row marks its piece")
    check(browser.evaluate("document.querySelector('tr.marked').dataset.part") == str(part), "and is marked itself")
    found = "document.getElementById('found').textContent"
    check("piece" in browser.evaluate(found), f"the line under the cloth tells the piece: {browser.evaluate(found)}")
    browser.press("0")
    browser.evaluate("scrollTo(0, 0)")
    box = browser.evaluate("(({ x, y }) => [x, y])(document.getElementById('cloth').getBoundingClientRect())")
    middle = browser.evaluate("(() => { const [l, b, r, t] = cutc.motion.facts.pieces[1].extent, v = cutc.player.view;"
                              " return [v.px((l + r) / 2), v.py((b + t) / 2)]; })()")
    place = {"x": box[0] + middle[0], "y": box[1] + middle[1]}
    browser.call("Input.dispatchMouseEvent", type="mouseMoved", **place)
    for kind in ["mousePressed", "mouseReleased"]:
        browser.call("Input.dispatchMouseEvent", type=kind, button="left", clickCount=1, **place)
    browser.settle()
    number = browser.evaluate("cutc.motion.facts.pieces[1].number")
    check(f"piece {number}" in browser.evaluate(found), f"a click on piece {number} says {browser.evaluate(found)}")
    check(f"piece {number}" in browser.evaluate("document.getElementById('cloth').title"), "and the mouse over it")
    browser.click("#findings button.jump[data-time]")
    told = browser.evaluate("document.querySelector('#findings button.jump[data-time]').dataset.told")
    check(told and browser.evaluate(found) == told, f"{browser.evaluate(found)} instead of {told}")
    time = float(browser.evaluate("document.querySelector('#findings button.jump[data-time]').dataset.time"))
    found = browser.evaluate("cutc.player.tick * cutc.motion.period")
    check(abs(found - time) < 1e-6, f"a place leads to its time: {found} instead of {time}")
    check(browser.evaluate("scrollY < innerHeight"), "and to the player")


def in_view(browser, part):
    """The cloth is in the window, and on it a piece as large as it fits."""
    browser.settle()
    top, bottom, high = browser.evaluate("(({ top, bottom }) => [top, bottom, innerHeight])"
                                         "(document.getElementById('cloth').getBoundingClientRect())")
    check(top >= 0 and bottom <= high, f"the cloth is at {top} to {bottom} in a window of {high}")
    box = browser.evaluate(f"(() => {{ const [l, b, r, t] = cutc.motion.facts.pieces[{part}].extent, v = cutc.player.view;"
                           " return [v.px(l) / v.width, v.py(t) / v.height, v.px(r) / v.width, v.py(b) / v.height]; })()")
    check(all(0 <= at <= 1 for at in box), f"the piece is at {box} of the cloth")
    check(max(box[2] - box[0], box[3] - box[1]) > 0.6, f"and small: {box}")


def phone(browser):
    """On a small screen a row leads to its piece as well, and no button lies over the cloth."""
    browser.size(390, 844)
    browser.settle()
    browser.evaluate("document.querySelector('#pieces tr[data-part=\"1\"]').click()")
    in_view(browser, 1)
    over = browser.evaluate("document.querySelectorAll('#cloth button').length")
    check(over == 0, f"{over} buttons over the cloth")
    browser.size(1400, 900)


def columns(browser):
    """Notches are sorted by their number, texts from A on; totals stay below."""
    cells = ("(column => [...document.querySelectorAll('#pieces tr')].slice(1)"
             ".map(row => row.cells[column]?.dataset.value ?? row.cells[column]?.textContent))")
    check(heads(browser)[:3] == ["Order", "Piece", "Notches and holes"], "there are no columns without texts")
    browser.click("#pieces thead th:nth-child(3) button")
    check(browser.evaluate(f"{cells}(2).slice(0, 3)") == ["3", "2", "0"], "most notches come first")
    last = "[...document.querySelectorAll('#pieces tr')].at(-1).cells[0].textContent"
    check(browser.evaluate(last) == "All", "totals stay last")
    browser.click("#pieces thead th:nth-child(2) button")
    check(browser.evaluate(f"{cells}(1).slice(0, 3)") == ["1", "2", "3"], "texts begin with the first")


def passed(browser):
    """Places without a time set the clock to the moment at which the blade passes them, and the key N goes through all."""
    found = browser.evaluate("""(() => {
      const { motion, player } = cutc, { pieces, knife } = motion.facts;
      const { phase_kind, phase_part, phase_tick } = motion.columns;
      const away = (tick, x, y) => {
        let least = Infinity;
        const from = phase_kind[motion.phase(tick)] === 4 ? -knife.heel_mm : knife.tip_mm;
        for (let reach = from; reach < knife.tip_mm + 0.05; reach += 0.05) {
          const [bladeX, bladeY] = motion.blade(tick, reach);
          least = Math.min(least, Math.hypot(bladeX - x, bladeY - y));
        }
        return least;
      };
      return [...document.querySelectorAll('button.jump:not([data-time])')].map(button => {
        const x = Number(button.dataset.x), y = Number(button.dataset.y), part = Number(button.dataset.part);
        let least = Infinity;
        phase_kind.forEach((kind, phase) => {
          if (kind < 4 || kind > 5 || pieces[phase_part[phase]].whole !== part) return;
          for (let t = phase_tick[phase]; t < phase_tick[phase + 1]; t++) least = Math.min(least, away(t, x, y));
        });
        player.seek(0);
        button.click();
        return [least, away(player.tick, x, y), player.tick];
      });
    })()""")
    check(len(found) > 4, f"{len(found)} places without a time")
    for least, there, tick in found:
        check(least < 1 and there <= least + 0.1 and tick > 0, f"{there} mm off at tick {tick}, {least} mm at the least")
    told = "document.getElementById('part').textContent"
    browser.evaluate("cutc.player.seek(1000); cutc.player.goToPlace({ x: '-90', y: '-90' })")
    browser.settle()
    check(browser.evaluate("cutc.player.tick") == 1000, "the clock stays where the blade does not come")
    check("does not pass" in browser.evaluate(told), f"the line says so: {browser.evaluate(told)}")
    browser.press(".")
    check("piece 1" in browser.evaluate(told), "and says the piece again when the clock goes on")
    browser.evaluate("cutc.player.seek(0); document.activeElement.blur()")
    browser.press("n")
    stepped = ("[...document.querySelectorAll('button.jump')].filter(button => button.checkVisibility()"
               " && button.closest('#messages, .broken, #deviations'))")
    first = browser.evaluate(f"(({{ x, y }}) => [Number(x), Number(y)])({stepped}[0].dataset)")
    check(browser.evaluate("cutc.player.cloth.spot") == first, "the key goes to the first place")
    check(browser.evaluate("cutc.player.tick") > 0, "and to its moment")
    browser.click("#messages button.jump, #deviations button.jump")
    at = browser.evaluate(f"{stepped}.indexOf(cutc.player.jump)")
    count = browser.evaluate(f"{stepped}.length")
    for shift, expected in [(False, at + 1), (True, at), (True, at - 1)]:
        browser.press("N" if shift else "n", "KeyN", shift=shift)
        here = browser.evaluate(f"{stepped}.indexOf(cutc.player.jump)")
        check(here == expected % count, f"the key goes on from the place that was pressed: {here}, not {expected % count}")


def warnings(browser):
    """The number of warnings is on the first screen and leads to their list."""
    browser.evaluate("scrollTo(0, 0)")
    check(browser.evaluate("document.querySelector('.tally a').getBoundingClientRect().bottom < 60"), "it is at the top")
    browser.click(".tally a")
    top = browser.evaluate("document.getElementById('messages').getBoundingClientRect().top")
    check(-1 < top < 400, f"the messages begin at {top} of the window")
    marked = browser.evaluate("cutc.player.cloth.marked")
    browser.click("#pieces summary")
    listed = browser.evaluate("document.querySelector('#pieces details[open] li').checkVisibility()")
    check(listed, "the number of messages of a piece opens their list")
    check(browser.evaluate("cutc.player.cloth.marked") == marked, "and leaves the cloth")


def windows(browser):
    """On a conveyor X is told on the table and on the cloth, with the window."""
    told = "[document.getElementById('axes').textContent, document.getElementById('window').textContent]"
    seen = set()
    for share in range(1, 20):
        browser.evaluate(f"cutc.player.seek(cutc.motion.end * {share} / 20); cutc.player.tellAll()")
        table, cloth = browser.evaluate(told)
        at = re.match(r"X (\S+)  Y \S+  C \S+° on the table", table)
        on = re.match(r"X (\S+) on the cloth: window (\d), moved on by (\d+) mm; .* not counted", cloth)
        check(at and on, f"{table}; {cloth}")
        check(abs(float(at[1]) + int(on[3]) - float(on[1])) < 0.011, f"{table}; {cloth}")
        seen.add(on[2])
    check(seen == set("1234"), f"windows {seen}")
    split = browser.evaluate("cutc.motion.facts.pieces.find((piece, i) => piece.whole !== i).whole")
    browser.evaluate(f"cutc.player.goToPiece({split}, false)")
    said = browser.evaluate("document.getElementById('found').textContent")
    check(len(re.findall(r"s to [^,]+ s in window \d", said)) > 1, f"sections of a split piece: {said}")


def still(browser):
    """What was refused before it was planned has a cloth with the place of the fault, and a way to it."""
    shown = browser.evaluate("['play', 'charts', 'zoom_fit', 'cloth'].map(id => document.getElementById(id).checkVisibility())")
    check(shown == [False, False, True, True], f"of play, curves, zoom and cloth are shown: {shown}")
    browser.click("#messages button.jump")
    browser.settle()
    check(browser.evaluate("cutc.player.cloth.spot") == [9000, 0], "the place is marked")
    check("leaves the table" in browser.evaluate("document.getElementById('found').textContent"), "and told")
    at = browser.evaluate("[cutc.player.view.px(9000), cutc.player.view.py(0)].map(Math.round)")
    red = browser.evaluate("(([x, y]) => { const c = document.getElementById('top'), r = devicePixelRatio;"
                           " const d = c.getContext('2d').getImageData((x + 7) * r, (y - 10) * r, 3 * r, 3 * r).data;"
                           f" return d.some((v, i) => i % 4 === 0 && v > 150 && d[i + 3] > 100); }})({at})")
    check(red, "the fault is marked in red")


def main(program, page, setpoints, many, gap, bites, refused):
    """Everything, on one page, and more on others: many pieces and findings, places that the blade passes, a conveyor."""
    with open(setpoints, encoding="ascii") as file:
        rows = list(csv.DictReader(file))
    with Browser(program) as browser:
        browser.open(page)
        places(browser, rows)
        trail(browser)
        ways(browser)
        controls(browser)
        rates(browser, rows)
        curves(browser)
        cloth(browser)
        moved(browser)
        touch(browser)
        report(browser)
        phone(browser)
        paper(browser)
        for width, height in [(390, 844), (1400, 900)]:
            browser.size(width, height)
            browser.settle()
            wide = browser.evaluate("document.documentElement.scrollWidth")
            check(wide <= width, f"the page is {wide} pixels wide on a screen of {width}")
        browser.open(many)
        tally = browser.evaluate("[cutc.motion.facts.pieces.length, document.body.textContent.includes('2000 warnings')]")
        check(tally == [200, True], f"200 pieces and twice 2,000 findings: {tally}")
        search(browser)
        browser.open(gap)
        columns(browser)
        passed(browser)
        warnings(browser)
        browser.open(bites)
        windows(browser)
        browser.open(refused)
        still(browser)
        check(not browser.said, f"the console says {browser.said}")


main(*sys.argv[1:])
