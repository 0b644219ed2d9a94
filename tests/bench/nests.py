"""Compiles nests of touching parts with several blades and tells what is refused.

    python3 tests/bench/nests.py target/release/cutc MAKER [--pieces N] [--seeds N] [--every N] [--set KEY=VALUE ...]

MAKER is a program that prints a nest: it takes --dialect, --gap, --notch, --pieces, --seed and the flags below. Every file
is compiled to setpoints with each blade, and with the first blade to G-code. The cases take seeds from 1 to `--seeds` in
turn; `--every N` takes each Nth case.
"""

import argparse
import collections
import itertools
import os
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

DIALECTS = {"g71": "cut", "inch": "ggt", "hpgl": "plt"}
GAPS = [-0.2, -0.1, 0, 0.1, 0.5, 2]
NOTCHES = ["mixed", "v", "box", "castle", "slit", "t,u,v-out,miss"]
FLAGS = [[], ["--facing"], ["--small", "--waste"], ["--cutouts"], ["--straight"]]
BLADES = [(6.6, 6.35), (6, 4), (8.89, 6.35), (3, 1.5)]  # width, and from the axis to the back


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("cutc")
    parser.add_argument("maker")
    parser.add_argument("--pieces", default="12")
    parser.add_argument("--seeds", type=int, default=1)
    parser.add_argument("--every", type=int, default=1)
    parser.add_argument("--set", action="append", default=[])
    options = parser.parse_args()
    cases = itertools.product(DIALECTS, GAPS, NOTCHES, FLAGS)
    cases = [(1 + place % options.seeds, *case) for place, case in enumerate(cases)][:: options.every]
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(os.cpu_count()) as pool:
        run = lambda case: compiled(options, folder, case)
        outcomes = collections.Counter()
        for case, results in zip(cases, pool.map(run, cases)):
            for name, (code, rules) in results.items():
                outcomes["made" if code == 0 else "not made"] += 1
                if code:
                    print(*case, name, rules, flush=True)
    print(dict(outcomes))


def compiled(options, folder, case):
    seed, dialect, gap, notch, flags = case
    path = os.path.join(folder, f"{abs(hash(repr(case)))}.{DIALECTS[dialect]}")
    make = [sys.executable, options.maker, "--pieces", options.pieces, "--dialect", dialect, f"--gap={gap}", f"--seed={seed}"]
    with open(path, "wb") as out:
        subprocess.run([*make, "--notch", notch, *flags], stdout=out, check=True)
    results = {}
    for place, (width, back) in enumerate(BLADES):
        for target in ["csv", "gcode"][: 2 if place == 0 else 1]:
            blade = [f"knife.width_mm={width}", f"knife.back_mm={back}"]
            sets = [word for value in blade + options.set for word in ("--set", value)]
            command = [options.cutc, "compile", path, "-t", target, "-o", f"{path}.{place}.{target}", "--force", *sets]
            run = subprocess.run(command, capture_output=True, text=True)
            faults = [line for line in run.stderr.splitlines() if line.startswith("error") or "verify/" in line]
            results[f"{width} {target}"] = (run.returncode, faults[:3])
            for made in [f"{path}.{place}.{target}", f"{path}.{place}.{target}.meta.json"]:
                if os.path.exists(made):
                    os.remove(made)
    os.remove(path)
    return results


main()
