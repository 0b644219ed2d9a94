"""Times of programs on a grbl controller, by small steps of time, beside those that cutc reports.

The program is run as text: lines of G-code, one planner of blocks, axes that move by one step of time after the other. At each
step the axes go as fast as they can and still stop within the blocks that the planner holds. No formula of a ramp is used.
The rules of blocks and junctions are those of grbl's planner.c and motion_control.c.

    python3 tests/bench/grbl_time.py target/release/cutc fixtures/pictures/marker.cut [-p fluidnc]... [--set KEY=VALUE]...

With `--steps X Y Z C` positions are rounded to steps of the motors, so many a mm or a degree, as the firmware does it.
"""

import argparse
import json
import math
import re
import subprocess
import tempfile
import tomllib
from pathlib import Path

STEP_S = 5e-5
WORD = re.compile(r"([A-Z])\s*([-+]?[0-9.]+)")


def limits(profile):
    """Speeds and accelerations of X, Y, Z and the rotary axis."""
    axes, keys = profile["axes"], profile["gcode"]
    rows = [
        (axes["x"]["speed_mm_s"], axes["x"]["acceleration_mm_s2"]),
        (axes["y"]["speed_mm_s"], axes["y"]["acceleration_mm_s2"]),
        (keys["z_speed_mm_s"], keys["z_acceleration_mm_s2"]),
        (axes["c"]["speed_deg_s"], axes["c"]["acceleration_deg_s2"]),
    ]
    return [row[0] for row in rows], [row[1] for row in rows]


def along(direction, most):
    return min(limit / abs(share) for share, limit in zip(direction, most) if share)


class Machine:
    def __init__(self, profile, steps=None):
        keys = profile["gcode"]
        self.steps = steps
        self.speeds, self.accelerations = limits(profile)
        self.room = keys["planner_blocks"]
        self.deviation, self.tolerance = keys["junction_deviation_mm"], keys["arc_tolerance_mm"]
        gap = keys["max_blocks_s"]
        self.gap = 0 if gap == "off" else 1 / gap
        self.letter = keys["letter"]
        self.immediate = keys["outputs"] == "immediate"
        home = profile["home"]
        self.at = [home[0], home[1], None, home[2]]
        self.blocks, self.time = [], 0.0

    def run(self, text):
        inverse = False
        for line in text.splitlines():
            line = re.sub(r"\([^)]*\)", "", line).split(";")[0].strip()
            words = WORD.findall(line)
            codes = {letter + str(int(float(value))) for letter, value in words if letter in "GM"}
            values = {letter: float(value) for letter, value in words if letter not in "GM"}
            inverse = "G93" in codes or (inverse and "G94" not in codes)
            if codes & {"G0", "G1", "G2", "G3"}:
                self.move(codes, values, inverse)
            elif "G4" in codes:
                self.drain()
                self.time += values["P"]
            elif codes & {"M64", "M65", "M68"} and self.immediate:
                pass
            elif any(code[0] == "M" for code in codes):
                self.drain()
        self.drain()
        return self.time

    def move(self, codes, values, inverse):
        names = ["X", "Y", "Z", self.letter]
        to = [values.get(name, place) for name, place in zip(names, self.at)]
        if self.at[2] is None:
            self.at[2] = to[2] if to[2] is not None else None
        start, ends = [p or 0.0 for p in self.at], [p or 0.0 for p in to]
        feed = math.inf if "G0" in codes else values["F"] / 60
        points = [ends]
        if codes & {"G2", "G3"}:
            points = self.chords(start, ends, values["I"], values["J"], "G3" in codes)
        first = True
        if self.steps:
            start, *points = (
                [round(place * steps) / steps for place, steps in zip(point, self.steps)] for point in (start, *points)
            )
        for point in points:
            ways = [b - a for a, b in zip(start, point)]
            length = math.sqrt(sum(way * way for way in ways))
            start = point
            if length > 1e-9:
                self.block([way / length for way in ways], length, feed * length if inverse else feed, first)
            first = False
        self.at = to

    def chords(self, start, ends, i, j, is_left):
        x, y = start[0] + i, start[1] + j
        radius = math.hypot(i, j)
        from_angle = math.atan2(-j, -i)
        sweep = math.atan2(ends[1] - y, ends[0] - x) - from_angle
        sweep = sweep % (2 * math.pi) if is_left else -(-sweep % (2 * math.pi))
        count = int(abs(sweep) * radius / 2 / math.sqrt(self.tolerance * (2 * radius - self.tolerance)))
        points = []
        for k in range(1, count):
            angle = from_angle + sweep * k / count
            rest = [a + (b - a) * k / count for a, b in zip(start, ends)]
            points.append([x + radius * math.cos(angle), y + radius * math.sin(angle), *rest[2:]])
        return [*points, ends]

    def block(self, direction, length, feed, is_line):
        speed = max(min(feed, along(direction, self.speeds)), 1 / 60)
        corner = 0.0
        if self.blocks:
            before = self.blocks[-1]
            cosine = -sum(a * b for a, b in zip(before["direction"], direction))
            if cosine < -0.999999:
                corner = math.inf
            elif cosine <= 0.999999:
                change = [b - a for a, b in zip(before["direction"], direction)]
                size = math.sqrt(sum(part * part for part in change))
                half = math.sqrt((1 - cosine) / 2)
                pull = along([part / size for part in change], self.accelerations)
                corner = math.sqrt(pull * self.deviation * half / (1 - half))
            corner = min(corner, before["speed"], speed)
        acceleration = along(direction, self.accelerations)
        self.blocks.append({
            "direction": direction, "length": length, "speed": speed, "corner": corner,
            "acceleration": acceleration, "is_line": is_line,
        })

    def drain(self):
        """Moves the axes until all blocks are done."""
        blocks, self.blocks = self.blocks, []
        count = len(blocks)
        time, speed, place, i, known, arrival = 0.0, 0.0, 0.0, 0, 0, None
        exit_speed, is_stale = 0.0, True
        while i < count:
            # One line at a time comes in while there is room.
            while known < count and known - i < self.room:
                gap = self.gap if blocks[known]["is_line"] and arrival is not None else 0.0
                if arrival is not None and time < arrival + gap - 1e-12:
                    break
                arrival = time if gap else (time if arrival is None else arrival)
                known += 1
                is_stale = True
            if i >= known:
                time += STEP_S
                continue
            block = blocks[i]
            if is_stale:
                # The blocks behind are gone through from the last one back, to rest there.
                exit_speed = 0.0
                for later in reversed(blocks[i + 1 : known]):
                    reach = math.sqrt(exit_speed**2 + 2 * later["acceleration"] * later["length"])
                    exit_speed = min(later["corner"], reach)
                is_stale = False
            left = block["length"] - place
            faster = min(speed + block["acceleration"] * STEP_S, block["speed"])
            # The speed after a step from which the exit is still reached.
            step = (speed + faster) / 2 * STEP_S
            brake = math.sqrt(exit_speed**2 + 2 * block["acceleration"] * max(left - step, 0))
            after = min(faster, brake)
            # The last step to a stop is not divided any further.
            mean = max((speed + after) / 2, block["acceleration"] * STEP_S / 2)
            if mean * STEP_S < left:
                place += mean * STEP_S
                speed = after
                time += STEP_S
            else:
                time += left / mean
                speed = speed + (after - speed) * left / (mean * STEP_S)
                i, place, is_stale = i + 1, 0.0, True
        self.time += time


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("cutc")
    arguments.add_argument("files", nargs="+")
    arguments.add_argument("-p", dest="profiles", action="append")
    arguments.add_argument("--set", dest="set", action="append", default=[])
    arguments.add_argument("--steps", type=float, nargs=4)
    given = arguments.parse_args()
    options = [word for pair in given.set for word in ("--set", pair)]
    print(f"{'file':32} {'profile':14} {'cutc, s':>10} {'steps, s':>10} {'differs':>8}")
    for name in given.files:
        for profile in given.profiles or ["fluidnc", "fluidnc-arcs", "grblhal", "grblhal-arcs", "mega5x"]:
            shown = subprocess.run([given.cutc, "profile", "show", "-p", profile, *options], capture_output=True, text=True)
            keys = tomllib.loads(shown.stdout)
            with tempfile.TemporaryDirectory() as folder:
                out = Path(folder) / "program.ngc"
                command = [given.cutc, "compile", name, "-p", profile, "-t", "gcode", "-o", str(out), "--format", "json"]
                told = subprocess.run([*command, *options], capture_output=True, text=True)
                ours = json.loads(told.stdout)["controller"]["time_s"]
                theirs = Machine(keys, given.steps).run(out.read_text())
            print(f"{Path(name).name:32} {profile:14} {ours:10.3f} {theirs:10.3f} {100 * (ours / theirs - 1):7.2f} %")


if __name__ == "__main__":
    main()
