//! Stitch files: `pyembroidery` and `pystitch` read what is written here and agree on every stitch, and what they write is
//! read here.

use std::path::Path;
use std::process::Command;

use crate::{is_there, python};

/// Prints the stitches of every file that is named, tenths of a millimetre, Y upwards, a line each; trims of a thread in use as
/// `trim`.
const READ: &str = r#"
import sys, json, PACKAGE as package
for name in json.load(open("names.json")):
    print("file", name)
    is_sewn = False
    for x, y, command in package.read(name).stitches:
        command &= package.COMMAND_MASK
        if command == package.STITCH: print(round(x), round(-y))
        elif command == package.TRIM and is_sewn: print("trim")
        is_sewn = command == package.STITCH or is_sewn and command != package.TRIM
"#;

/// Writes seams with jumps, trims, other threads and stops, with stitches of many lengths.
const WRITE: &str = r#"
import random, PACKAGE as package
random.seed(3)
pattern = package.EmbPattern()
for seam in range(6):
    x, y = random.randint(-900, 900), random.randint(-900, 900)
    pattern.add_stitch_absolute(package.JUMP, x, y)
    for _ in range(80):
        pattern.add_stitch_absolute(package.STITCH, x, y)
        x, y = x + random.randint(-70, 70), y + random.randint(-70, 70)
    pattern.add_command([package.TRIM, package.COLOR_CHANGE, package.STOP][seam % 3])
pattern.end()
for extension in EXTENSIONS:
    package.write(pattern, "theirs." + extension)
"#;

/// Formats that both packages write.
const FORMATS: [&str; 8] = ["dst", "exp", "pes", "pec", "jef", "vp3", "xxx", "u01"];

const PACKAGES: [&str; 2] = ["pyembroidery", "pystitch"];

/// Runs `cutc` in a folder.
fn sew(arguments: &str, folder: &Path) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_cutc"));
    let ran = command.arg("sew").args(arguments.split(' ')).current_dir(folder).output().expect("the program starts");
    assert!(ran.status.success(), "{arguments}: {}", String::from_utf8_lossy(&ran.stderr));
}

/// What a package reads of a file: its stitches, tenths of a millimetre, and how many trims.
fn theirs(package: &str, name: &str, folder: &Path) -> (Vec<[i64; 2]>, usize) {
    std::fs::write(folder.join("names.json"), format!("[\"{name}\"]")).expect("writable");
    let ran = python(&READ.replace("PACKAGE", package), folder);
    assert!(ran.status.success(), "{}", String::from_utf8_lossy(&ran.stderr));
    let said = String::from_utf8(ran.stdout).expect("text");
    let places = said.lines().skip(1).filter(|line| *line != "trim").map(|line| {
        let (x, y) = line.split_once(' ').expect("two numbers");
        [x, y].map(|number| number.parse().expect("a number"))
    });
    (places.collect(), said.lines().filter(|line| *line == "trim").count())
}

/// The stitches of a queue, mm, and how many trims.
fn ours(name: &str, folder: &Path) -> (Vec<[f64; 2]>, usize) {
    let text = std::fs::read_to_string(folder.join(name)).expect("a queue");
    let mut at = [0.0, 0.0];
    let mut stitches = Vec::new();
    for row in text.lines().skip(1) {
        let fields: Vec<&str> = row.split(',').collect();
        let way = [fields[1], fields[2]].map(|field| field.parse().unwrap_or(0.0));
        at = [at[0] + way[0], at[1] + way[1]];
        if fields[0] == "STITCH" {
            stitches.push(at);
        }
    }
    (stitches, text.lines().filter(|row| row.starts_with("TRIM")).count())
}

/// Whether both are the same stitches, as far as a tenth of a millimetre tells.
fn expect_same(theirs: &[[i64; 2]], ours: &[[f64; 2]], accuracy: f64, what: &str) {
    assert_eq!(theirs.len(), ours.len(), "{what}");
    for (a, b) in theirs.iter().zip(ours) {
        let off = [0, 1].map(|k| (a[k] as f64 / 10.0 - b[k]).abs());
        assert!(off[0].max(off[1]) <= accuracy, "{what}: {a:?} {b:?}");
    }
}

#[test]
fn packages_that_read_stitch_files_agree_on_every_stitch() {
    for package in PACKAGES {
        if !is_there(package, Command::new("python3").args(["-c", &format!("import {package}")])) {
            continue;
        }
        let folder = tempfile::tempdir().expect("a directory");
        let folder = folder.path();
        let fixture = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/sew/pocket.csv");
        std::fs::copy(fixture, folder.join("pocket.csv")).expect("a copy");
        sew("pocket.csv -t dst,exp,pes,jef,queue", folder);
        let (ours, trims) = ours("pocket.queue.csv", folder);
        for name in ["pocket.dst", "pocket.exp", "pocket.pes", "pocket.jef"] {
            let (mut theirs, their_trims) = theirs(package, name, folder);
            if (package, name) == ("pyembroidery", "pocket.pes") {
                // It takes the place of the start for a jump, which shifts all that follows.
                let by = [0, 1].map(|axis| theirs[0][axis] - (10.0 * ours[0][axis]).round() as i64);
                for place in &mut theirs {
                    *place = [place[0] - by[0], place[1] - by[1]];
                }
            }
            // Half a unit of the file, and half a step of the queue.
            expect_same(&theirs, &ours, 0.05 + 0.025 + 1e-6, &format!("{package} {name}"));
            // It knows no trims of JEF but long ways, and none at the end.
            if (package, name) != ("pyembroidery", "pocket.jef") {
                assert_eq!(their_trims, trims, "{package} {name}");
            }
        }
    }
}

#[test]
fn what_other_packages_write_is_read_stitch_by_stitch() {
    for package in PACKAGES {
        if !is_there(package, Command::new("python3").args(["-c", &format!("import {package}")])) {
            continue;
        }
        let folder = tempfile::tempdir().expect("a directory");
        let folder = folder.path();
        let write = WRITE.replace("PACKAGE", package).replace("EXTENSIONS", &format!("{FORMATS:?}"));
        let ran = python(&write, folder);
        assert!(ran.status.success(), "{}", String::from_utf8_lossy(&ran.stderr));
        for format in FORMATS {
            let name = format!("theirs.{format}");
            let (theirs, _) = theirs(package, &name, folder);
            assert!(theirs.len() >= 480, "{package} {name}: {}", theirs.len());
            // Stitches of any length are kept: what is compared is how the file is read.
            let keys = "--set sewing.min_pitch_mm=0 --set sewing.max_pitch_mm=100";
            sew(&format!("{name} -t queue --force {keys}"), folder);
            let (ours, _) = ours("theirs.queue.csv", folder);
            expect_same(&theirs, &ours, 0.025 + 1e-6, &format!("{package} {name}"));
        }
    }
}
