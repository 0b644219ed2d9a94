#!/usr/bin/env python3
"""Measures how a page plays in Chromium: `tests/bench/player.py PAGE`. Needs Linux, and the page of `cutc compile -t html`.

Opening: from the call to the drawn cloth, in a browser that has started. Drawing: the whole marker at its end anew, and
frames a second while the cloth is moved. Memory: of the process that holds the page, at the end of all this.
"""

import pathlib
import re
import statistics
import subprocess
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "clients"))
from browser import Browser  # noqa: E402

#: Time in which frames are counted, s.
COUNTED = 5


def renderer_mb(browser):
    """Memory of the largest process of pages, MB."""
    listed = subprocess.run(["ps", "-e", "-o", "rss=,args="], capture_output=True, text=True, check=True).stdout
    own = [line for line in listed.splitlines() if "--type=renderer" in line and browser.folder in line]
    own = own or [line for line in listed.splitlines() if "--type=renderer" in line]
    return max(int(re.match(r"\s*(\d+)", line)[1]) for line in own) / 1024


def opening_s(page):
    """Time from the call to the drawn cloth, in a browser that has opened nothing yet, s."""
    with Browser("chromium") as browser:
        start = time.perf_counter()
        browser.open(page)
        return time.perf_counter() - start


def main(page):
    """All figures of a page."""
    print(f"page      {pathlib.Path(page).stat().st_size / 1e6:.1f} MB")
    print(f"opened in {statistics.median(opening_s(page) for _ in range(5)):.2f} s (median of 5)")
    with Browser("chromium") as browser:
        browser.open(page)
        browser.evaluate("cutc.player.seek(cutc.motion.end)")
        browser.settle()
        anew = browser.evaluate("""(() => {
          const { cloth, tick } = cutc.player, start = performance.now();
          for (let i = 0; i < 20; i++) { cloth.renew(); cloth.draw(tick); }
          return (performance.now() - start) / 20;
        })()""")
        print(f"drawn     {anew:.1f} ms for the whole marker anew")
        frames = browser.evaluate(f"""new Promise(done => {{
          const start = performance.now();
          let n = 0;
          const frame = () => {{
            cutc.player.view.pan(n++ % 200 < 100 ? 3 : -3, 1);
            if (performance.now() - start < {COUNTED * 1000}) requestAnimationFrame(frame); else done(n / {COUNTED});
          }};
          requestAnimationFrame(frame);
        }})""")
        print(f"moved     {frames:.0f} frames a second")
        print(f"memory    {renderer_mb(browser):.0f} MB")


main(*sys.argv[1:])
