//! What the target `svg` promises: a well-formed picture to scale, in which everything that the knife does can be found.

use std::io::Cursor;

use cutc::back::{Context, Emit, Outcome, Parts, TARGETS};
use cutc::diagnostic::{Diagnostic, code};
use cutc::geom::{Heading, Point};
use cutc::ir::declaration::{Kind, Total};
use cutc::ir::list::{Joint, Segment};
use cutc::ir::marker::{Contour, Drill, Label, Marker, Notch, NotchForm, NotchKind, OutlineNotch, Piece};
use cutc::ir::verdict::{Rule, Sighting};
use cutc::ir::{Finding, Toolpath};
use cutc::machine::{CommonLines, Job, Lines};
use cutc::source::{Source, Span};

use crate::support::{self, with_cuts};
use crate::verifier::case;

/// The paper's square with a slit and a drill; beside it a circle, numbered 12.
fn demo() -> Marker {
    let square = [(0.0, 0.0), (100.0, 0.0), (100.0, 100.0), (0.0, 100.0), (0.0, 0.0)];
    let mut marker = support::marker(&square.map(|(x, y)| Point::new(x, y)));
    let span = |block| Span { block, ..Span::default() };
    marker.pieces[0].drills.push(Drill { at: Point::new(50.0, 30.0), tool: 1, span: span(5) });
    let (root, tip) = (Point::new(0.0, 50.0), Point::new(5.0, 50.0));
    marker.pieces[0].notches.push(Notch { kind: NotchKind::Slit, root, tip, percent: 100, span: span(6) });
    let at = |i: u32| {
        let angle = std::f64::consts::TAU * f64::from(i % 24) / 24.0;
        Point::new(140.0 + 20.0 * angle.cos(), 50.0 + 20.0 * angle.sin())
    };
    let chord = |i| Segment { from: at(i), to: at(i + 1), span: span(10 + i), joint: Joint::default(), percent: 100 };
    let range = marker.list.append((0..24).map(chord)).expect("24 chords");
    marker.pieces.push(Piece { number: 12, contours: vec![Contour { range, closed: true }], ..Piece::default() });
    marker
}

fn square_knife() -> Job {
    let mut job = Job::default();
    let knife = &mut job.profile.knife;
    (knife.width_mm, knife.back_mm) = (6.0, Some(2.0));
    (knife.front_overlap_mm, knife.corner_front_overlap_mm) = (1.0, 1.0);
    job
}

/// A doubt about the circle.
fn doubt() -> Diagnostic {
    Diagnostic::new(&code::DRAWING_CLOSED, "an outline stops before the start, piece 12").about(vec![12])
}

/// What the pictures say that the program declares.
const DECLARED: [Total; 2] = [
    Total { kind: Kind::Plunge, count: 4, pieces: 4, worst_mm: 0.48, piece: 12, copy: 0, at_mm: [160.0, 50.0] },
    Total { kind: Kind::Lift, count: 1, pieces: 1, worst_mm: 0.0, piece: 1, copy: 0, at_mm: [0.0, 50.0] },
];

fn parts() -> &'static Parts<Toolpath> {
    let target = TARGETS.iter().find(|target| target.name == "svg").expect("a target named svg");
    match &target.emit {
        Emit::Picture(parts) => parts,
        Emit::Marker(_) | Emit::Toolpath(_) | Emit::Arcs(_) | Emit::Motion(_) | Emit::Page(_) => panic!("no picture"),
    }
}

fn picture(marker: &Marker, job: &Job, found: &[Finding]) -> String {
    // Room for the texts that labels of these markers may point to.
    let source = Source::new("texts", b"A < B & \"C\"\r".to_vec()).expect("small");
    let context = Context { source: &source, job, marker };
    let mut out = Cursor::new(Vec::new());
    (parts().head)(&context, &mut out).expect("a buffer takes all");
    for toolpath in support::toolpaths(marker, job) {
        (parts().body)(&toolpath, &context, &mut out).expect("a buffer takes all");
    }
    (parts().tail)(
        &context,
        Outcome { findings: found, refusals: &[], declared: &DECLARED, doubts: &[&doubt()], ..Outcome::default() },
        &mut out,
    )
    .expect("a buffer takes all");
    String::from_utf8(out.into_inner()).expect("UTF-8")
}

/// The names of all elements, when the text is well-formed as far as this target can go wrong: tags balance, attributes
/// are quoted, named once, and free of `<`; nothing but the five entities is referred to.
fn elements(text: &str) -> Vec<String> {
    let mut rest = text.strip_prefix("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n").expect("an XML declaration");
    let (mut open, mut names): (Vec<String>, Vec<String>) = (Vec::new(), Vec::new());
    while let Some(at) = rest.find('<') {
        check_text(&rest[..at]);
        assert!(!open.is_empty() || names.is_empty() || rest[..at].trim().is_empty(), "text behind the root");
        let end = rest.find('>').expect("a tag ends");
        let tag = &rest[at + 1..end];
        rest = &rest[end + 1..];
        if let Some(name) = tag.strip_prefix('/') {
            assert_eq!(open.pop().as_deref(), Some(name));
            continue;
        }
        assert!(!open.is_empty() || names.is_empty(), "one root");
        let inner = tag.strip_suffix('/').unwrap_or(tag);
        let (name, attributes) = inner.split_once(' ').unwrap_or((inner, ""));
        check_attributes(attributes);
        names.push(name.to_owned());
        if !tag.ends_with('/') {
            open.push(name.to_owned());
        }
    }
    assert!(open.is_empty() && rest.trim().is_empty(), "{open:?} stay open");
    names
}

fn check_attributes(mut rest: &str) {
    let mut seen = Vec::new();
    while let Some((name, after)) = rest.split_once("=\"") {
        let (value, after) = after.split_once('"').expect("a quoted value");
        check_text(value);
        let name = name.trim();
        assert!(!seen.contains(&name) && name.chars().all(|c| c.is_ascii_alphanumeric() || "-:".contains(c)), "{name}");
        seen.push(name);
        rest = after;
    }
    assert!(rest.trim().is_empty(), "{rest}");
}

fn check_text(text: &str) {
    for reference in text.split('&').skip(1) {
        let name = reference.split(';').next().expect("a split has a first part");
        assert!(["amp", "lt", "gt", "quot", "apos"].contains(&name), "&{name}");
    }
    assert!(!text.contains('<') && !text.chars().any(|c| c.is_control() && c != '\n'));
}

/// The value of an attribute of the first element that has it.
fn attribute<'a>(text: &'a str, name: &str) -> &'a str {
    let (_, after) = text.split_once(&format!(" {name}=\"")).unwrap_or_else(|| panic!("no {name}"));
    after.split('"').next().expect("a split has a first part")
}

fn numbers(text: &str) -> Vec<f64> {
    text.split([' ', ',']).map(|word| word.parse().unwrap_or_else(|_| panic!("{word}"))).collect()
}

fn count(text: &str, class: &str) -> usize {
    text.matches(&format!("<path class=\"{class}\"")).count()
}

fn drawing(text: &str) -> &str {
    text.split("<g id=\"legend\"").next().expect("a split has a first part")
}

fn finding(name: &'static str, worst: f64, x: f64, y: f64) -> Finding {
    let rule = Box::leak(Box::new(Rule { name, unit: "mm", ..Rule::PLAIN }));
    let place = Some(Sighting::at(1.5, Point::new(x, y), 3));
    Finding { rule, worst, limit: Some(1.0), unit: "mm", place }
}

#[test]
fn a_picture_of_a_small_marker_reads_well() {
    insta::assert_snapshot!(picture(&demo(), &square_knife(), &[]));
}

#[test]
fn a_picture_is_well_formed_and_each_id_is_unique() {
    let found = [finding("verify/<odd> & \"rule\"", 2.0, 0.0, 0.0), finding("verify/on-path", 0.5, f64::NAN, 0.0)];
    for found in [&found[..], &[]] {
        let text = picture(&demo(), &square_knife(), found);
        assert!(elements(&text).len() > 50);
        let ids: Vec<&str> = text.split(" id=\"").skip(1).filter_map(|after| after.split('"').next()).collect();
        assert!(ids.iter().enumerate().all(|(i, id)| !ids[..i].contains(id)), "{ids:?}");
        let linked = text.split(" href=\"#").skip(1).filter_map(|after| after.split('"').next());
        assert!(linked.into_iter().all(|target| ids.contains(&target)));
    }
}

#[test]
fn a_picture_is_to_scale_and_holds_the_whole_marker() {
    let mut job = square_knife();
    job.profile.home = [-30.0, -10.0, 0.0];
    let text = picture(&demo(), &job, &[]);
    let view = numbers(attribute(&text, "viewBox"));
    assert_eq!(attribute(&text, "width"), format!("{:.3}mm", view[2]));
    assert_eq!(attribute(&text, "height"), format!("{:.3}mm", view[3]));
    // Y points up on the table and down on the sheet.
    assert!(view[0] < -30.0 && view[0] + view[2] > 160.0 && view[1] < -100.0 && view[1] + view[3] > 10.0, "{view:?}");
}

#[test]
fn every_run_plunge_cut_and_drill_is_drawn_where_it_is_cut() {
    let text = picture(&demo(), &square_knife(), &[]);
    let drawing = drawing(&text);
    assert_eq!((count(drawing, "run"), count(drawing, "stab"), count(drawing, "drill")), (5, 1, 1));
    assert!(drawing.contains("<path class=\"run\" d=\"M0.000,0.000 100.000,0.000\">"));
    // The front overlap of the first side is 1 mm, the heel overlap of the second 0.5 mm.
    let over = drawing.split("class=\"over\"").nth(2).expect("the overlaps of the square");
    assert!(over.contains("M100.000,0.072 101.000,0.072 101.000,-0.072 100.000,-0.072Z"), "{over}");
    assert!(over.contains("M99.928,-0.500 99.928,0.000 100.072,0.000 100.072,-0.500Z"), "{over}");
    // The blade at its end: tail, C axis, tip.
    assert!(drawing.contains("M95.000,0.000 97.000,0.120 101.000,0.000 97.000,-0.120Z"));
}

#[test]
fn the_worst_places_are_ringed_red_where_a_rule_fails_and_amber_where_it_holds() {
    let found = [finding("verify/on-path", 0.5, 10.0, 20.0), finding("verify/overcut-part", 1.5, 90.0, 80.0)];
    let plain = picture(&demo(), &square_knife(), &[]);
    let text = picture(&demo(), &square_knife(), &found);
    assert_eq!((count(&text, "fails"), count(&text, "holds")), (1, 1));
    assert_eq!((count(&plain, "fails"), count(&plain, "holds")), (0, 0));
    assert!(
        text.contains(
            "B  verify/overcut-part  1.500 mm, limit 1.000 mm: FAILS, at X 90.00 Y 80.00 mm, 1.500 s, block 3"
        )
    );
    assert!(text.contains("REFUSED, no program was written: 1 of 2 rules are broken"));
    let height = |text: &str| numbers(attribute(text, "viewBox"))[3];
    assert!(height(&text) > height(&plain) && elements(&text).len() > elements(&plain).len());
    assert_eq!(attribute(&text, "height"), format!("{:.3}mm", height(&text)));
}

#[test]
fn pieces_that_are_in_doubt_have_a_band_and_a_sign_that_the_legend_explains() {
    let text = picture(&demo(), &square_knife(), &[]);
    assert_eq!(count(&text, "doubt"), 1, "the circle alone");
    assert!(text.contains("<g><title>?1 an outline stops before the start, piece 12</title>"));
    assert_eq!(text.matches("<text class=\"doubt-sign\"").count(), 1);
    assert_eq!(text.matches("<text class=\"doubt-text\"").count(), 2, "a title and a row");
}

#[test]
fn common_edges_are_drawn_where_they_are_cut_once_and_the_legend_tells_how_long_they_are() {
    let marker = with_cuts(&case::marker("touching-parts", &Job::default()), &Job::default());
    let text = picture(&marker, &Job::default(), &[]);
    assert!(!marker.common.is_empty());
    assert_eq!(count(drawing(&text), "common"), marker.common.len());
    let legend = text.split("<g id=\"legend\"").nth(1).expect("there is a legend");
    assert!(legend.contains(&format!("common edges: {}, ", marker.common.len())), "{legend}");
    let mut whole = Job::default();
    whole.profile.common.lines = Lines::Word(CommonLines::Off);
    let marker = with_cuts(&case::marker("touching-parts", &whole), &whole);
    assert!(!picture(&marker, &whole, &[]).contains("common edge"));
}

#[test]
fn a_label_stands_at_its_place_in_its_direction_inside_its_piece() {
    let mut marker = demo();
    let text = Span { start: 0, end: 12, block: 7 };
    let label = |x: f64, y: f64, degrees: f64| Label {
        at: Some(Point::new(x, y)),
        heading: Some(Heading::new(degrees.to_radians())),
        span: text,
        mirrored: None,
    };
    // With room, with little room before the right side, another one at the same place, without a place.
    let texts = [label(20.0, 60.0, 30.0), label(90.0, 60.0, 0.0), label(90.0, 60.0, 0.0)];
    marker.pieces[0].labels.extend(texts);
    marker.pieces[0].labels.push(Label { at: None, ..label(0.0, 0.0, 0.0) });
    let picture = picture(&marker, &square_knife(), &[]);
    elements(&picture);
    let labels: Vec<&str> = picture.lines().filter(|line| line.starts_with("<text class=\"label\"")).collect();
    assert_eq!(labels.len(), 4, "{labels:?}");
    // The one without a place stands inside the piece, and off the others.
    assert!(!attribute(labels[3], "transform").starts_with("translate(0.000,0.000)"), "{labels:?}");
    assert!(labels.iter().all(|line| line.contains(">A &lt; B &amp; &quot;C&quot;␍<title>label, block 7</title>")));
    assert_eq!(attribute(labels[0], "transform"), "translate(20.000,60.000) rotate(30.000) scale(1,-1)");
    let [high, low, below] = [0, 1, 2].map(|i| numbers(attribute(labels[i], "font-size"))[0]);
    assert!(high > 3.0 && low < 1.6 && low == below, "{labels:?}");
    assert!(numbers(attribute(labels[2], "y"))[0] > low);
    // One without a place stands in the middle of its piece.
    assert!(attribute(labels[3], "transform").ends_with("rotate(0.000) scale(1,-1)"), "{labels:?}");
    assert!(picture.contains(", label: A &lt; B &amp; &quot;C&quot;␍</title>"), "{picture}");
}

#[test]
fn every_notch_is_marked_and_says_its_depth() {
    let mut marker = demo();
    let at = |x: f64, y: f64| Point::new(x, y);
    let span = Span { block: 4, ..Span::default() };
    let mouth = [at(49.0, 0.0), at(51.0, 0.0)];
    let notch = OutlineNotch { form: NotchForm::V, outwards: false, mouth, tip: at(50.0, 5.0), segments: 2, span };
    marker.pieces[0].outline_notches.push(notch);
    let text = picture(&marker, &square_knife(), &[]);
    let drawing = drawing(&text);
    assert_eq!(count(drawing, "notch"), 2);
    assert!(drawing.contains("d=\"M49.000,0.000 50.000,5.000 51.000,0.000\"><title>V notch, 5.0 mm deep, 2.0 mm wide"));
    assert!(drawing.contains("d=\"M0.000,50.000 5.000,50.000\"><title>slit, 5.0 mm deep, block 6"));
}

#[test]
fn the_same_marker_gives_the_same_bytes() {
    assert_eq!(picture(&demo(), &square_knife(), &[]), picture(&demo(), &square_knife(), &[]));
}

#[test]
fn a_marker_without_extent_has_a_picture_all_the_same() {
    let text = picture(&Marker::default(), &Job::default(), &[]);
    elements(&text);
    assert!(!text.contains("NaN") && !text.contains("inf"));
    let mut point = Job::default();
    point.profile.knife.width_mm = 0.0;
    point.profile.knife.radius_mm = Some(0.0);
    elements(&picture(&support::marker(&[Point::new(1.0, 1.0), Point::new(1.0, 1.001)]), &point, &[]));
}
