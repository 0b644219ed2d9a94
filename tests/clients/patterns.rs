//! Pattern DXF: `ezdxf` counts the same outlines, cut-outs, notches, holes and texts in the same files.

use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;

use crate::{is_there, python, tell};

/// Writes sets of patterns: blocks with outlines, cut-outs, notches, holes and texts, in old and new versions of DXF.
const WRITE: &str = r#"
import random, ezdxf
random.seed(11)
for version in ["R12", "R2000", "R2010"]:
    doc = ezdxf.new(version)
    doc.header["$INSUNITS"] = 4
    for number in range(random.randint(3, 6)):
        block = doc.blocks.new(f"PIECE-{number}")
        width, height = random.randint(200, 500), random.randint(150, 400)
        def ring(layer, x, y, w, h):
            places = [(x, y), (x + w, y), (x + w, y + h), (x, y + h)]
            add = block.add_polyline2d if version == "R12" else block.add_lwpolyline
            add(places, close=True, dxfattribs={"layer": layer})
        ring("1", 0, 0, width, height)
        for k in range(random.randint(0, 2)):
            ring("11", 40 + 60 * k, 60, 30, 20)
        for k in range(random.randint(0, 3)):
            block.add_point((30 + 40 * k, 0, 5), dxfattribs={"layer": "4"})
        for k in range(random.randint(0, 3)):
            block.add_point((30 + 40 * k, 120), dxfattribs={"layer": "13"})
        block.add_text(f"PIECE NAME: P{number}", dxfattribs={"layer": "1"})
        doc.modelspace().add_blockref(f"PIECE-{number}", (600 * number, 0), dxfattribs={"layer": "1"})
    doc.modelspace().add_text("UNITS: METRIC", dxfattribs={"layer": "1"})
    doc.saveas(f"theirs-{version}.dxf")
"#;

/// Prints what stands in the files that are named, as far as one entity of them is one thing that is cut: outlines that are
/// closed polylines, each block placed at most once.
const READ: &str = r#"
import json, ezdxf
CUT = {"1", "4", "6", "11", "13", "80", "81", "82", "83"}
found = {}
for name in json.load(open("names.json")):
    try:
        doc = ezdxf.readfile(name)
    except (ezdxf.DXFError, UnicodeDecodeError):
        continue
    blocks = [block for block in doc.blocks if not block.name.startswith("*")]
    count = {"outline": 0, "cut-out": 0, "notches": 0, "drills": 0, "texts": 0}
    is_plain, seen = True, set()
    placed = [entity.dxf.name for entity in doc.modelspace() if entity.dxftype() == "INSERT"]
    is_plain &= len(placed) == len(set(placed)) and (not placed or len(placed) == len(blocks))
    # Texts of title blocks and legends belong to no piece.
    is_outline = lambda entity: entity.dxf.layer == "1" and entity.dxftype() in ("POLYLINE", "LWPOLYLINE")
    is_plain &= all(any(map(is_outline, block)) for block in blocks)
    for layout in [doc.modelspace()] + blocks:
        for entity in layout:
            kind, layer = entity.dxftype(), entity.dxf.layer
            if kind in ("TEXT", "MTEXT"):
                count["texts"] += 1
            elif kind == "INSERT":
                is_plain &= layout is doc.modelspace() and not entity.attribs
            elif layer in ("1", "11") and kind in ("POLYLINE", "LWPOLYLINE"):
                is_plain &= layout is not doc.modelspace()
                points = entity.points() if kind == "POLYLINE" else entity.get_points("xy")
                key = (id(layout), tuple(tuple(point) for point in points))
                is_plain &= bool(entity.is_closed) and key not in seen and len(key[1]) > 2
                seen.add(key)
                count["outline" if layer == "1" else "cut-out"] += 1
            elif kind == "POINT" and layer in ("4", "80", "81", "82", "83"):
                count["notches"] += 1
            elif kind == "POINT" and layer == "13":
                count["drills"] += 1
            elif layer in CUT or kind == "ATTDEF":
                is_plain = False
    if is_plain:
        found[name] = count
print(json.dumps(found))
"#;

/// Files that ezdxf reads otherwise, and why.
const OTHERWISE: [(&str, &str); 1] =
    [("block-behind-the-section.dxf", "it reads no block behind the section of blocks")];

/// Numbers of things by their names.
type Counts = BTreeMap<String, u64>;

/// What this program counts in a file, and whether it warns of a notch or an outline that is not what an entity says.
fn ours(name: &str, folder: &Path) -> (Counts, bool) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_cutc"));
    let arguments = ["info", name, "--size", "all", "--quantity", "one", "--format", "json", "--all"];
    let ran = command.args(arguments).current_dir(folder).output().expect("the program starts");
    let said = String::from_utf8_lossy(&ran.stderr).into_owned();
    assert!(ran.status.success(), "{name}: {said}");
    let info: serde_json::Value = serde_json::from_slice(&ran.stdout).expect("JSON");
    let number = |value: &serde_json::Value| value.as_u64().unwrap_or_default();
    let of_class = |class: &str| {
        let lines = info["lines"].as_array().into_iter().flatten();
        lines
            .filter(|line| line["class"] == class && line["cut"] == true)
            .map(|line| number(&line["count"]))
            .sum::<u64>()
    };
    let notches = info["notches"].as_object().into_iter().flatten().map(|(_, count)| number(count)).sum();
    let counts = [
        ("outline", of_class("outline")),
        ("cut-out", of_class("cut-out")),
        ("notches", notches),
        ("drills", number(&info["drills"])),
        ("texts", number(&info["labels"]) + number(&info["texts_outside"])),
    ];
    let codes = ["dxf/notch", "dxf/no-outline", "dxf/not-placed", "dxf/large-cut-out", "dxf/no-size", "dxf/paper"];
    let is_told = codes.iter().any(|code| said.contains(code));
    (counts.into_iter().map(|(name, count)| (name.to_owned(), count)).collect(), is_told)
}

#[test]
fn ezdxf_counts_the_same_in_patterns_of_its_own_and_in_the_fixtures() {
    if !is_there("the Python package ezdxf", Command::new("python3").args(["-c", "import ezdxf"])) {
        return;
    }
    let folder = tempfile::tempdir().expect("a directory");
    let ran = python(WRITE, folder.path());
    assert!(ran.status.success(), "{}", String::from_utf8_lossy(&ran.stderr));
    let fixtures = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/pattern");
    for file in std::fs::read_dir(fixtures).expect("a folder") {
        let file = file.expect("readable");
        std::fs::copy(file.path(), folder.path().join(file.file_name())).expect("a copy");
    }
    let files = std::fs::read_dir(folder.path()).expect("a folder");
    let mut names: Vec<String> =
        files.map(|file| file.expect("readable").file_name().to_string_lossy().into()).collect();
    names.sort();
    std::fs::write(folder.path().join("names.json"), serde_json::to_vec(&names).expect("JSON")).expect("writable");
    let ran = python(READ, folder.path());
    assert!(ran.status.success(), "{}", String::from_utf8_lossy(&ran.stderr));
    let theirs: BTreeMap<String, Counts> = serde_json::from_slice(&ran.stdout).expect("JSON");
    let mut compared = 0;
    for (name, theirs) in &theirs {
        let (ours, is_told) = ours(name, folder.path());
        if is_told || OTHERWISE.iter().any(|(other, _)| other == name) {
            continue;
        }
        assert_eq!(ours, *theirs, "{name}");
        compared += 1;
    }
    tell(&format!("ezdxf and cutc count the same in {compared} files"));
    assert!(compared >= 20 && theirs.keys().filter(|name| name.starts_with("theirs-")).count() == 3, "{compared}");
}
