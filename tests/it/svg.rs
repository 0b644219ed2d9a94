//! SVG drawings: their true size, transforms, a second reading that agrees and sees damage, and patience with bytes that
//! are no drawing.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use cutc::diagnostic::{Diagnostics, render};
use cutc::front::by_name;
use cutc::geom::{Extent, Point, Vector};
use cutc::ir::drawing::Account;
use cutc::ir::{Finding, Marker};
use cutc::machine::Job;
use cutc::machine::plot::Lines;
use cutc::pipeline;
use cutc::source::Source;
use cutc::verify::{Census, source_audit};

use crate::support::fixtures::files;

/// Everything is cut.
fn job() -> Job {
    Job { lines: Lines { all: true, ..Lines::default() }, ..Job::default() }
}

fn source(bytes: impl Into<Vec<u8>>) -> Source {
    Source::new("a.svg", bytes.into()).expect("small")
}

/// A drawing as it is read, and what is said about it.
fn read(source: &Source) -> (Marker, Diagnostics) {
    let dialect = by_name("svg").expect("a dialect");
    let mut found = Diagnostics::default();
    (pipeline::marker_of(dialect, source, &job(), &mut found), found)
}

/// The marker of a sound drawing.
fn sound(text: &str) -> Marker {
    let source = source(text);
    let (marker, found) = read(&source);
    assert!(!found.has_errors(), "{text}: {}", render(&found, &source));
    marker
}

fn codes(bytes: impl Into<Vec<u8>>) -> Vec<&'static str> {
    read(&source(bytes)).1.iter().map(|finding| finding.code.name).collect()
}

/// A page of 400 mm with some elements.
fn page(inside: &str) -> String {
    format!(
        "<svg xmlns='http://www.w3.org/2000/svg' width='400mm' height='400mm' viewBox='0 0 400 400' fill='none' \
         stroke='#000'>{inside}</svg>"
    )
}

/// Rules of the source that a marker breaks.
fn broken(source: &Source, marker: &Marker) -> Vec<Finding> {
    let found =
        source_audit("svg", source.bytes(), &Census::of(marker), &job().profile).expect("drawings are read twice");
    found.into_iter().filter(|finding| !finding.holds()).collect()
}

fn extent(marker: &Marker) -> Extent {
    Census::of(marker).bounds
}

#[test]
fn a_square_of_100_mm_has_that_size_in_every_unit() {
    let inch = 100.0 / 25.4;
    let units = [
        ("mm", 100.0),
        ("cm", 10.0),
        ("in", inch),
        ("pt", 72.0 * inch),
        ("pc", 6.0 * inch),
        ("q", 400.0),
        ("Q", 400.0),
    ];
    let inner = [("px", 96.0 * inch), ("", 96.0 * inch)];
    let check = |text: &str, marker: &Marker| {
        let (width, height) = extent(marker).size();
        assert!((width - 100.0).abs() < 1e-9 && (height - 100.0).abs() < 1e-9, "{text}: {width} x {height}");
    };
    for (unit, side) in units.into_iter().chain(inner) {
        // By the unit of the page, and by that of the square.
        let text =
            format!("<svg width='{side}{unit}' height='{side}{unit}' viewBox='0 0 1 1'><path d='M0 0H1V1H0Z'/></svg>");
        check(&text, &sound(&text));
        let text = format!(
            "<svg width='8in' height='8in'><rect x='1{unit}' width='{side}{unit}' height='{side}{unit}'/></svg>"
        );
        check(&text, &sound(&text));
    }
    for (root, side) in [
        ("xmlns:inkscape='http://www.inkscape.org/namespaces/inkscape' inkscape:version='0.91 r13725'", 90.0 * inch),
        ("xmlns:i='http://ns.adobe.com/AdobeIllustrator/10.0/'", 72.0 * inch),
        ("width='100%' viewBox='0 0 500 500'", 96.0 * inch),
    ] {
        let text = format!("<svg {root}><path d='M9 9h{side}v{side}h-{side}z'/></svg>");
        check(&text, &sound(&text));
        assert!(codes(text).contains(&"svg/size-in-pixels"));
    }
    assert_eq!(codes(page("<rect x='9' y='9' width='100' height='100'/>")), [""; 0]);
}

#[test]
fn a_drawing_that_is_far_too_small_or_too_large_is_doubted() {
    assert!(codes(page("<rect x='9' y='9' width='15' height='15'/>")).contains(&"svg/size-doubtful"));
    let large = "<rect x='9' y='9' width='3100' height='3100'/>";
    assert!(codes(page(large)).contains(&"svg/size-doubtful"));
    assert!(!codes(page(&large.replace("height='3100'", "height='2000'"))).contains(&"svg/size-doubtful"));
}

/// Points worked out by hand: the triangle (0 0) (60 0) (0 40), with y downwards, where the page ends at 400.
#[test]
fn transforms_lead_where_they_lead_by_hand() {
    let triangle = "<path d='M0 0H60L0 40Z'/>";
    let check = |inside: &str, corners: [[f64; 2]; 3]| {
        let marker = sound(&page(inside));
        let points = marker.points(&marker.pieces[0].contours[0]);
        for [x, y] in corners {
            let corner = Point::new(x, 400.0 - y);
            assert!(points.iter().any(|point| (point - corner).norm() < 1e-9), "{inside}: {corner} in {points:?}");
        }
    };
    let with = |transform: &str| format!("<g transform='{transform}'>{triangle}</g>");
    check(triangle, [[0.0, 0.0], [60.0, 0.0], [0.0, 40.0]]);
    check(&with("translate(10,20)"), [[10.0, 20.0], [70.0, 20.0], [10.0, 60.0]]);
    check(&with("translate(100 100) scale(-2 1)"), [[100.0, 100.0], [-20.0, 100.0], [100.0, 140.0]]);
    check(&with("rotate(90 100 100)"), [[200.0, 0.0], [200.0, 60.0], [160.0, 0.0]]);
    check(&with("skewX(45)"), [[0.0, 0.0], [60.0, 0.0], [40.0, 40.0]]);
    check(&with("skewY(45)"), [[0.0, 0.0], [60.0, 60.0], [0.0, 40.0]]);
    check(&with("matrix(0 1 -1 0 100 5)"), [[100.0, 5.0], [100.0, 65.0], [60.0, 5.0]]);
    check(
        &format!("<g transform='scale(2)'>{}</g>", with("translate(5 5)")),
        [[10.0, 10.0], [130.0, 10.0], [10.0, 90.0]],
    );
    check(
        &format!(
            "<defs><g id='t' transform='scale(2)'>{triangle}</g></defs><use href='#t' x='7' transform='translate(3 1)'/>"
        ),
        [[10.0, 1.0], [130.0, 1.0], [10.0, 81.0]],
    );
    // The view box of 60 x 40 fits the width of 120 and is centred in the height of 100.
    let view = "viewBox='0 0 60 40'";
    check(
        &format!("<svg x='10' y='20' width='120' height='100' {view}>{triangle}</svg>"),
        [[10.0, 30.0], [130.0, 30.0], [10.0, 110.0]],
    );
    check(
        &format!("<symbol id='s' {view}>{triangle}</symbol><use href='#s' y='5' width='30' height='20'/>"),
        [[0.0, 5.0], [30.0, 5.0], [0.0, 25.0]],
    );
}

/// A random number with up to three decimals.
fn number(random: &mut fastrand::Rng) -> f64 {
    f64::from(random.i32(-100_000..100_000)) / 1000.0
}

/// A random path of some subpaths, with every command.
fn random_path(random: &mut fastrand::Rng) -> String {
    let mut data = String::new();
    for _ in 0..random.usize(1..4) {
        let command = *random.choice([&"M", &"m"]).expect("commands");
        let command = if data.is_empty() { "M" } else { command };
        let _ = write!(data, "{command}{},{}", 200.0 + number(random), 200.0 + number(random));
        for _ in 0..random.usize(1..8) {
            let command = *random.choice(b"LlHhVvCcSsQqTtAaZz").expect("commands");
            data.push(char::from(command));
            if command.eq_ignore_ascii_case(&b'a') {
                let [rx, ry, turn, x, y] = std::array::from_fn(|_| number(random));
                let flags = [random.bool(), random.bool()].map(u8::from);
                let _ = write!(data, "{rx} {ry} {turn} {}{}{x},{y}", flags[0], flags[1]);
                continue;
            }
            let count = [("LT", 2), ("HV", 1), ("C", 6), ("SQ", 4), ("Z", 0)]
                .into_iter()
                .find(|(letters, _)| letters.contains(char::from(command.to_ascii_uppercase())))
                .map_or(0, |(_, count)| count);
            let numbers: Vec<String> = (0..count).map(|_| number(random).to_string()).collect();
            data += &numbers.join(" ");
        }
    }
    data
}

#[test]
fn both_readings_of_random_paths_agree() {
    let mut random = fastrand::Rng::with_seed(7);
    for _ in 0..60 {
        let numbers: [f64; 3] = std::array::from_fn(|_| number(&mut random));
        let transform = format!("translate({} {}) rotate({}) scale(0.7 -1.1)", numbers[0], numbers[1], numbers[2]);
        let shapes = format!(
            "<g transform='{transform}'><path d='{}'/></g><ellipse cx='{}' cy='200' rx='{}' ry='70' transform='skewX(20)'/>\
             <rect x='10' y='{}' width='80' height='{}' rx='{}'/>",
            random_path(&mut random),
            number(&mut random),
            number(&mut random).abs() + 1.0,
            number(&mut random),
            number(&mut random).abs() + 1.0,
            number(&mut random).abs(),
        );
        let source = source(page(&shapes));
        let (marker, found) = read(&source);
        assert!(!found.has_errors(), "{shapes}: {}", render(&found, &source));
        assert_eq!(broken(&source, &marker), [], "{shapes}");
    }
}

#[test]
fn both_readings_of_every_fixture_agree() {
    for path in files("svg") {
        let source = source(fs::read(&path).expect("readable"));
        for lines in [Lines::default(), Lines { all: true, ..Lines::default() }] {
            let mut found = Diagnostics::default();
            let job = Job { lines, ..Job::default() };
            let marker = pipeline::marker_of(by_name("svg").expect("a dialect"), &source, &job, &mut found);
            assert!(!found.has_errors(), "{}", render(&found, &source));
            assert_eq!(broken(&source, &marker), [], "{}", path.display());
            // Whatever is drawn is cut or accounted for.
            assert!(marker.drawing.as_ref().is_some_and(|Account { pen_down, .. }| *pen_down > 0.0));
        }
    }
}

/// Damages of each fixture.
const DAMAGES: usize = 60;

#[test]
fn both_readings_of_damaged_fixtures_agree_where_they_are_read_at_all() {
    let mut random = fastrand::Rng::with_seed(11);
    let (mut sound, mut differing) = (0, Vec::new());
    for path in files("svg") {
        let bytes = fs::read(&path).expect("readable");
        for _ in 0..DAMAGES {
            let mut damaged = bytes.clone();
            let at = random.usize(..damaged.len());
            // Letters that drawings are made of are read more often than others.
            damaged[at] = *random.choice(b"0123456789.-, aAcCmMlLhHvVzZsStTqQ#\"'<>&;{}:").expect("letters");
            let byte = char::from(damaged[at]);
            let source = source(damaged);
            let (marker, found) = read(&source);
            if !found.has_errors() && !marker.pieces.is_empty() {
                sound += 1;
                let broken = broken(&source, &marker);
                if !broken.is_empty() {
                    let names: Vec<&str> = broken.iter().map(|finding| finding.rule.name).collect();
                    differing.push(format!("{}: `{byte}` at {at}: {names:?}", path.display()));
                }
            }
        }
    }
    assert!(differing.is_empty() && sound > 300, "{sound} {differing:#?}");
}

/// The same drawing with one curve, in a file that has it and one that has another line in its stead.
fn read_wrongly(right: &str, wrong: &str) -> Vec<&'static str> {
    let (right, wrong) = (source(page(right)), source(page(wrong)));
    assert_eq!(broken(&right, &read(&right).0), []);
    broken(&right, &read(&wrong).0).iter().map(|finding| finding.rule.name).collect()
}

#[test]
fn what_is_read_wrongly_is_refused() {
    // A curve that bows by a fifth of a millimetre, read as its chord.
    let curve = "<path d='M20 20H300C301 100 301 200 300 300H20Z'/>";
    let found = read_wrongly(curve, &curve.replace("C301 100 301 200 300 300", "L300 300"));
    assert!(found.contains(&"source/moments"), "{found:?}");
    let found =
        read_wrongly("<path d='M20 20H300A400 400 0 0 1 300 80V300H20Z'/>", "<path d='M20 20H300L300 80V300H20Z'/>");
    assert!(found.contains(&"source/moments"), "{found:?}");
    // A subpath that is lost.
    let found =
        read_wrongly("<path d='M20 20H300V300H20ZM20 90h8M20 120h8'/>", "<path d='M20 20H300V300H20ZM20 90h8'/>");
    assert!(found.contains(&"source/points") && found.contains(&"source/length"), "{found:?}");
    // A transform that mirrors, within the same box.
    let shape = "<path d='M-140 -140H100L140 -60V140H-140Z'/>";
    let found = read_wrongly(
        &format!("<g transform='translate(200 200) scale(-1 1)'>{shape}</g>"),
        &format!("<g transform='translate(200 200)'>{shape}</g>"),
    );
    assert_eq!(found, ["source/moments"]);
    // A copy of a copy that is lost, and a layer that is hidden in one reading only.
    let found = read_wrongly(
        "<path id='p' d='M20 20H100V100H20Z'/><use href='#p' x='200'/>",
        "<path id='p' d='M20 20H100V100H20Z'/>",
    );
    assert!(found.contains(&"source/bounds"), "{found:?}");
    let layers = "<path d='M20 20H300V300H20Z'/><g style='display:none'><path d='M40 40H80V80Z'/></g>";
    let found = read_wrongly(layers, &layers.replace("none", "inline"));
    assert!(found.contains(&"source/points"), "{found:?}");
}

#[test]
fn a_marker_that_is_damaged_is_refused() {
    for path in files("svg") {
        let source = source(fs::read(&path).expect("readable"));
        let (marker, _) = read(&source);
        let mut lacking = marker.clone();
        assert!(lacking.pieces[0].contours.pop().is_some());
        assert!(!broken(&source, &lacking).is_empty(), "{}", path.display());
        let mut moved = marker.clone();
        let contour = &mut moved.pieces[0].contours[0];
        *moved.list.cursor(&mut contour.range).from_mut() += Vector::new(0.4, 0.3);
        assert!(!broken(&source, &moved).is_empty(), "{}", path.display());
    }
    for name in ["inkscape-layers-in-mm.svg", "seamly-paths-in-mm.svg", "mirrored-and-rotated.svg"] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/svg").join(name);
        let source = source(fs::read(path).expect("readable"));
        let mut mirrored = read(&source).0;
        let sum = extent(&mirrored).min.x + extent(&mirrored).max.x;
        mirrored.list.move_points(|point| Point::new(sum - point.x, point.y));
        assert!(!broken(&source, &mirrored).is_empty(), "{name}");
    }
}

#[test]
fn a_drawing_that_is_cut_short_never_panics() {
    for name in ["mirrored-and-rotated.svg", "css-by-class-and-id.svg"] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/svg").join(name);
        let bytes = fs::read(path).expect("readable");
        for end in 0..bytes.trim_ascii_end().len() {
            let source = source(&bytes[..end]);
            let (marker, found) = read(&source);
            assert!(found.has_errors(), "cut short at {end}");
            let _ = broken(&source, &marker);
        }
    }
}

#[test]
fn files_made_to_stop_a_reader_are_refused() {
    let mut laughs = "<!DOCTYPE svg [<!ENTITY a0 'ha'>".to_owned();
    for i in 1..12 {
        let _ = write!(laughs, "<!ENTITY a{i} '{}'>", format!("&a{};", i - 1).repeat(10));
    }
    laughs += "]><svg><text>&a11;</text></svg>";
    assert_eq!(codes(laughs), ["svg/entities"]);
    let deep = |count: usize| page(&format!("{}<path d='M9 9H90V90Z'/>{}", "<g>".repeat(count), "</g>".repeat(count)));
    assert_eq!(codes(deep(100_000)), ["svg/too-much"]);
    assert!(!codes(deep(150)).contains(&"svg/too-much"));
    let mut copies = "<defs><path id='c0' d='M9 9H90V90Z'/>".to_owned();
    for i in 1..40 {
        let _ = write!(copies, "<g id='c{i}'><use href='#c{0}'/><use href='#c{0}'/></g>", i - 1);
    }
    assert_eq!(codes(page(&(copies + "</defs><use href='#c39'/>"))), ["svg/too-much"]);
    assert_eq!(codes(page("<g id='a'><use href='#a'/></g>")), ["svg/use-broken"]);
    assert_eq!(codes(page("<path d='M0 0L1e300 1e300'/>")), ["svg/far-place"]);
    assert_eq!(codes(page("<path transform='scale(1e200) scale(1e200)' d='M0 0L1 1'/>")), ["svg/bad-value"]);
    assert_eq!(codes(b"<svg>\xff</svg>".as_slice()), ["svg/encoding"]);
}

#[test]
fn bytes_of_other_kinds_are_told_by_their_names() {
    let refusal = |name: &str, bytes: &[u8]| {
        let source = Source::new(name, bytes.to_vec()).expect("small");
        let mut found = Diagnostics::default();
        assert!(cutc::front::choose(&source, None, Some("svg"), &mut found).is_none());
        render(&found, &source)
    };
    assert!(refusal("a.svgz", b"\x1f\x8b\x08\0").contains("a compressed SVG drawing (SVGZ)"));
    assert!(refusal("a.svg", b"<!DOCTYPE html><html><svg/></html>").contains("a web page"));
}

#[test]
fn what_is_transparent_is_not_cut_and_counted() {
    let whole = "<path d='M20 20H280V380H20Z'/>";
    let is_hidden = |inside: &str| {
        let text = page(&format!("{whole}{inside}"));
        let (marker, found) = read(&source(text.as_str()));
        assert!(broken(&source(text.as_str()), &marker).is_empty(), "{inside}");
        let told = found.iter().any(|finding| ["svg/hidden", "svg/no-line"].contains(&finding.code.name));
        assert_eq!(told, marker.contours().count() == 1, "{inside}");
        told
    };
    let hole = |attributes: &str| format!("<path {attributes} d='M40 40H100V100H40Z'/>");
    for attributes in [
        "opacity='0'",
        "style='opacity:0%'",
        "stroke-opacity='0'",
        "stroke='#ff000000'",
        "stroke='rgba(0,0,0,0)'",
        "display='none'",
        "visibility='hidden'",
        "visibility='collapse'",
    ] {
        assert!(is_hidden(&hole(attributes)), "{attributes}");
        let group = format!("<g {attributes}>{}</g>", hole(""));
        assert!(is_hidden(&group), "{group}");
    }
    assert!(is_hidden(&format!("<g opacity='0'>{}</g>", hole("opacity='1'"))));
    assert!(is_hidden(&format!("<g display='none'>{}</g>", hole("display='inline' visibility='visible'"))));
    for seen in ["opacity='0.01'", "stroke-opacity='50%'", "stroke='#ff000001'", "fill='red' stroke-opacity='0'"] {
        assert!(!is_hidden(&hole(seen)), "{seen}");
    }
    assert!(!is_hidden(&format!("<g visibility='hidden'>{}</g>", hole("visibility='visible'"))));
    assert!(!is_hidden(&format!("<g stroke-opacity='0'>{}</g>", hole("stroke-opacity='1'"))));
}
