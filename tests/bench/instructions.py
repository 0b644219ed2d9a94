#!/usr/bin/env python3
"""Counts the instructions of reference jobs on one thread, and compares them with the figures beside this file.

    python3 tests/bench/instructions.py            # fails when a job takes 5 % more than its figure, or exceeds its ceiling
    python3 tests/bench/instructions.py --renew    # writes the figures anew; they go with the change that moved them

Times differ from run to run and from machine to machine; instructions hardly do. Needs valgrind, which counts them.

A job has a figure, what it took when it was last looked at, and a ceiling, which is set by hand and never raised:
`--renew` writes no figure that exceeds its ceiling.
"""

import argparse
import concurrent.futures
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

# What each job reads - arguments of the example `marker`, or a fixture - and what `cutc` does with it in a folder.
JOBS = {
    "check 100,000 vertices of a cut file": (
        ["--vertices", "100000"],
        lambda source, folder: ["check", source],
    ),
    "compile 100,000 vertices to G-code, verified": (
        ["--vertices", "100000"],
        lambda source, folder: ["compile", source, "-t", "gcode", "-o", f"{folder}/program.ngc"],
    ),
    "compile 12 pieces to csv, verified": (
        ["--pieces", "12"],
        lambda source, folder: ["compile", source, "-t", "csv", "-o", f"{folder}/program.csv"],
    ),
    "compile 100 pieces to npy, verified": (
        ["--pieces", "100"],
        lambda source, folder: ["compile", source, "-t", "npy", "-o", f"{folder}/program.npy"],
    ),
    "compile parts that touch to csv, verified": (
        "fixtures/markers/touching-parts.cut",
        lambda source, folder: ["compile", source, "-t", "csv", "-o", f"{folder}/program.csv"],
    ),
    "check 100,000 vertices of a plot": (
        ["--dialect", "plot", "--vertices", "100000"],
        lambda source, folder: ["check", source],
    ),
    "check a pattern": (
        "fixtures/pattern/curve-points-of-richpeace.dxf",
        lambda source, folder: ["check", source],
    ),
    "sew a pattern to stitches and pulses": (
        "fixtures/sew/headline.csv",
        lambda source, folder: ["sew", source, "-t", "queue,pulses", "-o", folder],
    ),
    "plan heads over a conveyor": (
        "fixtures/flow/two-discs.csv",
        lambda source, folder: ["flow", source, "-o", f"{folder}/plan", "-p", f"{ROOT}/fixtures/machines/flow.toml"],
    ),
}


def main():
    parser = argparse.ArgumentParser(description="Compares instructions of reference jobs with their stored figures.")
    parser.add_argument("--renew", action="store_true", help="write the figures anew, but none above its ceiling")
    renew = parser.parse_args().renew
    built = build()
    stored = json.loads(FIGURES.read_text())
    compiler = output(["rustc", "--version"])
    # Each job counts on one thread; two of them at once are counted alike.
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        counts = dict(zip(JOBS, pool.map(lambda job: count(built, *JOBS[job]), JOBS)))
    faults = show(counts, stored["jobs"])
    if stored["rustc"] != compiler:
        print(f"the figures are from {stored['rustc']}; this is {compiler}")
    if renew:
        faults = write(counts, stored["jobs"], compiler)
    if faults:
        print("; ".join(faults))
        print(f"find what takes more; a figure below its ceiling is renewed by: python3 {Path(__file__).relative_to(ROOT)} --renew")
    return 1 if faults else 0


def build():
    """The folder of the build that is shipped."""
    # Its profile makes it one unit of code: in several, what is inlined hangs on code that has nothing to do with it.
    build = ["cargo", "build", "--quiet", "--profile", "dist", "--bin", "cutc", "--features", "bench", "--example", "marker"]
    subprocess.run(build, cwd=ROOT, check=True)
    metadata = json.loads(output(["cargo", "metadata", "--format-version", "1", "--no-deps"]))
    return Path(metadata["target_directory"]) / "dist"


def output(command):
    return subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout.strip()


def count(built, what, arguments):
    """Instructions of one job."""
    with tempfile.TemporaryDirectory() as folder:
        source = str(ROOT / what) if isinstance(what, str) else f"{folder}/marker"
        if not isinstance(what, str):
            with open(source, "wb") as file:
                subprocess.run([built / "examples/marker", *what], stdout=file, check=True)
        valgrind = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null"]
        # One thread, and nothing else of the caller's environment.
        environment = {"PATH": os.environ["PATH"], "RAYON_NUM_THREADS": "1"}
        command = [*valgrind, str(built / "cutc"), *arguments(source, folder)]
        run = subprocess.run(command, env=environment, cwd=folder, capture_output=True, text=True)
        collected = re.search(r"Collected : (\d+)", run.stderr)
        if run.returncode != 0 or collected is None:
            sys.exit(f"{' '.join(command)}: exit code {run.returncode}\n{run.stderr}")
        return int(collected.group(1))


def show(counts, stored):
    """Prints a table; gives what is wrong with the jobs that became slower."""
    faults = []
    print(f"{'job':46} {'instructions':>14} {'stored':>14} {'change':>8} {'ceiling':>14}")
    for job, instructions in counts.items():
        if job not in stored:
            print(f"{job:46} {instructions:14,} {'none':>14}")
            faults.append(f"{job}: no figure and no ceiling")
            continue
        figure, ceiling = stored[job]["figure"], stored[job]["ceiling"]
        change = instructions / figure - 1
        print(f"{job:46} {instructions:14,} {figure:14,} {change:+8.1%} {ceiling:14,}")
        if change > ALLOWED:
            faults.append(f"{job}: {change:.1%} above its figure")
        elif change < -ALLOWED:
            print("  faster: renew the figures, so that this is kept")
        if instructions > ceiling:
            faults.append(f"{job}: above its ceiling")
    return faults


def write(counts, stored, compiler):
    """Writes the figures anew; gives what is wrong with those that exceed their ceilings, which stay."""
    missing = [job for job in counts if job not in stored]
    if missing:
        return [f"{job}: set its ceiling by hand first" for job in missing]
    faults = [f"{job}: above its ceiling, figure kept" for job in counts if counts[job] > stored[job]["ceiling"]]
    jobs = {}
    for job, instructions in counts.items():
        ceiling = stored[job]["ceiling"]
        jobs[job] = {"figure": instructions if instructions <= ceiling else stored[job]["figure"], "ceiling": ceiling}
    FIGURES.write_text(json.dumps({"rustc": compiler, "jobs": jobs}, indent=2) + "\n")
    return faults


if __name__ == "__main__":
    sys.exit(main())
