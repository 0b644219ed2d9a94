"""Compiles markers in the order of the file and in those that travel least, and tells travel and time of the programs.

    python3 tests/bench/order.py target/release/cutc MARKER... [--set KEY=VALUE ...]
"""

import argparse
import os
import re
import subprocess
import tempfile

POLICIES = ["file", "fastest", "steady"]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("cutc")
    parser.add_argument("markers", nargs="+")
    parser.add_argument("--set", action="append", default=[])
    options = parser.parse_args()
    for marker in options.markers:
        of_file = None
        for policy in POLICIES:
            travel, time = compiled(options, marker, policy)
            of_file = of_file or (travel, time)
            shares = f"{travel / of_file[0]:.3f} {time / of_file[1]:.3f}"
            print(f"{os.path.basename(marker)} {policy}: {travel:.1f} m, {time:.1f} s, {shares}", flush=True)


def compiled(options, marker, policy):
    with tempfile.TemporaryDirectory() as folder:
        sets = [word for value in [f"order.policy={policy}", *options.set] for word in ("--set", value)]
        command = [options.cutc, "compile", marker, "-o", os.path.join(folder, "program.csv"), *sets]
        run = subprocess.run(command, capture_output=True, text=True)
    if run.returncode:
        raise SystemExit(f"{marker}: {policy} is refused\n{run.stderr}")
    said = run.stdout + run.stderr
    travel = re.search(r"^  travel +([\d.]+) m", said, re.M)
    hours, minutes, seconds = re.search(r"^  time +(?:(\d+) h )?(?:(\d+) min )?(?:([\d.]+) s)?", said, re.M).groups()
    return float(travel[1]), 3600 * float(hours or 0) + 60 * float(minutes or 0) + float(seconds or 0)


main()
