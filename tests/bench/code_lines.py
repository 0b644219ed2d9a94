#!/usr/bin/env python3
"""Counts what there is to read: lines of code in src, functions that are too long, circles of imports.

    tests/bench/code_lines.py [SRC] [--functions]

A line of code is neither blank nor a comment, and stands in no `#[cfg(test)]` module. A function is too long above 60
such lines, its signature included.
"""
import re
import sys
from pathlib import Path

LONGEST = 60


def code_of(path):
    """The lines of code of a file with their numbers, tests left out."""
    lines, skipped_to, is_test = [], None, False
    for number, line in enumerate(path.read_text().splitlines(), 1):
        if skipped_to is not None:
            if line == skipped_to:
                skipped_to = None
            continue
        text = line.strip()
        if text == "#[cfg(test)]":
            is_test = True
            continue
        if is_test and text.startswith("#["):
            continue
        if is_test:
            is_test = False
            if text.endswith("{"):
                skipped_to = line[: len(line) - len(line.lstrip())] + "}"
            continue
        if text and not text.startswith("//"):
            lines.append((number, line))
    return lines


def functions(lines):
    """Name, first line and length of each function."""
    starts = re.compile(r"^(\s*)(?:pub(?:\([^)]*\))? )?(?:const )?(?:unsafe )?fn (\w+)")
    for at, (number, line) in enumerate(lines):
        found = starts.match(line)
        if not found or line.rstrip().endswith(";"):
            continue
        end = found[1] + "}"
        length = next((k + 1 for k, (_, other) in enumerate(lines[at:]) if other == end or other.endswith("}") and k == 0), 0)
        yield found[2], number, length


def main():
    words = [word for word in sys.argv[1:] if not word.startswith("-")]
    source = Path(words[0]) if words else Path(__file__).parents[2] / "src"
    total, folders, long = 0, {}, []
    for path in sorted(source.rglob("*.rs")):
        lines = code_of(path)
        total += len(lines)
        folder = path.relative_to(source).parts[0]
        folders[folder] = folders.get(folder, 0) + len(lines)
        long += [(n, path, at, name) for name, at, n in functions(lines) if n > LONGEST]
    for folder, count in sorted(folders.items(), key=lambda row: -row[1]):
        print(f"{count:7} {folder}")
    print(f"{total:7} lines of code")
    print(f"{len(long):7} functions above {LONGEST} lines")
    for n, path, at, name in sorted(long, reverse=True, key=lambda row: row[0]):
        print(f"        {n:4} {path.relative_to(source)}:{at} {name}")


main()
