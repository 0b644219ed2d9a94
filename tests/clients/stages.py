"""Leads the pages of heads over a conveyor and of a pattern that is sewn: they play, stand still and are scrubbed."""

import sys

from browser import Browser


def check(holds, words):
    """Ends where something does not hold."""
    if not holds:
        raise SystemExit(words)


def play(browser, page, at, scrubbed):
    """Plays a page whose time is told by an expression."""
    browser.open(page)
    before = browser.evaluate(at)
    browser.click("#play")
    browser.wait(f"{at} > {before}")
    browser.evaluate("document.activeElement.blur()")
    browser.press(" ", "Space")
    stood = browser.evaluate(at)
    browser.settle()
    check(browser.evaluate(at) == stood, f"{page} stands still")
    browser.evaluate("{ const s = document.getElementById('scrub'); s.value = s.max; s.dispatchEvent(new Event('input')); }")
    browser.settle()
    check(browser.evaluate(scrubbed), f"{page} is scrubbed to its end")
    check(not browser.said, f"the console says {browser.said}")


def main(program, heads, pattern):
    """Both pages."""
    with Browser(program) as browser:
        play(browser, heads, "cutc.heads.tick", "cutc.heads.tick === cutc.heads.last")
        play(browser, pattern, "cutc.pattern.entry + cutc.pattern.time", "cutc.pattern.entry === cutc.pattern.count - 1")


main(*sys.argv[1:])
