#!/usr/bin/env python3
"""Writes embroidery designs as DST files: borders in satin, fills, lettering. Needs the Python package pyembroidery.

python3 tests/bench/embroidery.py designs; cutc sew designs/*.dst -t queue -o queues --force --set sewing.spindle=eased
"""

import math
import os
import random
import sys

import pyembroidery as package


def satin(pattern, points, width):
    """A column from side to side of a line, tenths of a millimetre."""
    for i, (x, y) in enumerate(points[:-1]):
        heading = math.atan2(points[i + 1][1] - y, points[i + 1][0] - x) + math.pi / 2
        side = width(i / len(points)) / 2 * (1 if i % 2 else -1)
        pattern.add_stitch_absolute(package.STITCH, x + side * math.cos(heading), y + side * math.sin(heading))


def line(start, end, pitch):
    """Points from one place to another."""
    count = max(1, math.ceil(math.dist(start, end) / pitch))
    return [[a + (b - a) * i / count for a, b in zip(start, end)] for i in range(count + 1)]


def jump(pattern, place):
    """Moves the cloth with the needle up; as in many files, the first stitch of the run covers the last of the way."""
    turn, left = random.uniform(0, 2 * math.pi), random.uniform(0, 80)
    pattern.add_stitch_absolute(package.JUMP, place[0] + left * math.cos(turn), place[1] + left * math.sin(turn))


def circle(middle, radius, pitch):
    """Points around a middle."""
    count = math.ceil(2 * math.pi * radius / pitch)
    turn = lambda i: 2 * math.pi * i / count
    return [[middle[0] + radius * math.cos(turn(i)), middle[1] + radius * math.sin(turn(i))] for i in range(count + 1)]


def run(pattern, points):
    """Stitches on points."""
    for x, y in points:
        pattern.add_stitch_absolute(package.STITCH, x, y)


def fill(pattern, corner, size, pitch):
    """Rows of stitches, each shifted against the one before."""
    jump(pattern, corner)
    for row in range(int(size[1] / 4)):
        y = corner[1] + 4 * row
        ends = [[corner[0], y], [corner[0] + size[0], y]]
        ends = ends if row % 2 == 0 else ends[::-1]
        first = [ends[0][0] + (ends[1][0] - ends[0][0]) / size[0] * pitch * (row % 3 + 1) / 3, y]
        run(pattern, [ends[0]] + line(first, ends[1], pitch))


def leaf(pattern, start, end, widest):
    """A stem of running stitches, and satin back over it that is widest in its middle."""
    run(pattern, line(start, end, 20))
    satin(pattern, line(end, start, 4), lambda share: 4 + widest * math.sin(math.pi * share))
    run(pattern, [start])


def letter(pattern, corner, height):
    """Strokes in narrow satin, joined by running stitches."""
    x, y = corner
    places = [[x + height * random.random() * 0.6, y + height * random.random()] for _ in range(4)]
    jump(pattern, places[0])
    for start, end in zip(places, places[1:]):
        leaf(pattern, start, end, random.uniform(8, 16))
        run(pattern, line(start, end, 20))


def design(seed):
    """A patch: a fill, a spray of leaves, a border, a few letters."""
    random.seed(seed)
    pattern = package.EmbPattern()
    size = random.randint(300, 700)
    fill(pattern, [-size / 2, -size / 2], [size, size], random.choice([30, 35, 40]))
    pattern.add_command(package.COLOR_CHANGE)
    at = [-size / 2, 0]
    jump(pattern, at)
    for _ in range(random.randint(10, 25)):
        turn, length = random.uniform(0, 2 * math.pi), random.uniform(60, 150)
        leaf(pattern, at, [at[0] + length * math.cos(turn), at[1] + length * math.sin(turn)], random.uniform(15, 70))
        on = [at[0] + size / 25, at[1] + random.uniform(-20, 20)]
        run(pattern, line(at, on, 20))
        at = on
    pattern.add_command(package.COLOR_CHANGE)
    widest = random.randint(25, 60)
    ring = circle([0, 0], size * 0.75, 4)
    jump(pattern, ring[0])
    run(pattern, circle([0, 0], size * 0.75, 25))
    satin(pattern, ring, lambda share: widest * (0.5 + 0.5 * math.sin(2 * math.pi * share * 3) ** 2))
    pattern.add_command(package.COLOR_CHANGE)
    for i in range(random.randint(4, 12)):
        pattern.add_command(package.TRIM)
        letter(pattern, [-size / 2 + 90 * (i % 6), -60 + 140 * (i // 6)], 100)
    pattern.end()
    return pattern


folder = sys.argv[1]
os.makedirs(folder, exist_ok=True)
for seed in range(1, 25):
    package.write(design(seed), os.path.join(folder, f"{seed:02}.dst"))
