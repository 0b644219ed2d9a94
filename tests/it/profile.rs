//! Machine profiles in files: the ones that come with the project, and faulty ones with what is said about them.

use std::path::Path;

use cutc::diagnostic::{Detail, render, render_with};
use cutc::machine::{Fit, MachineProfile, load};
use cutc::source::Source;

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
