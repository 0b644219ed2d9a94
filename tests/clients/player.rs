//! Pages are opened in headless Chromium, which is led by a script; their scripts are checked by the compiler of
//! TypeScript.

use std::fmt::Write as _;
use std::path::Path;
use std::process::Command;

use crate::{compile, is_there};

/// The names under which Chromium is installed.
const BROWSERS: [&str; 3] = ["chromium", "chromium-browser", "google-chrome"];

/// A piece with notches of several kinds, and a V notch over a gap that is narrower than the surplus of the blade.
const GAP: &str = "H1*G71*N1*X0Y0*M14*X290Y0*X300Y50*X310Y0*X600Y0*X600Y400*X400Y400*X390Y350*X380Y400*X0Y400*X0Y0*M15*\
                   N2*X0Y-200*M14*X600Y-200*X600Y-5*X0Y-5*X0Y-200*M15*\
                   N3*X1000Y0*M14*Y60*M15*X1200Y0*M14*Y60*M15*X1300Y0*M14*Y60*M15*X900Y0*M14*X1800Y0*Y400*X900*Y0*M15*M0*";

/// A triangle that is longer than a table of a metre.
const WIDE: &str = "H1*G71*N1*X0Y0*M14*X90000Y0*X90000Y400*X0Y0*M15*M0*";

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Chromium, if it is there.
fn browser() -> Option<&'static str> {
    let runs = |name: &&&str| Command::new(name).arg("--version").output().is_ok_and(|output| output.status.success());
    let found = BROWSERS.iter().find(runs).copied();
    is_there("chromium", Command::new(found.unwrap_or(BROWSERS[0])).arg("--version")).then_some(found)?
}

/// A marker of 200 squares, each with ten slits that are shorter than the blade.
fn many_findings() -> String {
    let mut file = "H1*G71*".to_owned();
    for piece in 0..200 {
        let [x, y] = [piece % 20, piece / 20].map(|place| place * 1500);
        let [right, high] = [x + 1400, y + 1400];
        write!(file, "N{}*X{x}Y{y}*M14*X{right}*Y{high}*X{x}*Y{y}*M15*", piece + 1).expect("in memory");
        for slit in 0..10 {
            let [along, up] = [x + 150 + 110 * slit, y + 700];
            write!(file, "X{along}Y{up}*M14*Y{}*M15*", up + 40).expect("in memory");
        }
    }
    file + "M0*"
}

#[test]
fn chromium_plays_a_page_as_its_setpoints_are() {
    let Some(browser) = browser() else { return };
    let folder = tempfile::tempdir().expect("a directory");
    compile("markers/metric-four-pieces.cut", "csv,html", folder.path());
    let many = folder.path().join("many.cut");
    std::fs::write(&many, many_findings()).expect("writable");
    compile(many.to_str().expect("a plain name"), "html", folder.path());
    let gap = folder.path().join("gap.cut");
    std::fs::write(&gap, GAP).expect("writable");
    compile(gap.to_str().expect("a plain name"), "html", folder.path());
    let bites = root().join("fixtures/pictures/marker.cut");
    let mut windows = Command::new(env!("CARGO_BIN_EXE_cutc"));
    windows.arg("compile").arg(bites).args(["-t", "html", "--set", "bite.length_mm=800", "-o", "bites.html"]);
    assert!(windows.current_dir(folder.path()).status().expect("the program starts").success());
    // Refused, so that it has a cloth and no motion.
    std::fs::write(folder.path().join("wide.cut"), WIDE).expect("writable");
    let mut refused = Command::new(env!("CARGO_BIN_EXE_cutc"));
    refused.args(["compile", "wide.cut", "-t", "html", "--set", "table.x_mm=[0,1000]"]).current_dir(folder.path());
    assert!(!refused.output().expect("the program starts").status.success());
    let script = root().join("tests/clients/player.py");
    let mut lead = Command::new("python3");
    let pages =
        ["metric-four-pieces.html", "metric-four-pieces.csv", "many.html", "gap.html", "bites.html", "wide.html"];
    lead.arg(script).arg(browser).args(pages).current_dir(folder.path());
    let led = lead.output().expect("python3 starts");
    assert!(led.status.success(), "{}{}", String::from_utf8_lossy(&led.stdout), String::from_utf8_lossy(&led.stderr));
}

#[test]
fn chromium_plays_what_heads_and_needles_do() {
    let Some(browser) = browser() else { return };
    let folder = tempfile::tempdir().expect("a directory");
    let fixture = |name: &str| root().join("fixtures").join(name).display().to_string();
    let machine = fixture("machines/flow.toml");
    let [discs, pocket] = ["flow/two-discs.csv", "sew/pocket.csv"].map(fixture);
    let flow = ["flow", &discs, "-p", &machine, "--speed", "100", "-o", ".", "-t", "html"];
    for arguments in [&flow[..], &["sew", &pocket, "-t", "html"]] {
        let ours = Command::new(env!("CARGO_BIN_EXE_cutc")).args(arguments).current_dir(folder.path()).output();
        let ours = ours.expect("the program starts");
        assert!(ours.status.success(), "{}", String::from_utf8_lossy(&ours.stderr));
    }
    let mut lead = Command::new("python3");
    lead.arg(root().join("tests/clients/stages.py")).args([browser, "player.html", "pocket.html"]);
    let led = lead.current_dir(folder.path()).output().expect("python3 starts");
    assert!(led.status.success(), "{}{}", String::from_utf8_lossy(&led.stdout), String::from_utf8_lossy(&led.stderr));
}

#[test]
fn the_types_of_the_player_are_sound() {
    let mut probe = Command::new("tsc");
    if !is_there("tsc", probe.arg("--version")) {
        return;
    }
    let checked = Command::new("tsc").arg("-p").arg(root().join("src/picture/player")).output().expect("tsc starts");
    assert!(checked.status.success(), "{}", String::from_utf8_lossy(&checked.stdout));
}

#[test]
fn a_linter_finds_nothing_in_the_player() {
    if !is_there("oxlint", Command::new("oxlint").arg("--version")) {
        return;
    }
    let player = root().join("src/picture/player");
    let lint = |file: &Path| {
        let config = player.join(".oxlintrc.json");
        Command::new("oxlint").arg("-c").arg(config).arg(file).output().expect("oxlint starts")
    };
    let clean = lint(&player);
    assert!(clean.status.success(), "{}", String::from_utf8_lossy(&clean.stdout));
    // A wrong script is refused.
    let folder = tempfile::tempdir().expect("a directory");
    let wrong = folder.path().join("wrong.js");
    std::fs::write(&wrong, "for (let i = 0; i < 9; i--) if (i = 3) console.log(i);\n").expect("writable");
    assert!(!lint(&wrong).status.success());
}
