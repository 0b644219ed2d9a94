//! Plain DXF: `ezdxf` writes drawings of all kinds of lines, and finds as many of the same lengths on each layer as `cutc`.

use std::path::Path;
use std::process::Command;

use serde_json::Value;

use crate::{is_there, tell};

/// Drawings that are written.
const DRAWINGS: usize = 300;
/// Farthest that the length of a layer may differ, mm, for each curve on it.
const OFF: f64 = 0.01;
/// Tolerance with which drawings are read, mm: chords of a quarter of it lack less than that.
const TOLERANCE: &str = "path.tolerance_mm=0.002";

/// Writes drawings of lines, arcs, ellipses, splines and polylines, some of them in blocks that are put somewhere, and of each
/// layer how many have a length, how many of these are curves, and how long all are as the package itself draws them.
const WRITE: &str = r#"
import json, math, random, sys, ezdxf
from ezdxf.math import BSpline, closed_uniform_bspline
random.seed(48)
LINES = ("LINE", "ARC", "CIRCLE", "ELLIPSE", "SPLINE", "LWPOLYLINE", "POLYLINE")
KINDS = ["line", "arc", "circle", "ellipse", "spline", "rational", "closed", "light", "old", "space"]
some = lambda a, b: round(random.uniform(a, b), 3)
cell = [0]
place = lambda: (700 * (cell[0] % 6) + some(0, 300), 700 * (cell[0] // 6 % 6) + some(0, 300))
places = lambda count: [place() for _ in range(count)]
bulge = lambda: random.choice([0, some(-1, 1)])
def add(to, layer):
    at, kind = {"layer": layer}, random.choice(KINDS)
    cell[0] += 1
    if kind == "line":
        to.add_line(place(), place(), dxfattribs=at)
    elif kind == "arc":
        to.add_arc(place(), some(5, 200), some(0, 360), some(0, 360), dxfattribs=at)
    elif kind == "circle":
        to.add_circle(place(), some(5, 200), dxfattribs=at)
    elif kind == "ellipse":
        turn, size = some(0, 6.28), some(20, 200)
        major = (size * math.cos(turn), size * math.sin(turn))
        to.add_ellipse(place(), major, some(0.2, 1), some(0, 3), some(3.1, 6.2), dxfattribs=at)
    elif kind == "spline":
        to.add_spline(dxfattribs=at).apply_construction_tool(BSpline(places(7), order=random.choice([3, 4, 6])))
    elif kind == "rational":
        weights = [some(.3, 3) for _ in range(6)]
        to.add_spline(dxfattribs=at).apply_construction_tool(BSpline(places(6), order=4, weights=weights))
    elif kind == "closed":
        to.add_spline(dxfattribs=at).apply_construction_tool(closed_uniform_bspline(places(6)))
    elif kind == "light":
        points = [(*at, bulge()) for at in places(random.randint(2, 8))]
        to.add_lwpolyline(points, format="xyb", close=random.random() < .5, dxfattribs=at)
    elif kind == "old":
        points = [(*at, bulge()) for at in places(5)]
        to.add_polyline2d(points, format="xyb", close=random.random() < .5, dxfattribs=at)
    else:
        to.add_polyline3d([(*at, some(0, 9)) for at in places(4)], dxfattribs=at)
def flat(entity, layer):
    own = layer if entity.dxf.layer == "0" and layer else entity.dxf.layer
    if entity.dxftype() == "INSERT":
        for one in entity.multi_insert() if entity.mcount > 1 else [entity]:
            for inner in one.virtual_entities():
                yield from flat(inner, own)
    elif entity.dxftype() in LINES:
        yield own, entity
def along(points):
    return sum(math.dist((a.x, a.y), (b.x, b.y)) for a, b in zip(points, points[1:]))
def bulged(places, is_closed):
    """Arcs turn by four times the arc tangent of their bulge."""
    length = 0
    for (x, y, bulge), (u, v, _) in zip(places, places[1:] + places[:1] if is_closed else places[1:]):
        turn, chord = 4 * math.atan(abs(bulge)), math.dist((x, y), (u, v))
        length += chord * turn / 2 / math.sin(turn / 2) if turn else chord
    return length
def measured(line):
    kind = line.dxftype()
    if kind == "LINE":
        return along([line.dxf.start, line.dxf.end])
    if kind in ("ARC", "CIRCLE"):
        turn = (line.dxf.end_angle - line.dxf.start_angle) % 360 if kind == "ARC" else 360
        return line.dxf.radius * math.radians(turn)
    if kind == "ELLIPSE":
        return along(list(line.flattening(0.0001)))
    if kind == "SPLINE":
        return along(list(line.construction_tool().approximate(5000)))
    if kind == "LWPOLYLINE":
        return bulged([(x, y, b) for x, y, b in line.get_points("xyb")], line.closed)
    if line.is_2d_polyline:
        return bulged([(v.dxf.location.x, v.dxf.location.y, v.dxf.get("bulge", 0)) for v in line.vertices], line.is_closed)
    return along([v.dxf.location for v in line.vertices])
def put(to, name, layer):
    size = some(.5, 2)
    attributes = {"layer": layer, "rotation": some(0, 360), "xscale": size, "yscale": random.choice([size, -size])}
    if random.random() < .3:
        attributes |= {"column_count": 2, "row_count": 3, "column_spacing": 4500, "row_spacing": 4500}
    to.add_blockref(name, place(), dxfattribs=attributes)
for number in range(int(sys.argv[1])):
    doc = ezdxf.new(random.choice(["R2000", "R2010", "R2018"]))
    doc.header["$INSUNITS"] = 4
    space, outer = doc.modelspace(), None
    for _ in range(random.randint(1, 6)):
        add(space, random.choice("AB"))
    for name in ["inner", "outer"][: random.randint(0, 2)]:
        block = doc.blocks.new(name, base_point=place())
        for _ in range(random.randint(1, 3)):
            add(block, random.choice("0AB"))
        if outer:
            put(block, outer, "B")
        outer = name
    if outer:
        put(space, outer, "A")
    told = {}
    for entity in space:
        for layer, line in flat(entity, None):
            row = told.setdefault(layer, {"count": 0, "length_mm": 0.0, "curves": 0})
            length = measured(line)
            row["count"] += length > 0
            row["length_mm"] += length
            row["curves"] += line.dxftype() != "LINE"
    doc.saveas(f"drawing-{number}.dxf")
    json.dump(told, open(f"drawing-{number}.json", "w"))
"#;

/// Layers of a drawing as this program reads it.
fn ours(name: &str, folder: &Path) -> Value {
    let mut command = Command::new(env!("CARGO_BIN_EXE_cutc"));
    let arguments = ["info", name, "--from", "dxf", "--format", "json", "--set", TOLERANCE, "--layers", "*=ignore"];
    let ran = command.args(arguments).current_dir(folder).output().expect("the program starts");
    let info: Value = serde_json::from_slice(&ran.stdout).unwrap_or_default();
    assert!(info["layers"].is_array(), "{name}: {}", String::from_utf8_lossy(&ran.stderr));
    info["layers"].clone()
}

#[test]
fn ezdxf_finds_the_same_lines_of_the_same_lengths_in_drawings_of_its_own() {
    if !is_there("the Python package ezdxf", Command::new("python3").args(["-c", "import ezdxf"])) {
        return;
    }
    let folder = tempfile::tempdir().expect("a directory");
    let folder = folder.path();
    let count = DRAWINGS.to_string();
    let ran = Command::new("python3").args(["-c", WRITE, &count]).current_dir(folder).output().expect("python3 starts");
    assert!(ran.status.success(), "{}", String::from_utf8_lossy(&ran.stderr));
    let mut compared = 0;
    for number in 0..DRAWINGS {
        let ours = ours(&format!("drawing-{number}.dxf"), folder);
        let theirs = std::fs::read(folder.join(format!("drawing-{number}.json"))).expect("their count");
        let theirs: Value = serde_json::from_slice(&theirs).expect("JSON");
        for (name, layer) in theirs.as_object().expect("layers").iter().filter(|(_, layer)| layer["count"] != 0) {
            let own = ours.as_array().into_iter().flatten().find(|own| own["name"] == *name.as_str());
            let own = own.unwrap_or_else(|| panic!("drawing {number} has no layer {name}"));
            assert_eq!(own["count"], layer["count"], "drawing {number}, layer {name}");
            let length = |layer: &Value| layer["length_mm"].as_f64().expect("a length");
            let curves = layer["curves"].as_f64().expect("a count").max(1.0);
            let off = (length(own) - length(layer)).abs() / curves;
            assert!(off <= OFF, "drawing {number}, layer {name}: {off} mm a curve");
            compared += 1;
        }
    }
    tell(&format!("ezdxf and cutc find the same lines on {compared} layers of {DRAWINGS} drawings"));
    assert!(compared > DRAWINGS);
}
