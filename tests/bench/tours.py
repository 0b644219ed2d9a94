"""Orders points at random as `order.policy` orders pieces, and tells how long that takes and how much longer the tours are than
those of LKH (Helsgaun's Lin-Kernighan heuristic, as `elkai` has it: `pip install elkai numpy`) or, of more points than that
can take, than what the shortest tend to from above.

    cargo build --release --features bench --example tour
    python3 tests/bench/tours.py target/release/examples/tour
"""

import argparse
import math
import subprocess

import numpy

# LKH gets all distances between points: of more it would fill the memory.
MOST_OF_LKH = 1300
COMPARED = [40, 80, 160, 320, 640, 1300]
GROWTH = [20_000, 50_000, 100_000, 200_000]
SIDE = 10_000.0


def main():
    parser = argparse.ArgumentParser(description="How long tours are, and how long they take.")
    parser.add_argument("tour", help="the example of that name")
    parser.add_argument("--seeds", type=int, default=3, help="point sets of each size up to 1,300")
    options = parser.parse_args()
    for count in COMPARED:
        ratios, times = zip(*(compared(options.tour, count, seed) for seed in range(options.seeds)))
        print(f"{count}: {max(ratios):.4f} of LKH at the most, {max(times):.3f} s", flush=True)
    for count in GROWTH:
        points = made(count, 0)
        length, time = toured(options.tour, points)
        print(f"{count}: {length / least(count):.4f} of 0.7124 sqrt(n A), {time:.3f} s", flush=True)


def made(count, seed):
    return numpy.random.Generator(numpy.random.PCG64([count, seed])).random((count, 2)) * SIDE


def least(count):
    """What the shortest tour through points at random in a square tends to, from above (Johnson, McGeoch & Rothberg 1996,
    Asymptotic experimental analysis for the Held-Karp traveling salesman bound)."""
    return 0.7124 * math.sqrt(count) * SIDE


def compared(tour, count, seed):
    points = made(count, seed)
    length, time = toured(tour, points)
    return length / shortest(points), time


def toured(tour, points):
    text = "".join(f"{x!r} {y!r}\n" for x, y in points.tolist())
    runs = [subprocess.run([tour], input=text, capture_output=True, text=True, check=True).stdout for _ in range(2)]
    (first, *order), (_, *again) = (run.split() for run in runs)
    assert order == again, "another order in another run"
    order = [int(visit) for visit in order]
    assert sorted(order) == list(range(len(points))), "each point once"
    return length_of(points[order]), float(first)


def length_of(points):
    """From the origin on."""
    ways = numpy.diff(numpy.vstack([[0.0, 0.0], points]), axis=0)
    return numpy.hypot(*ways.T).sum()


def shortest(points):
    """Length of LKH's open tour from the origin: a round trip over one more, next to the origin and as far from each point."""
    import elkai

    count = len(points)
    all_points = numpy.vstack([[0.0, 0.0], points])
    between = numpy.hypot(*(all_points[:, None] - all_points[None]).transpose(2, 0, 1))
    ways = numpy.full((count + 2, count + 2), 2 * SIDE)
    ways[:-1, :-1] = between
    ways[0, -1] = ways[-1, 0] = 0
    trip = elkai.DistanceMatrix((ways * 10).round().astype(int).tolist()).solve_tsp(1)[:-1]
    at = trip.index(count + 1)
    trip = trip[at + 1 :] + trip[:at]
    if trip[0] != 0:
        trip.reverse()
    assert trip[0] == 0, "the origin is next to the one more"
    return length_of(points[[visit - 1 for visit in trip[1:]]])


main()
