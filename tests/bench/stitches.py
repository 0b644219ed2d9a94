#!/usr/bin/env python3
"""Writes a list of points that is sewn with about so many stitches: lanes of 200 mm, a pitch apart.

python3 tests/bench/stitches.py 1000000 > lanes.csv; cutc sew lanes.csv -t queue
"""

import sys

LANE_MM, PITCH_MM = 200.0, 2.5

print("x_mm,y_mm")
for lane in range(round(int(sys.argv[1]) / (LANE_MM / PITCH_MM + 1))):
    ends = (0.0, LANE_MM) if lane % 2 == 0 else (LANE_MM, 0.0)
    for x in ends:
        print(f"{x},{lane * PITCH_MM}")
