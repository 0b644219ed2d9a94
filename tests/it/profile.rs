//! Machine profiles in files: the ones that come with the project, and faulty ones with what is said about them.

use std::path::Path;

use cutc::diagnostic::{Detail, render, render_with};
use cutc::machine::{Fit, MachineProfile, load};
use cutc::source::Source;

use crate::support::room::{DONE, Room};
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

#[test]
fn the_schema_of_profiles_reads_well() {
    insta::assert_snapshot!(Room::new().expect("profile schema", DONE).0);
}
