//! Notches and doubtful drawings, from the bytes of a file to what is said about them.

use cutc::diagnostic::Diagnostics;
use cutc::ir::Marker;
use cutc::ir::marker::{Notch, NotchKind};
use cutc::machine::{Job, TNotch};
use cutc::pass::toolpath::trace;
use cutc::pipeline::{self, Report};
use cutc::source::Source;

use crate::support::room::{DONE, FAULTY, Room};

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
    let vee = piece.outline_notches[0];
    assert_eq!((piece.outline_notches.len(), piece.notches.len(), marker.points(&piece.contours[0]).len()), (1, 0, 8));
    assert!((vee.depth() - 5.0).abs() < 1e-9 && (vee.width() - 2.0).abs() < 1e-9);
    assert!((vee.inwards().y - 1.0).abs() < 1e-9 && (vee.tip.x - 50.0).abs() < 1e-9);
    assert_eq!(found, [""; 0]);
    let report = Report::of(&marker, "iso");
    assert_eq!((report.notches.slit, report.notches.v), (0, 1));
}

#[test]
fn v_notches_that_lean_are_counted_in_every_dialect_and_cut_in_every_style() {
    let cases = [
        ("v-notches-that-lean.cut", include_str!("../../fixtures/iso/v-notches-that-lean.cut"), [1, 1]),
        ("v-notches-that-lean.plt", include_str!("../../fixtures/hpgl/v-notches-that-lean.plt"), [1, 1]),
        ("v-notches-at-an-angle.dxf", include_str!("../../fixtures/pattern/v-notches-at-an-angle.dxf"), [3, 0]),
    ];
    for (name, text, expected) in cases {
        let source = Source::new(name, text.as_bytes().to_vec()).expect("small");
        let mut found = Diagnostics::default();
        let input = pipeline::read(&source, None, &Job::default(), &mut found).expect("readable");
        let counts = Report::of(&input.marker, input.dialect.name).notches;
        assert_eq!([counts.v, counts.v_out], expected, "{name}");
        let room = Room::with(name, text);
        for (style, said) in [("as-drawn", ""), ("slit", "all cut as slits"), ("skip", "none is cut")] {
            let told = room.says(&format!("compile {name} -o {style}.csv --set notch.style={style}"), DONE);
            assert!(told.contains("verified") && told.contains(said), "{name} {style}: {told}");
        }
    }
}

#[test]
fn a_t_notch_is_cut_as_its_stem_alone_where_the_profile_says_so() {
    let file = "H1*G71*N1*M15*X1000Y400*M14*X950Y400*M15*X950Y380*M14*X950Y420*M15*\
        X0Y0*M14*X1000Y0*X1000Y800*X0Y800*X0Y0*M15*M0*";
    let source = Source::new("t.cut", file.as_bytes().to_vec()).expect("small");
    let cuts = |style: TNotch| {
        let (mut job, mut found) = (Job::default(), Diagnostics::default());
        job.profile.notch.t = style;
        let mut input = pipeline::read(&source, None, &job, &mut found).expect("a cut file");
        pipeline::make_cuts(&mut input, &source, &job, &mut found);
        assert_eq!(Report::of(&input.marker, "iso").notches.t, 1, "the file draws a T either way");
        trace(&input.marker, &job).count()
    };
    assert_eq!([TNotch::AsDrawn, TNotch::Slit].map(cuts), [3, 2]);
    let room = Room::with("t.cut", file);
    for style in ["as-drawn", "slit"] {
        let said = room.says(&format!("compile t.cut -o {style}.csv --set notch.t={style}"), DONE);
        assert!(said.contains("verified"), "{said}");
    }
    // A crossbar that is not asked for is damage, and so is one that is missing.
    room.says("verify as-drawn.csv --source t.cut --set notch.t=slit", FAULTY);
    room.says("verify slit.csv --source t.cut", FAULTY);
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
    check(&file(&[square(1, 0), square(2, 980)]), &["marker/overlapping-pieces"]);
    check(&file(&[square(1, 0), square(2, 500)]), &["marker/deep-overlap"]);
    check(&file(&[square(1, 0), square(2, 1000)]), &[]);
    check(&file(&[square(1, 0), "X2000Y500M43*".into()]), &["marker/drill-outside"]);
    check(&file(&[square(1, 0), square(2, 2000), square(1, 4000)]), &["marker/piece-number-twice"]);
}

#[test]
fn two_notches_that_share_a_side_are_cut_whole_and_lead_nowhere() {
    let file = |notches: &str| format!("H1*G71*M15*N1*X0Y0*M14*X400Y0*{notches}X1000Y0*X1000Y800*X0Y800*X0Y0*M15*M0*");
    let (marker, found) = read(&file("X400Y50*X450Y50*X450Y0*X450Y50*X500Y50*X500Y0*"));
    assert_eq!(found, [""; 0]);
    let piece = &marker.pieces[0];
    assert_eq!((piece.outline_notches.len(), piece.notches.len()), (1, 1));
    assert!((piece.notches[0].root - piece.notches[0].tip).norm() > 4.99);
    // One that goes on past the mouth leads out.
    let (_, found) = read(&file("X400Y50*X450Y50*X450Y-30*X450Y50*X500Y50*X500Y0*"));
    assert_eq!(found, ["marker/slit-outwards"]);
}

/// The slits of a piece of 100 by 80 mm that a file writes in some form: depths in mm, and lengths of crossbars. Nothing
/// but the outline may be left of its contours.
fn slits(body: &str) -> Vec<(f64, Option<f64>)> {
    let (marker, found) = read(&format!("H1*G71*M15*{body}M0*"));
    assert_eq!(found, [""; 0], "{body}");
    assert_eq!(marker.pieces.len(), 1, "{body}");
    let piece = &marker.pieces[0];
    assert!(piece.contours.len() == 1 && piece.contours[0].closed, "{body}");
    let bar = |notch: &Notch| match notch.kind {
        NotchKind::Slit => None,
        NotchKind::T(bar) => Some(bar.length()),
    };
    piece.notches.iter().map(|notch| (notch.depth(), bar(notch))).collect()
}

#[test]
fn a_slit_is_a_notch_in_every_form_that_files_have() {
    let slit = [(5.0, None)];
    let t = [(5.0, Some(4.0))];
    for piece in ["N4*M15*", ""] {
        let check = |before: &str, within: &str, expected: &[(f64, Option<f64>)]| {
            let outline = format!("X0Y0*M14*X1000Y0*X1000Y400*{within}X1000Y800*X0Y800*X0Y0*M15*");
            assert_eq!(slits(&format!("{piece}{before}{outline}")), expected, "{before} {within}");
        };
        let root = "X1000Y400*M14*";
        let bar = "X950Y380*M14*X950Y420*M15*";
        // Within the contour, before it, and before it without its code: at a vertex, and inside a segment.
        check("", &format!("M19*X950Y400*M15*{root}"), &slit);
        check(&format!("{root}M19*X950Y400*M15*"), "", &slit);
        check(&format!("{root}X950Y400*M15*"), "", &slit);
        check("X1000Y633*M14*X950Y633*M15*", "", &slit);
        // The same with a crossbar.
        check("", &format!("M19*X950Y400*M15*{bar}{root}"), &t);
        check(&format!("{root}M19*X950Y400*M15*{bar}"), "", &t);
        check(&format!("{root}X950Y400*M15*{bar}"), "", &t);
        // Damaged: M19 is lost, with a lift at the root and without one; the knife goes back in the cloth.
        check("", &format!("X950Y400*M15*{root}"), &slit);
        check("", &format!("M15*M14*X950Y400*M15*{root}"), &slit);
        check("", &format!("X950Y400*M15*{bar}{root}"), &t);
        check(&format!("{root}X950Y400*X1000Y400*M15*"), "", &slit);
    }
}

#[test]
fn a_slit_that_stands_twice_is_cut_once() {
    let outline = "X0Y0*M14*X1000Y0*X1000Y800*X0Y800*X0Y0*M15*";
    let check = |strokes: &str, expected: &[&str]| {
        let (marker, found) = read(&format!("H1*G71*M15*N1*{strokes}{outline}M0*"));
        assert_eq!(found, expected, "{strokes}");
        assert_eq!((marker.pieces[0].notches.len(), marker.pieces[0].contours.len()), (1, 1), "{strokes}");
    };
    let slit = "X1000Y400*M14*X950Y400*M15*";
    let bar = "X950Y380*M14*X950Y420*M15*";
    check(&format!("{slit}{slit}"), &["marker/slit-twice"]);
    check(&format!("{slit}X1000Y400*M14*M19*X950Y400*M15*"), &["marker/slit-twice"]);
    check(&format!("{slit}{bar}{bar}"), &["marker/slit-twice"]);
}

#[test]
fn lines_that_are_no_slits_stay_open_contours() {
    let outline = "X0Y0*M14*X1000Y0*X1000Y800*X0Y800*X0Y0*M15*";
    let check = |line: &str, codes: &[&str]| {
        let (marker, found) = read(&format!("H1*G71*M15*N1*{line}M15*{outline}M0*"));
        assert_eq!(found, codes, "{line}");
        assert_eq!((marker.pieces[0].notches.len(), marker.pieces[0].contours.len()), (0, 2), "{line}");
    };
    check("X1000Y400*M14*X849Y400*", &[]); // a dart
    check("X300Y400*M14*X600Y400*", &[]); // a straight cut inside, as for a pocket
    check("X500Y400*M14*X550Y400*", &["marker/stray-stroke"]); // one as short as a notch
    check("X1000Y400*M14*X950Y400*X950Y450*", &["marker/open-contour"]); // an L
}
