//! Machine profiles in files: the ones that come with the project, and faulty ones with what is said about them.

use std::path::Path;

use cutc::diagnostic::{Detail, render, render_with};
use cutc::machine::{Fit, MachineProfile, load};
use cutc::source::Source;

use crate::support::room::{DONE, Room, USAGE};
use crate::support::samples::samples;

fn source(path: &Path) -> Source {
    let name = path.file_name().expect("a file").to_string_lossy().into_owned();
    Source::new(name, std::fs::read(path).expect("readable")).expect("small")
}

fn machine(name: &str) -> MachineProfile {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/machines").join(name);
    let source = source(&path);
    load(Some(&source), &[]).map_err(|faults| render(&faults.file, &source)).expect("a legal profile")
}

#[test]
fn every_fault_of_a_profile_is_shown_at_its_place() {
    insta::glob!("../../fixtures/invalid/profile", "*.toml", |path| {
        let source = source(path);
        let faults = load(Some(&source), &[]).expect_err("a faulty profile");
        assert_eq!(faults.arguments.iter().count(), 0);
        insta::assert_snapshot!(render_with(&faults.file, &source, Detail::All));
    });
}

#[test]
fn every_machine_of_the_fixtures_is_legal() {
    insta::glob!("../../fixtures/machines", "*.toml", |path| {
        machine(&path.file_name().expect("a file").to_string_lossy());
    });
}

#[test]
fn the_score_profile_is_a_point_on_the_drawn_line() {
    let profile = machine("score.toml");
    assert_eq!((profile.knife.radius(), profile.knife.back(), profile.knife.feed_mm_s), (0.0, 0.0, None));
    assert_eq!((profile.tolerance(0.1), profile.path.fit), (0.05, Fit::Polygon));
    assert_eq!(profile.axes, MachineProfile::default().axes);
}

#[test]
fn the_eccentric_profile_has_its_axis_near_the_heel() {
    let knife = machine("eccentric.toml").knife;
    assert!((knife.back() - 2.2).abs() < 1e-12 && (knife.radius() - 4.4).abs() < 1e-12);
}

#[test]
fn a_value_loads_as_the_table_of_keys_says() {
    let mut counts = [0, 0];
    for sample in samples() {
        let (name, is_legal) = (&sample.name, sample.key.takes.allows(&sample.value));
        let said: Vec<String> = match load(None, &[format!("{name}={}", sample.value)]) {
            Ok(_) => Vec::new(),
            Err(faults) => faults.arguments.iter().map(|fault| fault.message.clone()).collect(),
        };
        // A value that is legal by itself may break a rule with others, which says otherwise.
        let start = if is_legal { format!("`{name}` must be ") } else { format!("`{name}` ") };
        let is_refused = said.iter().any(|message| message.contains(&format!(": {start}")));
        assert_eq!(is_refused, !is_legal, "{name} = {}: {said:?}", sample.value);
        counts[usize::from(is_legal)] += 1;
    }
    assert!(counts.iter().all(|&count| count > 300), "{counts:?}");
}

/// Answers for a FluidNC machine, some of them at the second attempt.
const ANSWERS: &str = "fluid\nfluidnc\n0 1800, 0 1200\n-3\n3\n1.5\n12 m/min\n250, 250\n250, 250, 720\n2000, 2000, 9000\n\
                       -360 360\nclockwise\n90\n\n60, 50\n";

#[test]
fn questions_end_with_a_profile_and_a_trial() {
    let room = Room::new();
    let said = room.expect_of(ANSWERS.as_bytes(), "profile init --ask -o own.toml", DONE).1;
    for told in [
        "1/12  Which controller",
        "no profile has the name `fluid`",
        "must be a number from 0 to 1000 mm",
        "give 3 values with commas between them",
        "12/12  How long",
        "cutc compile own-trial.cut -p ./own.toml -o own-trial.ngc --set sheet.origin=corner",
        "wrote `own-trial.ngc`",
        "`cutc manual trial` says",
    ] {
        assert!(said.contains(told), "no `{told}`: {said}");
    }
    let file = Source::new("own.toml", room.read("own.toml")).expect("small");
    let own = load(Some(&file), &[]).map_err(|faults| render(&faults.file, &file)).expect("a legal profile");
    assert_eq!((own.knife.width_mm, own.knife.back(), own.knife.feed_mm_s), (3.0, 1.5, Some(200.0)));
    assert_eq!((own.table.x_mm, own.table.y_mm), (Some([0.0, 1800.0]), Some([0.0, 1200.0])));
    assert!(own.c.reverse && own.knife.plunge_ms == 60.0 && own.knife.lift_ms == 50.0);
    // Values that were not asked for are those of the controller.
    assert_eq!((own.value("gcode.letter"), own.gcode.decimals), (Some("A".into()), 5));
    room.expect("verify own-trial.ngc --source own-trial.cut -p own.toml --set sheet.origin=corner", DONE);
}

#[test]
fn answers_that_end_early_write_nothing_and_no_profile_is_overwritten() {
    let room = Room::new();
    let before = room.names();
    let said = room.expect_of(b"grblhal\n\n3\n", "profile init --ask", USAGE).1;
    assert!(said.contains("the answers end before the questions do"), "{said}");
    assert_eq!(room.names(), before);
    room.write("machine.toml", b"version = 1\n");
    let said = room.expect_of(ANSWERS.as_bytes(), "profile init --ask", USAGE).1;
    assert!(said.contains("`machine.toml` is there already") && !said.contains("1/12"), "{said}");
    assert!(room.expect_of(b"", "profile init --ask --for fluidnc", USAGE).1.contains("cannot be used with"));
}

#[test]
fn the_schema_of_profiles_reads_well() {
    insta::assert_snapshot!(Room::new().expect("profile schema", DONE).0);
}
