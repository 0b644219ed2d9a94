#!/usr/bin/env python3
"""Reads nests as drawing programs write them and compares what is found with what the maker knows.

    python3 tests/bench/drawings.py target/release/cutc MAKER [--seeds N] [--pieces N] [--every N] [--compile]

MAKER is a program that prints a nest: it takes --dialect, --drawn, --seed, --gap, --pieces, --truth FILE and the flags
below. Parts, seam lines, notches by kind, area and the metres of the outlines must be as in its truth; the metres are
compared with those of the same nest without the flags that change only how outlines are closed. With `--compile` each
nest must give a verified program, too.
"""

import argparse
import collections
import itertools
import json
import os
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

STROKES = ["--strokes", "--notch", "u,v,castle"]
PLOT_FLAGS = [["--clip"], STROKES, ["--texts"], ["--overrun", "2"], ["--twice"]]
CUT_FLAGS = [["--overrun", "2"], ["--twice"]]
GAPS = [0, 0.1, 0.5, 1, 2]
CLOSES = {"--clip", "--texts", "--overrun", "--twice"}  # flags that change no part and no notch


def combinations(flags):
    """No flag, each alone, and all together."""
    return [[], *flags, [word for flag in flags for word in flag]]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("cutc")
    parser.add_argument("maker")
    parser.add_argument("--seeds", type=int, default=20)
    parser.add_argument("--pieces", default="40")
    parser.add_argument("--every", type=int, default=1)
    parser.add_argument("--compile", action="store_true")
    options = parser.parse_args()
    plots = itertools.product(["hpgl"], combinations(PLOT_FLAGS))
    cuts = itertools.product(["g71", "inch"], combinations(CUT_FLAGS))
    kinds = [*plots, *cuts]
    cases = [(*kind, gap, seed) for kind in kinds for gap in GAPS for seed in range(1, options.seeds + 1)]
    cases = cases[:: options.every]
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(os.cpu_count()) as pool:
        outcomes = collections.Counter()
        for case, faults in zip(cases, pool.map(lambda case: faults_of(options, folder, case), cases)):
            outcomes["wrong" if faults else "right"] += 1
            if faults:
                print(*case, "; ".join(faults), flush=True)
    print(dict(outcomes))
    sys.exit(1 if outcomes["wrong"] else 0)


def made(options, folder, case):
    """The file of a case, what its maker knows of it, and what is read of it."""
    dialect, flags, gap, seed = case
    name = f"{dialect}{'_'.join(flags)}_{gap}_{seed}".replace("-", "").replace(",", "")
    path = os.path.join(folder, name + (".plt" if dialect == "hpgl" else ".cut"))
    command = [sys.executable, options.maker, "--dialect", dialect, "--pieces", options.pieces, f"--gap={gap}"]
    command += ["--seed", str(seed), "--truth", path + ".json", *(["--drawn"] if dialect == "hpgl" else []), *flags]
    with open(path, "wb") as out:
        subprocess.run(command, stdout=out, check=True)
    run = subprocess.run([options.cutc, "info", "--format", "json", path], capture_output=True, text=True)
    refused = compiled(options, path) if options.compile else ""
    with open(path + ".json", encoding="utf-8") as file:
        truth = json.load(file)
    os.remove(path)
    os.remove(path + ".json")
    found = json.loads(run.stdout) if run.stdout.startswith("{") else {}
    return truth, found, run.stderr, refused


def compiled(options, path):
    """What a compile of a file says that gives no program."""
    run = subprocess.run([options.cutc, "compile", "-q", path, "-o", path + ".csv"], capture_output=True, text=True)
    if run.returncode == 0:
        os.remove(path + ".csv")
        os.remove(path + ".csv.meta.json")
        return ""
    return " ".join(line.strip() for line in run.stderr.splitlines()[:2]) or f"exit code {run.returncode}"


def plain(flags):
    """Flags without those that change only how outlines are closed and what else is written."""
    words = []
    for word in flags:
        if not word.startswith("--") and words[-1:] == [None]:
            continue
        words.append(None if word in CLOSES else word)
    return [word for word in words if word]


def drawn_m(found):
    """Metres of what is cut, with the common edges that are spared: the order of the pieces decides which those are."""
    return found["cut_m"] + (found.get("common") or {"spared_m": 0.0})["spared_m"]


def faults_of(options, folder, case):
    dialect, flags, gap, seed = case
    truth, found, stderr, refused = made(options, folder, case)
    if not found:
        return [stderr.strip().splitlines()[0] if stderr.strip() else "nothing is said"]
    faults = [refused] if refused else []

    def compare(what, value, expected, within=0):
        if abs(value - expected) > within:
            faults.append(f"{what} {value} of {expected}")

    compare("parts", found["pieces"], truth["pieces"])
    compare("closed", found["closed_contours"], truth["pieces"])
    kinds = collections.Counter(notch["kind"] for notch in truth["notches"])
    for kind in sorted(set(kinds) | {kind for kind, count in found["notches"].items() if count}):
        compare(kind, found["notches"].get(kind, 0), kinds[kind])
    seams = [row for row in found.get("lines") or [] if row["class"] == "seam line"]
    compare("seam lines", sum(row["count"] for row in seams), truth["seam_lines"])
    compare("seam lines cut", sum(row["count"] for row in seams if row["cut"]), 0)
    if plain(flags) != flags:
        _, alone, _, _ = made(options, folder, (dialect, plain(flags), gap, seed))
        # A gap that is closed straight and an end that is rounded change a length by less than a millimetre each.
        compare("outlines m", drawn_m(found), drawn_m(alone), 0.001 * truth["pieces"])
        compare("area m2", found["area_m2"] or 0.0, alone["area_m2"], 0.0005 * alone["area_m2"])
    return faults


main()
