#!/usr/bin/env python3
"""Compares the programs of two builds of cutc, byte by byte: for changes that must not change what is cut.

    python3 tests/bench/same_programs.py OLD NEW [FILE]...           # two binaries; files beside the fixtures
    python3 tests/bench/same_programs.py OLD NEW --keep DIR          # what OLD wrote is kept there, for the next time

Every fixture that is an input, and every FILE, is compiled to every target for every machine in fixtures/machines, for
every profile that ships and for the default one. Digests, which change with the profile's text, are left out. Lists every
program that differs, and every compile that ends otherwise; messages that differ are counted, and listed with --messages.
"""

import argparse
import concurrent.futures
import difflib
import hashlib
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FOLDERS = ["iso", "hpgl", "csv", "invalid/iso", "invalid/hpgl", "invalid/csv", "knife", "markers", "motion", "pictures"]
TARGETS = "csv,npy,json,svg,iso,counts,hal,halrun,gcode"
# Digests of SHA-256, whole or their first digits.
DIGEST = re.compile(rb"\b(?=[0-9a-f]*[a-f])(?=[0-9a-f]*[0-9])(?:[0-9a-f]{64}|[0-9a-f]{16}|[0-9a-f]{12})\b")
LONGEST_S = 600


def main():
    parser = argparse.ArgumentParser(description="Compares the programs of two builds, byte by byte.")
    parser.add_argument("old", type=Path)
    parser.add_argument("new", type=Path)
    parser.add_argument("files", nargs="*", type=Path)
    parser.add_argument("--keep", type=Path, help="where what OLD writes is kept")
    parser.add_argument("--messages", action="store_true", help="list messages that differ, too")
    parser.add_argument("--only", default="", help="only jobs whose name has this")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        kept = (options.keep or Path(folder) / "old").resolve()
        jobs = [job for job in listed(options.files) if options.only in job[0]]
        done = pool.map(lambda job: compared(job, options, kept, Path(folder) / "new"), jobs)
        faults, said = 0, 0
        for name, lines, messages in done:
            faults += len(lines) > 0
            said += len(messages) > 0
            for line in lines + (messages if options.messages else []):
                print(f"{name}: {line}", flush=True)
    print(f"{len(jobs)} compiles, {faults} with other programs, {said} with other messages")
    return 1 if faults else 0


def listed(files):
    """A name, an input and a profile each."""
    inputs = [path for name in FOLDERS for path in sorted((ROOT / "fixtures" / name).glob("*.*"))]
    inputs = [path for path in inputs if path.suffix in {".cut", ".plt", ".csv"}]
    machines = [None, *sorted((ROOT / "fixtures/machines").glob("*.toml"))]
    machines += sorted((ROOT / "src/machine/shipped").glob("*.toml"))
    for path in [*inputs, *(file.resolve() for file in files)]:
        for machine in machines:
            name = path.relative_to(ROOT / "fixtures") if path.is_relative_to(ROOT / "fixtures") else path.name
            yield f"{name} {machine.stem if machine else 'default'}", path, machine


def compared(job, options, kept, new):
    name = job[0]
    folder = hashlib.sha256(name.encode()).hexdigest()[:16]
    old, new = kept / folder, new / folder
    if not (old / "exit").exists():
        compiled(options.old, job, old)
    compiled(options.new, job, new)
    lines, messages = [], []
    for file in sorted({path.name for where in (old, new) for path in where.iterdir()}):
        a, b = [(where / file).read_bytes() if (where / file).exists() else None for where in (old, new)]
        if a == b:
            continue
        if a is None or b is None:
            lines.append(f"{file} only of {'NEW' if a is None else 'OLD'}")
        elif file in ("stderr", "stdout"):
            messages += difference(a, b)
        else:
            lines += [f"{file}: {line}" for line in difference(a, b)]
    shutil.rmtree(new)
    return name, lines, messages


def compiled(binary, job, folder):
    """Compiles into a folder; beside the programs stand the exit code and what was said."""
    _, path, machine = job
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    profile = ["-p", str(machine)] if machine else []
    command = [str(binary.resolve()), "compile", str(path), "-t", TARGETS, "-o", f"{folder}/", *profile]
    run = subprocess.run(command, capture_output=True, timeout=LONGEST_S, cwd=folder, check=False)
    for file in folder.iterdir():
        if file.name.endswith(".meta.json"):
            file.unlink()
        else:
            file.write_bytes(DIGEST.sub(b"-", file.read_bytes()))
    for name, data in [("exit", b"%d" % run.returncode), ("stderr", run.stderr), ("stdout", run.stdout)]:
        (folder / name).write_bytes(data.replace(str(folder).encode(), b"").replace(str(ROOT).encode(), b""))


def difference(a, b):
    """The first lines that differ."""
    try:
        texts = [data.decode().splitlines() for data in (a, b)]
    except UnicodeDecodeError:
        return [f"{len(a)} and {len(b)} bytes that differ"]
    lines = [line for line in difflib.unified_diff(*texts, lineterm="", n=0) if not line.startswith(("---", "+++", "@@"))]
    return [line[:200] for line in lines[:6]] + (["..."] if len(lines) > 6 else [])


if __name__ == "__main__":
    sys.exit(main())
