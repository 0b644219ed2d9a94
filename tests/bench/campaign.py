#!/usr/bin/env python3
"""Compile shapes of thirty classes and drawings of five dialects with twenty machines, and count what is refused and why.

A program that is refused by its verification after a compile without errors is a fault of the compiler or of the verifier:
at most one in two thousand may be.

    campaign.py target/release/cutc [--shapes 1000] [--profiles NAME,...] [--classes NAME,...] [--keep FOLDER]

Shapes are made from seeds: the same arguments give the same files. A profile compiles all of them as one batch.
"""
import argparse, collections, json, math, os, random, shutil, subprocess, sys, tempfile

PROFILES = {
    "default": [],
    "new": ["knife.width_mm=8.89", "knife.back_mm=6.35"],
    "narrow": ["knife.width_mm=3", "knife.back_mm=1.5"],
    "middle": ["knife.width_mm=6", "knife.back_mm=4"],
    "two-edges": ["knife.edges=2", "knife.width_mm=6", "knife.back_mm=3"],
    "chord": ['knife.follow="chord"'],
    "chord-narrow": ['knife.follow="chord"', "knife.width_mm=3", "knife.back_mm=1.5"],
    "nibble": ['knife.tight_curves="nibble"'],
    "range": ["c.range_deg=[-200,200]"],
    "range-one-turn": ["c.range_deg=[-370,370]"],
    "max-down": ["knife.max_down_mm=100"],
    "tolerance-fine": ["path.tolerance_mm=0.02"],
    "tolerance-coarse": ["path.tolerance_mm=0.3"],
    "no-overlaps": ["knife.front_overlap_mm=0", "knife.corner_front_overlap_mm=0", "knife.heel_overlap_mm=0", "knife.corner_heel_overlap_mm=0"],
    "long-overlaps": ["knife.front_overlap_mm=3", "knife.corner_front_overlap_mm=3", "knife.heel_overlap_mm=3", "knife.corner_heel_overlap_mm=3"],
    "corner-20": ["corner.angle_deg=20"],
    "corner-70": ["corner.angle_deg=70"],
    "counts-fine": ["@counts", "counts.x.per_mm=2000", "counts.y.per_mm=2000", "counts.c.per_deg=1000"],
    "counts-coarse": ["@counts", "counts.x.per_mm=200", "counts.y.per_mm=200", "counts.c.per_deg=200"],
    "gcode": ["@gcode"],
}


def ring(rnd, count, radius):
    return [(radius(a) * math.cos(a), radius(a) * math.sin(a)) for a in (2 * math.pi * i / count for i in range(count))]


def smooth(rnd, size, waves):
    parts = [(k, rnd.uniform(-0.15, 0.15) / k, rnd.uniform(0, 2 * math.pi)) for k in range(1, waves + 1)]
    return lambda a: size * (1 + sum(h * math.cos(k * a + p) for k, h, p in parts))


def bumps(rnd, inwards, kind, count, size):
    """A rectangle whose lower edge has bumps."""
    w, h = rnd.uniform(120, 200), rnd.uniform(60, 120)
    points, step = [(0, 0)], w / (count + 1)
    sign = 1 if inwards else -1
    for i in range(1, count + 1):
        x, s = step * i, size * rnd.uniform(0.7, 1.3)
        if kind == "round":
            n = rnd.randint(5, 18)
            points += [(x - s * math.cos(math.pi * k / n), sign * s * math.sin(math.pi * k / n)) for k in range(n + 1)]
        elif kind == "v":
            points += [(x - s / 3, 0), (x, sign * s), (x + s / 3, 0)]
        elif kind == "box":
            points += [(x - s / 3, 0), (x - s / 3, sign * s), (x + s / 3, sign * s), (x + s / 3, 0)]
        elif kind == "u":
            n = 6
            points += [(x - s / 3, 0), (x - s / 3, sign * s)]
            points += [(x - s / 3 * math.cos(math.pi * k / n), sign * (s + s / 3 * math.sin(math.pi * k / n))) for k in range(1, n)]
            points += [(x + s / 3, sign * s), (x + s / 3, 0)]
        elif kind == "spike":
            points += [(x, 0), (x + rnd.uniform(-1, 1), sign * s), (x, 0)]
        elif kind == "thin-box":
            t = rnd.choice([0.1, 0.2, 0.4])
            points += [(x, 0), (x, sign * s), (x + t, sign * s), (x + t, 0)]
    return points + [(w, 0), (w, h), (0, h)]


def rounded(w, h, r, n):
    points = []
    for cx, cy, a in ((w - r, r, -90), (w - r, h - r, 0), (r, h - r, 90), (r, r, 180)):
        points += [(cx + r * math.cos(math.radians(a + 90 * k / n)), cy + r * math.sin(math.radians(a + 90 * k / n))) for k in range(n + 1)]
    return points


def moved(points, dx, dy):
    return [(x + dx, y + dy) for x, y in points]


def scallops(rnd):
    s, n, depth = rnd.uniform(6, 15), rnd.randint(4, 9), rnd.uniform(2, 6)
    points = [(0, 0)]
    for i in range(n):
        points += [(s * (i + k / 8), -depth * math.sin(math.pi * k / 8)) for k in range(9 if i == n - 1 else 8)]
    return points + [(s * n, 60), (0, 60)]


def shape(kind, rnd):
    """The closed contours of a drawing, a list a piece."""
    u = rnd.uniform
    square = lambda w, h: [(0, 0), (w, 0), (w, h), (0, h)]
    if kind == "polygon":
        n = rnd.randint(3, 12); return [[ring(rnd, n, lambda a: u(30, 90))]]
    if kind == "small-polygon":
        n = rnd.randint(5, 40); return [[ring(rnd, n, lambda a: u(4, 10))]]
    if kind == "curve":
        return [[ring(rnd, rnd.randint(40, 200), smooth(rnd, u(30, 120), 4))]]
    if kind == "wavy":
        return [[ring(rnd, rnd.randint(80, 300), smooth(rnd, u(30, 90), 9))]]
    if kind == "dense":
        f = smooth(rnd, u(15, 60), 3); n = int(2 * math.pi * 40 / 0.3); return [[ring(rnd, n, f)]]
    if kind == "dense-circle":
        r = u(10, 40); return [[ring(rnd, int(2 * math.pi * r / 0.3), lambda a: r)]]
    if kind == "noisy":
        f = smooth(rnd, u(30, 80), 3); return [[ring(rnd, rnd.randint(60, 200), lambda a: f(a) + u(-0.15, 0.15))]]
    if kind == "very-noisy":
        f = smooth(rnd, u(30, 80), 3); return [[ring(rnd, rnd.randint(60, 200), lambda a: f(a) + u(-0.5, 0.5))]]
    if kind == "circle":
        r = u(2, 40); return [[ring(rnd, rnd.randint(8, 72), lambda a: r)]]
    if kind == "ellipse":
        a, b = u(20, 60), u(3, 20); return [[[(a * x, b * y) for x, y in ring(rnd, rnd.randint(24, 120), lambda _: 1)]]]
    if kind == "bites":
        return [[bumps(rnd, True, "round", rnd.randint(1, 4), u(2, 8))]]
    if kind == "tabs":
        return [[bumps(rnd, False, "round", rnd.randint(1, 4), u(2, 8))]]
    if kind == "v-in":
        return [[bumps(rnd, True, "v", rnd.randint(1, 6), u(1, 9))]]
    if kind == "v-out":
        return [[bumps(rnd, False, "v", rnd.randint(1, 6), u(1, 9))]]
    if kind == "castle":
        return [[bumps(rnd, rnd.random() < 0.7, "box", rnd.randint(1, 6), u(2, 9))]]
    if kind == "u-notch":
        return [[bumps(rnd, rnd.random() < 0.7, "u", rnd.randint(1, 6), u(2, 9))]]
    if kind == "spikes":
        return [[bumps(rnd, rnd.random() < 0.7, "spike", rnd.randint(1, 6), u(3, 9))]]
    if kind == "thin-boxes":
        return [[bumps(rnd, rnd.random() < 0.8, "thin-box", rnd.randint(1, 6), u(3, 9))]]
    if kind == "scallops":
        return [[scallops(rnd)]]
    if kind == "rounded-hole":
        w, h = u(60, 140), u(60, 140); r = u(0.2, 8)
        return [[moved(rounded(w - 30, h - 30, r, rnd.randint(2, 9)), 15, 15), square(w, h)]]
    if kind == "rounded":
        return [[rounded(u(40, 120), u(40, 120), u(0.5, 15), rnd.randint(2, 12))]]
    if kind == "small-holes":
        holes = [moved(ring(rnd, rnd.randint(6, 24), lambda a, r=u(1, 6): r), 30 * i + 20, 25) for i in range(4)]
        return [holes + [square(150, 50)]]
    if kind == "nested":
        return [[moved(square(20, 20), 40, 40)], [moved(square(60, 60), 20, 20), square(100, 100)]]
    if kind == "touching":
        w = u(20, 60); g = rnd.choice([-0.2, -0.1, 0, 0.1, 0.3])
        return [[moved(square(w, 80), (w + g) * i, 0)] for i in range(4)]
    if kind == "touching-notched":
        w = u(30, 60); g = rnd.choice([-0.2, -0.1, 0, 0.1, 0.3]); d = u(3, 6)
        notched = [(0, 0), (w / 2 - 1, 0), (w / 2, d), (w / 2 + 1, 0), (w, 0), (w, 40 - 1), (w - d, 40), (w, 40 + 1), (w, 80), (0, 80)]
        return [[moved(notched, (w + g) * i, (80 + g) * j)] for i in range(3) for j in range(2)]
    if kind == "overlapping":
        return [[moved(ring(rnd, 30, smooth(rnd, 35, 3)), 60 * i, 0)] for i in range(3)]
    if kind == "fine-corners":
        n = rnd.randint(8, 16); return [[ring(rnd, n, lambda a, r=u(20, 60): r)]]
    if kind == "slivers":
        w = u(1, 6); return [[[(0, 0), (u(60, 120), u(-2, 2)), (u(60, 120), w), (0, w)]]]
    if kind == "small-v":
        return [[[(0, 0), (60, 0), (60 + u(0.3, 2), u(0.3, 2)), (60 + u(2.1, 4), 0), (120, 0), (120, 80), (0, 80)]]]
    if kind == "stairs":
        points, x, y = [(0, 0), (100, 0)], 100, 0
        for _ in range(rnd.randint(3, 9)):
            y += u(1, 12); points.append((x, y)); x -= u(1, 10); points.append((x, y))
        return [[points + [(0, y)]]]
    raise ValueError(kind)


KINDS = ["polygon", "small-polygon", "curve", "wavy", "dense", "dense-circle", "noisy", "very-noisy", "circle", "ellipse", "bites",
         "tabs", "v-in", "v-out", "castle", "u-notch", "spikes", "thin-boxes", "scallops", "rounded-hole", "rounded", "small-holes",
         "nested", "touching", "touching-notched", "overlapping", "fine-corners", "slivers", "small-v", "stairs"]


def iso(pieces, rnd):
    """An ISO cut file in 0.1 mm, turned about and moved as lies are."""
    angle = rnd.choice([0, 0, 90, 180, rnd.uniform(0, 360)])
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    turned = [[[(c * x - s * y, s * x + c * y) for x, y in ring] for ring in piece] for piece in pieces]
    points = [p for piece in turned for ring in piece for p in ring]
    dx, dy = (20 - min(p[k] for p in points) for k in (0, 1))
    out = ["H1*G71"]
    for i, piece in enumerate(turned, 1):
        out.append(f"N{i}*M15*M15")
        for k, ring in enumerate(piece):
            start, backwards = rnd.randrange(len(ring)), rnd.random() < 0.5
            ring = ring[start:] + ring[:start]
            if backwards: ring = ring[::-1]
            at = [f"X{round(10 * (x + dx))}Y{round(10 * (y + dy))}" for x, y in ring + ring[:1]]
            at = [p for j, p in enumerate(at) if j == 0 or p != at[j - 1]]
            out += [at[0], "M14", *at[1:], "M15"]
    return "*".join(out) + "*M0*\n"


def tricky(rnd):
    """Pieces with what drawings have at their worst: lines, each a list of places with whether it is closed, and holes."""
    u = rnd.uniform
    pieces, x = [], 0
    for _ in range(rnd.randint(1, 3)):
        size = rnd.choice([6, 20, 60, 150]); w, h = size * u(0.6, 1.4), size * u(0.6, 1.4)
        kind = rnd.choice(["blob", "blob", "box", "needle", "short"])
        if kind == "blob": outline = moved(ring(rnd, rnd.choice([3, 5, 8, 14, 40]), lambda a: size * u(0.3, 0.6)), size, size)
        elif kind == "box": outline = [(0, 0), (w, 0), (w, h), (0, h)]
        elif kind == "needle": outline = [(0, 0), (w + 40, u(-1, 1)), (w + 40, u(1.5, 8)), (0, h)]
        else: outline = [(0, 0), (w, 0), (w + u(0.2, 3), u(0.2, 3)), (w + u(0.2, 3), h), (u(0, 4), h + u(0.1, 4)), (0, h)]
        left, right = min(p[0] for p in outline), max(p[0] for p in outline)
        outline = moved(outline, x - left, 0); x += right - left + rnd.choice([0, 0.1, 0.5, 1, 3, 20])
        at = lambda share: (lambda k, t: tuple(a + (b - a) * t for a, b in zip(outline[k], outline[(k + 1) % len(outline)])))(int(share) % len(outline), share % 1)
        middle = tuple(sum(p[k] for p in outline) / len(outline) for k in (0, 1))
        inwards = lambda p, way: tuple(a + (b - a) * way / max(way, math.dist(p, middle)) for a, b in zip(p, middle))
        lines, holes = [(outline, True)], []
        for _ in range(rnd.choice([0, 0, 1, 2, 4])):
            p = at(rnd.randrange(len(outline)) + rnd.choice([0, 0.01, 0.3, 0.5, 0.98])); lines.append(([p, inwards(p, u(1, 9))], False))
        for _ in range(rnd.choice([0, 0, 1, 2])):
            p, r = rnd.choice([middle, at(u(0, 9)), inwards(at(u(0, 9)), u(1, 12))]), u(1, 6)
            lines.append((moved(rnd.choice([ring(rnd, rnd.choice([3, 4, 12]), lambda a: r), [(0, 0), (r, 0), (r, r), (0, r)]]), *p), True))
        if rnd.random() < 0.4: holes.append(rnd.choice([middle, outline[0], inwards(outline[-1], u(0.2, 3))]))
        pieces.append((lines, holes))
    return pieces


def drawn(dialect, pieces, rnd):
    """A drawing in a dialect."""
    low = [min(p[k] for lines, _ in pieces for line, _ in lines for p in line) - 20 for k in (0, 1)]
    all = [([([(x - low[0], y - low[1]) for x, y in line], closed) for line, closed in lines], [(x - low[0], y - low[1]) for x, y in holes]) for lines, holes in pieces]
    whole = [(line + line[:1] if closed else line) for lines, _ in all for line, closed in lines]
    if dialect == "svg":
        paths = "".join(f'<path d="M{" L".join(f"{x:.3f} {y:.3f}" for x, y in line)}"/>' for line in whole)
        return f'<svg xmlns="http://www.w3.org/2000/svg" width="900mm" height="900mm" viewBox="0 0 900 900">{paths}</svg>\n'
    if dialect == "plt":
        place = lambda p: f"{round(40 * p[0])},{round(40 * p[1])}"
        return "IN;SP1;" + "".join(f"PU{place(line[0])};PD{','.join(map(place, line[1:]))};" for line in whole) + "PU;SP0;\n"
    if dialect == "cut":
        out, place = ["H1*G71"], lambda p: f"X{round(10 * p[0])}Y{round(10 * p[1])}"
        for i, (lines, holes) in enumerate(all, 1):
            out += [f"N{i}*M15*M15"] + [f"{place(p)}*M43" for p in holes]
            for line, closed in lines[::-1]: out += [place(line[0]), "M14", *map(place, line[1:] + line[: closed]), "M15"]
        return "*".join(out) + "*M0*\n"
    pairs, add = [], lambda *more: pairs.extend(more)
    point = lambda layer, p, *more: add((0, "POINT"), (8, layer), (10, f"{p[0]:.2f}"), (20, f"{p[1]:.2f}"), *more)
    def poly(layer, line):
        add((0, "POLYLINE"), (8, layer), (66, 1), (70, 0))
        for x, y in line: add((0, "VERTEX"), (8, layer), (10, f"{x:.2f}"), (20, f"{y:.2f}"))
        add((0, "SEQEND"), (8, layer))
    if dialect == "lines":
        add((0, "SECTION"), (2, "ENTITIES"))
        for line in whole: poly("CUT", line)
        add((0, "ENDSEC"), (0, "EOF"))
    else:
        add((0, "SECTION"), (2, "BLOCKS"))
        for i, (lines, holes) in enumerate(all):
            add((0, "BLOCK"), (8, 1), (2, f"P{i}"), (70, 0), (10, 0), (20, 0))
            for text in (f"PIECE NAME: P{i}", rnd.choice(["QUANTITY: 1", "QUANTITY: 1,1", "QUANTITY: 2"])): add((0, "TEXT"), (8, 1), (10, 0), (20, 0), (40, 5), (1, text))
            outline = lines[0][0]
            poly(1, outline + outline[: rnd.choice([1, 1, 1, 2, len(outline)])])
            for p in outline if rnd.random() < 0.5 else []: point(rnd.choice([2, 3, 3]), p)
            for line, closed in lines[1:]:
                if closed: poly(11, line + line[:1])
                else:
                    angle = ((50, rnd.choice([0, 45, 90, 180])),) if rnd.random() < 0.4 else ()
                    point(rnd.choice([4, 4, 80, 81, 82, 83]), line[0], (30, rnd.choice([3, 5, 8])), (39, rnd.choice([0, 3, 6])), *angle)
            for p in holes: point(13, p)
            if rnd.random() < 0.3:
                add((0, "LINE"), (8, 6)); add(*zip((10, 20, 11, 21), (f"{c:.2f}" for p in outline[:2] for c in p)))
            add((0, "ENDBLK"), (8, 1))
        add((0, "ENDSEC"), (0, "SECTION"), (2, "ENTITIES"))
        for i in range(len(all)) if rnd.random() < 0.5 else []: add((0, "INSERT"), (8, 1), (2, f"P{i}"), (10, rnd.choice([0, i * 400])), (20, 0))
        for text in ("UNITS: METRIC", "AUTHOR: " + rnd.choice(["Gerber", "CLO", "Optitex", "Richpeace"])): add((0, "TEXT"), (8, 1), (10, 0), (20, 0), (40, 5), (1, text))
        add((0, "ENDSEC"), (0, "EOF"))
    return "".join(f"{code}\n{value}\n" for code, value in pairs)


DRAWN = {"tricky-cut": "cut", "tricky-plot": "plt", "tricky-pattern": "dxf", "tricky-lines": "lines", "tricky-svg": "svg"}


def main():
    ap = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    ap.add_argument("cutc"); ap.add_argument("--shapes", type=int, default=1000)
    ap.add_argument("--profiles", default=",".join(PROFILES)); ap.add_argument("--classes", default=",".join([*KINDS, *DRAWN]))
    ap.add_argument("--keep", help="folder for the shapes, the refused ones by profile")
    ap.add_argument("--show", type=int, default=2, help="refused files that are named for each rule")
    a = ap.parse_args()
    kinds = a.classes.split(",")
    room = tempfile.mkdtemp(); source = os.path.join(room, "in"); os.mkdir(source)
    for i in range(a.shapes):
        kind = kinds[i % len(kinds)]; rnd = random.Random(f"{kind} {i}")
        dialect = DRAWN.get(kind, "cut")
        text = drawn(dialect, tricky(rnd), rnd) if kind in DRAWN else iso(shape(kind, rnd), rnd)
        with open(os.path.join(source, f"{kind}-{i}.{'dxf' if dialect == 'lines' else dialect}"), "w") as f: f.write(text)
    if a.keep:
        os.makedirs(a.keep, exist_ok=True); shutil.copytree(source, os.path.join(a.keep, "in"), dirs_exist_ok=True)
    total = collections.Counter(); by_rule = collections.defaultdict(list); errors = collections.Counter()
    for name in a.profiles.split(","):
        target, sets = "csv", []
        for key in PROFILES[name]:
            if key.startswith("@"): target = key[1:]
            else: sets += ["--set", key]
        command = [a.cutc, "compile", source, "-t", target, "-o", os.path.join(room, "out"), "--force", "--format", "json", *sets]
        run = subprocess.run(command, capture_output=True, text=True)
        try: reports = json.loads(run.stdout)
        except json.JSONDecodeError: sys.exit(f"{name}: {run.stdout[:500]} {run.stderr[:1000]}")
        shutil.rmtree(os.path.join(room, "out"), ignore_errors=True)
        counts = collections.Counter()
        for report in reports:
            broken = [e["message"] for e in report["errors"] if e["code"] == "verify/broken"]
            counts["all"] += 1
            if broken:
                counts["refused"] += 1
                for message in broken: by_rule[message.split(":")[0]].append((name, os.path.basename(report["file"]), message))
            elif report["errors"]:
                counts["errors"] += 1; errors[report["errors"][0]["code"]] += 1
        total += counts
        print(f"{name:16} {counts['all']:5} compiled, {counts['errors']:4} with errors, {counts['refused']:4} refused", flush=True)
    print(f"{'all':16} {total['all']:5} compiled, {total['errors']:4} with errors, {total['refused']:4} refused: one in {total['all'] / max(1, total['refused']):.0f}")
    print("errors:", dict(errors))
    for rule, found in sorted(by_rule.items(), key=lambda item: -len(item[1])):
        print(f"{rule}: {len(found)}", dict(collections.Counter(f.rsplit('-', 1)[0] for _, f, _ in found).most_common(8)), dict(collections.Counter(n for n, _, _ in found).most_common(6)))
        for name, file, message in found[: a.show]: print(f"    {name}: {file}: {message}")
    shutil.rmtree(room)


main()
