//! What the lines of a plot are taken for, and what is said of those that may be something else.

use std::fmt::Write as _;

use cutc::diagnostic::Diagnostics;
use cutc::front::by_name;
use cutc::machine::plot::{Frame, Inner, Lines};
use cutc::machine::{Job, Numbers};
use cutc::pipeline;

use super::audit::audit;
use super::{as_read, rectangle, source};

/// Reads a plot: how many lines of each class, those that are cut with a star; and the codes of what is said.
fn found(text: &str, job: &Job) -> (String, Vec<&'static str>) {
    let source = source(format!("IN;SP1;{text}PU;SP0;"));
    let mut said = Diagnostics::default();
    let marker = pipeline::marker_of(by_name("hpgl").expect("a dialect"), &source, job, &mut said);
    let mut classes = String::new();
    for class in marker.drawing.expect("an account").classes {
        let _ = write!(classes, "{} {}{}, ", class.count, class.name, if class.cut { "*" } else { "" });
    }
    (classes.trim_end_matches(", ").to_owned(), said.iter().map(|finding| finding.code.name).collect())
}

fn check(text: &str, classes: &str, codes: &[&str]) {
    assert_eq!(found(text, &Job::default()), (classes.to_owned(), codes.to_vec()), "{text}");
}

fn asked(text: &str, lines: Lines, classes: &str) {
    let job = Job { lines, ..Job::default() };
    assert_eq!(found(text, &job).0, classes, "{text}");
}

/// A part of 300 by 300 mm from (100, 100) on, its seam line, a cut-out in it.
fn part() -> String {
    rectangle(4000, 4000, 12_000, 12_000)
}

fn seam() -> String {
    rectangle(4400, 4400, 11_200, 11_200)
}

fn cut_out() -> String {
    rectangle(9000, 9000, 2000, 1200)
}

#[test]
fn outermost_closed_lines_are_parts_and_nothing_in_them_is_cut() {
    check(&part(), "1 part*", &[]);
    check(&(part() + &seam()), "1 part*, 1 seam line", &[]);
    check(&(seam() + &cut_out() + &part()), "1 part*, 1 inner line, 1 seam line", &["drawing/inner-lines"]);
    check(&(part() + &seam() + "PU9000,9000;PD12000,9000;"), "1 part*, 1 seam line, 1 other line", &[]);
    // A title beside it hides no border around one rectangle, and neither do even margins where a notch stands on the inner line.
    let border = rectangle(0, 0, 60_000, 24_000) + &rectangle(800, 800, 58_400, 22_400);
    check(&(border + &rectangle(62_000, 0, 2000, 2000)), "2 part*, 1 seam line", &["drawing/may-be-frame"]);
    let notched = part() + &seam() + "PU9000,4400;PD9000,4600;";
    check(&notched, "1 part*, 1 seam line, 1 other line", &["drawing/may-be-frame"]);
    check(&(part() + "PU4000,9000;PD12000,9000;"), "1 part*, 1 line from edge", &["drawing/line-from-edge"]);
}

#[test]
fn inner_lines_are_cut_when_they_are_asked_for_and_seam_lines_only_with_all() {
    let text = part() + &seam() + &cut_out();
    let inner = |inner| Lines { inner: Some(inner), ..Lines::default() };
    asked(&text, inner(Inner::Ignore), "1 part*, 1 inner line, 1 seam line");
    asked(&text, inner(Inner::Cut), "1 part*, 1 inner line*, 1 seam line");
    asked(&text, inner(Inner::All), "1 part*, 1 inner line*, 1 seam line*");
    let pens = Lines { pens: Numbers::parse("1").ok(), ..Lines::default() };
    asked(&text, pens, "1 part*, 1 inner line*, 1 seam line");
    // What takes more than half of its part is that part once more.
    let large = part() + "PU10000,10000;CI5600;";
    asked(&large, inner(Inner::Cut), "1 part*, 1 inner line");
    asked(&large, inner(Inner::All), "1 part*, 1 inner line*");
}

#[test]
fn the_opening_of_a_facing_is_no_seam_line() {
    // 50 mm from its edges all around; with a hem of 50 mm on one side it is a seam line.
    let text = part() + &rectangle(6000, 6000, 8000, 8000);
    check(&(text.clone() + &rectangle(20_000, 4000, 9000, 9000)), "2 part*, 1 inner line", &["drawing/inner-lines"]);
    let inner = |inner| Lines { inner: Some(inner), ..Lines::default() };
    asked(&text, inner(Inner::Cut), "1 part*, 1 inner line*");
    let hemmed = part() + &rectangle(4400, 6000, 11_200, 9600) + &rectangle(20_000, 4000, 9000, 9000);
    check(&hemmed, "2 part*, 1 seam line", &[]);
}

#[test]
fn parts_in_strokes_are_apart_though_both_draw_the_edge_between_them() {
    let mut random = fastrand::Rng::with_seed(44);
    for _ in 0..40 {
        let [columns, rows] = [random.i64(1..=4), random.i64(1..=3)];
        let [width, height] = [random.i64(40..=200) * 40, random.i64(40..=200) * 40];
        let mut parts: Vec<String> = (0..columns * rows)
            .map(|k| in_strokes(&mut random, [k % columns * width, k / columns * height], [width, height]))
            .collect();
        random.shuffle(&mut parts);
        let (classes, codes) = found(&parts.concat(), &Job::default());
        assert_eq!((classes, codes), (format!("{} part*", columns * rows), Vec::new()), "{}", parts.concat());
    }
}

/// A rectangle in four strokes, each from where the last one ends, from any corner on and either way round.
fn in_strokes(random: &mut fastrand::Rng, [x, y]: [i64; 2], [width, height]: [i64; 2]) -> String {
    let mut corners = [[x, y], [x + width, y], [x + width, y + height], [x, y + height]];
    corners.rotate_left(random.usize(0..4));
    if random.bool() {
        corners.reverse();
    }
    let ends = |k: usize| [corners[k], corners[(k + 1) % 4]];
    (0..4)
        .map(ends)
        .fold(String::new(), |text, [from, to]| text + &format!("PU{},{};PD{},{};", from[0], from[1], to[0], to[1]))
}

#[test]
fn a_part_may_touch_its_neighbours_and_the_frame() {
    for gap in [-8, 0, 8] {
        let mut parts = rectangle(0, 0, 20_000, 12_000);
        for k in 0..5 {
            parts += &rectangle(4000 * k, 0, 4000 - gap, 6000 - gap);
            parts += &rectangle(4000 * k, 6000, 4000 - gap, 6000 - gap);
        }
        check(&parts, "10 part*, 1 frame", &[]);
    }
}

#[test]
fn a_rectangle_around_a_few_parts_is_a_frame_and_named_and_one_that_is_nearly_empty_is_in_doubt() {
    let parts = rectangle(100, 100, 9000, 11_000) + &rectangle(10_000, 100, 9000, 11_000);
    let framed = rectangle(0, 0, 20_000, 12_000) + &parts;
    check(&framed, "2 part*, 1 frame", &["drawing/frame"]);
    let mut job = Job::default();
    job.profile.hpgl.frame = Frame::None;
    assert_eq!(found(&framed, &job).0, "1 part*, 2 inner line");
    let empty = rectangle(0, 0, 60_000, 30_000) + &parts;
    check(&empty, "1 part*, 2 inner line", &["drawing/frame-or-part"]);
    job.profile.hpgl.frame = Frame::Outermost;
    assert_eq!(found(&empty, &job), ("2 part*, 1 frame".to_owned(), vec!["drawing/frame"]));
}

/// The edge of a table of a pen of its own, whatever its shape: what the knife's pen draws in it are parts.
#[test]
fn the_outermost_lines_of_a_knife_are_parts_whatever_other_pens_draw_around_them() {
    let edge = "SP4;PU0,0;PD40000,0,42000,20000,0,24000,0,0;SP1;";
    let text = format!("{edge}{}{}{}PU4000,9000;PD4200,9000;", part(), seam(), cut_out());
    asked(&text, Lines::default(), "1 part*, 2 inner line, 1 seam line, 1 other line");
    let pens = Lines { pens: Numbers::parse("1").ok(), ..Lines::default() };
    asked(&text, pens, "1 part*, 1 part, 1 notch*, 1 inner line*, 1 seam line");
}

#[test]
fn letters_are_told_by_the_row_that_they_stand_in() {
    let letters = "PU9000,9000;PD9000,9320,9200,9320,9200,9000,9000,9000;PU9300,9000;PD9300,9320,9500,9320,9500,9000;\
                   PU9600,9320;PD9600,9000,9800,9000;";
    check(&(part() + letters), "1 part*, 3 letter", &[]);
    check(&(part() + &rectangle(9000, 9000, 320, 320)), "1 part*, 1 small sign", &[]);
    // Three closed squares in a row are no text.
    let squares: String = (0..3).map(|k| rectangle(9000 + 600 * k, 9000, 480, 480)).collect();
    check(&(part() + &squares), "1 part*, 3 inner line", &["drawing/may-be-frame"]);
}

#[test]
fn what_lies_in_no_part_and_is_not_cut_is_named() {
    check(&(part() + &rectangle(20_000, 4000, 800, 800)), "1 part*, 1 small outline", &["drawing/small-outlines"]);
    check(&(part() + "PU20000,4000;PD26000,4000,26000,8000;"), "1 part*, 1 open line", &["drawing/open-outlines"]);
    check(&(part() + "PU20000,4000;PD21000,4000;"), "1 part*, 1 other line", &[]);
    // An edge that two parts share stands once in the plot: the line around both is one part.
    let divided = rectangle(4000, 4000, 16_000, 12_000) + "PU12000,4000;PD12000,16000;";
    check(&divided, "1 part*, 1 line from edge", &["drawing/divided-part"]);
}

/// Two parts with an edge in common, which is drawn once: the second one has three sides, or begins and ends amid the edge.
#[test]
fn a_line_that_stands_on_an_edge_from_outside_is_named_by_the_part_that_it_stands_on() {
    let parts = rectangle(40_000, 4000, 8000, 8000) + &part();
    for open in
        ["PU16000,4000;PD24000,4000,24000,16000,16000,16000;", "PU16000,6000;PD20000,6000,20000,14000,16000,14000;"]
    {
        let (classes, _) = found(&(parts.clone() + open), &Job::default());
        assert_eq!(classes, "2 part*, 1 line from edge", "{open}");
        let source = source(format!("IN;SP1;{parts}{open}PU;SP0;"));
        let mut said = Diagnostics::default();
        pipeline::marker_of(by_name("hpgl").expect("a dialect"), &source, &Job::default(), &mut said);
        let told: Vec<_> = said.iter().map(|finding| (finding.code.name, finding.pieces.to_vec())).collect();
        assert_eq!(told, [("drawing/open-outlines", vec![2])], "{open}");
    }
}

/// The line that the knife's pen draws is the seam line of the open one, whose pen only draws: neither is cut, and that is said.
#[test]
fn a_line_of_the_knife_in_an_open_outline_of_another_pen_is_never_lost_in_silence() {
    let outline = "SP2;PU0,0;PD8000,0,8000,6000,0,6000,0,100;SP1;";
    let seam = rectangle(400, 400, 7200, 5200);
    let job = Job { lines: Lines { pens: Numbers::parse("1").ok(), ..Lines::default() }, ..Job::default() };
    let (classes, codes) = found(&format!("{outline}{seam}{}", rectangle(12_000, 0, 8000, 6000)), &job);
    assert_eq!((classes.as_str(), &codes[..]), ("1 part*, 1 seam line, 1 open outline", &["drawing/open-part"][..]));
}

#[test]
fn a_seam_line_that_leaves_its_part_at_a_corner_is_its_seam_line() {
    let seam = "PU4400,6000;PD16040,6000,15600,15600,4400,15600,4400,6000;";
    check(&(part() + seam), "1 part*, 1 seam line", &[]);
}

#[test]
fn a_file_ends_properly_unless_it_ends_amid_a_number_or_an_outline() {
    let cut_outs = Job { lines: Lines { inner: Some(Inner::Cut), ..Lines::default() }, ..Job::default() };
    let check_as = |end: &str, code: Option<&str>, job: &Job| {
        let source = source(format!("IN;SP1;{}{end}", part()));
        let mut said = Diagnostics::default();
        pipeline::marker_of(by_name("hpgl").expect("a dialect"), &source, job, &mut said);
        let codes: Vec<&str> = said.iter().map(|finding| finding.code.name).collect();
        assert_eq!(codes, Vec::from_iter(code), "{end}");
    };
    let check = |end: &str, code: Option<&str>| check_as(end, code, &Job::default());
    let open = "PU20000,4000;PD26000,4000,26000,8000";
    check("", None);
    check("PG;", None);
    check("PU20000,4000;PD20000,4002;PG;", None);
    check("PU20000,4000;PD20000,4002;", None);
    check("PU5000,5000;PD9000,5000;", None);
    check(&format!("{open};"), Some("drawing/cut-short"));
    check(open, Some("drawing/cut-short"));
    check("PU5000,5000;PD9000,500", Some("drawing/cut-short"));
    let cut_out = "PU5000,5000;PD9000,5000,9000,9000;";
    check(cut_out, None);
    check_as(cut_out, Some("drawing/cut-short"), &cut_outs);
    check_as(&format!("{cut_out}PU;"), None, &cut_outs);
    for end in ["PG;", "SP0;", "PU;", "\u{1b}E"] {
        check(&format!("{open};{end}"), Some("drawing/open-outlines"));
    }
}

/// Frames, double frames, nested outlines, strokes that cross, texts: whatever is drawn, each line is in one class, nothing
/// is lost, and nothing that is not asked for is cut inside a part.
#[test]
fn every_line_of_any_drawing_is_in_a_stated_class() {
    let mut random = fastrand::Rng::with_seed(20);
    let mut cut = 0;
    for round in 0..400 {
        let mut text = String::new();
        if random.bool() {
            for margin in [0, 400].into_iter().take(random.usize(1..=2)) {
                text += &rectangle(margin - 1000, margin - 1000, 42_000 - 2 * margin, 42_000 - 2 * margin);
            }
        }
        for _ in 0..random.usize(1..40) {
            let [x, y] = [0; 2].map(|_| i64::from(random.i32(0..40_000)));
            let size = i64::from(random.i32(20..12_000));
            match random.u8(0..5) {
                0 => (0..random.i64(1..5)).for_each(|k| {
                    let inset = k * i64::from(random.i32(1..800));
                    if size > 2 * inset {
                        text += &rectangle(x + inset, y + inset, size - 2 * inset, size - 2 * inset);
                    }
                }),
                1 => _ = write!(text, "PU{x},{y};PD{},{},{},{};", x + size, y + size, x - size, y + size),
                2 => _ = write!(text, "PU{x},{y};LBtext\u{3};"),
                3 => (0..random.i64(1..6)).for_each(|k| text += &rectangle(x + 300 * k, y, 200, 320)),
                _ => _ = write!(text, "SP{};PU{x},{y};PD{x},{};SP1;", random.u8(1..4), y + random.i64(10..700)),
            }
        }
        let plot = source(format!("IN;SP1;{text}PU;SP0;"));
        for lines in [Lines::default(), Lines { inner: Some(Inner::Cut), ..Lines::default() }] {
            let job = Job { lines, ..Job::default() };
            let marker = as_read(&plot, &job);
            assert_eq!(audit(&plot, &marker, &job), [], "{round} {text}");
            let account = marker.drawing.as_ref().expect("an account");
            let length: f64 = account.classes.iter().map(|class| class.length).sum();
            assert!((length - account.pen_down).abs() < 1.0 + 1e-6 * length, "{round} {text}");
            cut += marker.contours().count();
        }
    }
    assert!(cut > 2000, "{cut}");
}
