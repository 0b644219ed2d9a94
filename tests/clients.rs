//! Programs of others open what is written here. One that is not installed is named on standard error and left out;
//! with `CUTC_REQUIRE_CLIENTS=1` that is a failure.

use std::path::Path;
use std::process::{Command, Output};

/// Whether the client is there; says so when not.
fn is_there(name: &str, probe: &mut Command) -> bool {
    if probe.output().is_ok_and(|output| output.status.success()) {
        return true;
    }
    let required = std::env::var("CUTC_REQUIRE_CLIENTS").is_ok_and(|value| value == "1");
    assert!(!required, "{name} is not installed, and CUTC_REQUIRE_CLIENTS=1 asks for it");
    // Written to the handle: what a test prints otherwise is not shown when it passes.
    let line = format!("skipped: {name} is not installed\n");
    std::io::Write::write_all(&mut std::io::stderr(), line.as_bytes()).expect("standard error is open");
    false
}

fn python(script: &str, directory: &Path) -> Output {
    Command::new("python3").args(["-c", script]).current_dir(directory).output().expect("python3 starts")
}

#[test]
fn numpy_maps_an_array_and_finds_the_numbers_of_the_table() {
    if !is_there("numpy", Command::new("python3").args(["-c", "import numpy"])) {
        return;
    }
    let folder = tempfile::tempdir().expect("a directory");
    let input = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/iso/seed-circle.cut");
    let mut compile = Command::new(env!("CARGO_BIN_EXE_cutc"));
    let compiled = compile.args(["compile", "-t", "csv,npy"]).arg(input).current_dir(folder.path()).output();
    assert!(compiled.expect("the program starts").status.success());
    let script = r#"
import numpy
array = numpy.load("seed-circle.npy", mmap_mode="r")
assert isinstance(array, numpy.memmap) and array.ndim == 1 and array.itemsize == 39
assert array.dtype.names == ("t_s", "x_mm", "y_mm", "c_deg", "knife", "drill", "event", "block")
assert [array.dtype[i].str for i in range(8)] == ["<f8"] * 4 + ["|u1"] * 3 + ["<u4"]
table = numpy.genfromtxt("seed-circle.csv", delimiter=",", names=True)
assert len(table) == len(array) > 0 and table.dtype.names == array.dtype.names
for name in array.dtype.names:
    assert numpy.abs(table[name] - array[name]).max() <= 0.500001e-6, name
numpy.save("again.npy", array)
"#;
    let ran = python(script, folder.path());
    assert!(ran.status.success(), "{}", String::from_utf8_lossy(&ran.stderr));
    // What numpy writes from it is a program, too.
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/iso/seed-circle.cut");
    let mut verify = Command::new(env!("CARGO_BIN_EXE_cutc"));
    let judged = verify.args(["verify", "again.npy", "--source"]).arg(source).current_dir(folder.path()).output();
    let judged = judged.expect("the program starts");
    assert!(judged.status.success(), "{}", String::from_utf8_lossy(&judged.stdout));
}
