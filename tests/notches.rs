//! V notches and doubtful drawings, from the bytes of a file to what is said about them.

use cutc::diagnostic::Diagnostics;
use cutc::ir::Marker;
use cutc::machine::Job;
use cutc::pipeline::{self, Report};
use cutc::source::Source;

fn read(text: &str) -> (Marker, Vec<&'static str>) {
    let source = Source::new("a.cut", text.as_bytes().to_vec()).expect("small");
    let mut found = Diagnostics::default();
    let input = pipeline::read(&source, None, &Job::default(), &mut found).expect("a cut file");
    (input.marker, found.iter().map(|diagnostic| diagnostic.code.name).collect())
}

const NOTCHED: &str = "H1*G71*M15*N1*X0Y0*M14*X490Y0*X500Y50*X510Y0*X1000Y0*X1000Y800*X0Y800*X0Y0*M15*M0*";

#[test]
fn a_v_notch_is_listed_with_its_measures_and_stays_on_the_outline() {
    let (marker, found) = read(NOTCHED);
    let piece = &marker.pieces[0];
    let vee = piece.vees[0];
    assert_eq!((piece.vees.len(), piece.notches.len(), marker.points(&piece.contours[0]).len()), (1, 0, 8));
    assert!((vee.depth() - 5.0).abs() < 1e-9 && (vee.width() - 2.0).abs() < 1e-9);
    assert!((vee.direction().y - 1.0).abs() < 1e-9 && (vee.apex.x - 50.0).abs() < 1e-9);
    assert_eq!(found, [""; 0]);
    let report = Report::of(&marker, "iso");
    assert_eq!((report.notches.slit, report.notches.v), (0, 1));
}

#[test]
fn a_doubtful_drawing_is_named() {
    let check = |text: &str, expected: &[&str]| assert_eq!(read(text).1, expected, "{text}");
    check("H1*G71*M15*N1*X0Y0*M14*X1000Y800*X1000Y0*X0Y800*X0Y0*M15*M0*", &["marker/self-crossing"]);
    let square = |n: u32, x: u32| {
        let far = x + 1000;
        format!("N{n}*M15*X{x}Y{x}*M14*X{far}Y{x}*X{far}Y{far}*X{x}Y{far}*X{x}Y{x}*M15*")
    };
    let file = |body: &[String]| format!("H1*G71*{}M0*", body.concat());
    check(&file(&[square(1, 0), square(2, 500)]), &["marker/overlapping-pieces"]);
    check(&file(&[square(1, 0), square(2, 1000)]), &[]);
    check(&file(&[square(1, 0), "X2000Y500M43*".into()]), &["marker/drill-outside"]);
    check(&file(&[square(1, 0), square(2, 2000), square(1, 4000)]), &["marker/piece-number-twice"]);
}
