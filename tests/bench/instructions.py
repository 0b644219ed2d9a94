#!/usr/bin/env python3
"""Counts the instructions of three reference jobs on one thread, and compares them with the figures beside this file.

    python3 tests/bench/instructions.py            # fails when a job takes 5 % more than its figure
    python3 tests/bench/instructions.py --renew    # writes the figures anew; they go with the change that moved them

Times differ from run to run and from machine to machine; instructions hardly do. Needs valgrind, which counts them.
"""

import argparse
import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FIGURES = Path(__file__).with_suffix(".json")
# More than this share above its figure, and a job has become slower. Seeds of hash tables and addresses of memory move it by
# a millionth.
ALLOWED = 0.05

# What each job reads, as arguments of the example `marker`, and what `cutc` does with it.
JOBS = {
    "check 100,000 vertices of a cut file": (
        ["--vertices", "100000"],
        lambda source, folder: ["check", source],
    ),
    "compile 12 pieces to csv, verified": (
        ["--pieces", "12"],
        lambda source, folder: ["compile", source, "-t", "csv", "-o", f"{folder}/marker.csv"],
    ),
    "check 100,000 vertices of a plot": (
        ["--dialect", "plot", "--vertices", "100000"],
        lambda source, folder: ["check", source],
    ),
}


def main():
    parser = argparse.ArgumentParser(description="Compares instructions of reference jobs with their stored figures.")
    parser.add_argument("--renew", action="store_true", help="write the figures anew")
    renew = parser.parse_args().renew
    release = build()
    known = json.loads(FIGURES.read_text()) if FIGURES.exists() else {"jobs": {}}
    compiler = output(["rustc", "--version"])
    counts = {job: count(release, *how) for job, how in JOBS.items()}
    if renew:
        FIGURES.write_text(json.dumps({"rustc": compiler, "jobs": counts}, indent=2) + "\n")
        known = {"rustc": compiler, "jobs": counts}
    slower = show(counts, known["jobs"])
    if known.get("rustc") != compiler:
        print(f"the figures are from {known.get('rustc')}; this is {compiler}")
    if slower:
        print("slower than stored: " + "; ".join(slower))
        print(f"find what takes more, or renew the figures: python3 {Path(__file__).relative_to(ROOT)} --renew")
    return 1 if slower else 0


def build():
    """The folder of the release build."""
    # The profile makes it one unit of code: in several, what is inlined hangs on code that has nothing to do with it.
    build = ["cargo", "build", "--quiet", "--release", "--bin", "cutc", "--example", "marker"]
    subprocess.run(build, cwd=ROOT, check=True)
    metadata = json.loads(output(["cargo", "metadata", "--format-version", "1", "--no-deps"]))
    return Path(metadata["target_directory"]) / "release"


def output(command):
    return subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout.strip()


def count(release, order, arguments):
    """Instructions of one job."""
    with tempfile.TemporaryDirectory() as folder:
        source = f"{folder}/marker"
        with open(source, "wb") as file:
            subprocess.run([release / "examples/marker", *order], stdout=file, check=True)
        valgrind = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null"]
        # One thread, and nothing else of the caller's environment.
        environment = {"PATH": os.environ["PATH"], "RAYON_NUM_THREADS": "1"}
        command = [*valgrind, str(release / "cutc"), *arguments(source, folder)]
        run = subprocess.run(command, env=environment, capture_output=True, text=True)
        collected = re.search(r"Collected : (\d+)", run.stderr)
        if run.returncode != 0 or collected is None:
            sys.exit(f"{' '.join(command)}: exit code {run.returncode}\n{run.stderr}")
        return int(collected.group(1))


def show(counts, known):
    """Prints a table; gives the jobs that became slower."""
    slower = []
    print(f"{'job':40} {'instructions':>14} {'stored':>14} {'change':>8}")
    for job, instructions in counts.items():
        stored = known.get(job)
        if stored is None:
            print(f"{job:40} {instructions:14,} {'none':>14}")
            slower.append(f"{job} has no figure")
            continue
        change = instructions / stored - 1
        print(f"{job:40} {instructions:14,} {stored:14,} {change:+8.1%}")
        if change > ALLOWED:
            slower.append(f"{job} by {change:.1%}")
        elif change < -ALLOWED:
            print("  faster: renew the figures, so that this is kept")
    return slower


if __name__ == "__main__":
    sys.exit(main())
