//! Frames are known by what they hold, whatever lies beside them; what lies outside is not cut.

use cutc::diagnostic::Diagnostics;
use cutc::front::by_name;
use cutc::ir::Marker;
use cutc::machine::plot::{Frame, Inner, Lines};
use cutc::machine::{Job, Numbers};
use cutc::pipeline;
use cutc::verify::{DrawingCuts, drawing_audit};

use super::closing::{areas, found};
use super::{as_read, key, outlines, read, rectangle, source};

const FRAME: [i64; 4] = [0, 0, 40_000, 24_000];

fn drawn(lines: &[[i64; 4]]) -> String {
    let lines: String = lines.iter().map(|&[x, y, width, height]| rectangle(x, y, width, height)).collect();
    format!("IN;SP1;{lines}PU;SP0;")
}

/// Two parts that fill a frame from a place on.
fn parts(x: i64) -> [[i64; 4]; 2] {
    [[x + 400, 400, 19_200, 23_200], [x + 20_400, 400, 19_200, 23_200]]
}

/// What is cut, each by its least corner, in the order of the file; and the codes of what is said.
fn cut(lines: &[[i64; 4]], job: &Job) -> (Vec<[i64; 2]>, Vec<&'static str>) {
    let source = source(drawn(lines));
    let mut found = Diagnostics::default();
    let marker = pipeline::marker_of(by_name("hpgl").expect("a dialect"), &source, job, &mut found);
    let corners = outlines(&marker).iter().map(|outline| key(outline[0])).collect();
    let codes: Vec<&str> = found.iter().map(|finding| finding.code.name).collect();
    if !found.has_errors() {
        let findings = drawing_audit("hpgl", source.bytes(), &DrawingCuts::of(&marker), job);
        assert!(findings.iter().all(cutc::ir::Finding::holds), "{lines:?} {findings:?}");
    }
    (corners, codes)
}

fn check(lines: &[[i64; 4]], expected: &[[i64; 4]], codes: &[&str]) {
    let corners: Vec<[i64; 2]> = expected.iter().map(|&[x, y, ..]| [x, y]).collect();
    assert_eq!(cut(lines, &Job::default()), (corners, codes.to_vec()), "{lines:?}");
}

#[test]
fn a_frame_is_known_by_its_parts_whatever_lies_beside_it() {
    let beside = [
        [0, 24_400, 1200, 1200],
        [0, -1600, 8000, 1600],
        [0, -1800, 8000, 1600],
        [42_000, 0, 4000, 4000],
        [1000, 25_000, 720, 1200],
    ];
    let all = |beside: &[[i64; 4]]| [&[FRAME][..], &parts(0), beside].concat();
    for one in beside {
        check(&all(&[one]), &parts(0), &["drawing/outside-frame", "drawing/frame"]);
    }
    check(&all(&beside), &parts(0), &["drawing/outside-frame", "drawing/frame"]);
    // A knife's lines are parts wherever they lie.
    let job = Job { lines: Lines { pens: Numbers::parse("1").ok(), ..Lines::default() }, ..Job::default() };
    assert_eq!(cut(&all(&beside[..1]), &job).0, [[400, 400], [20_400, 400], [0, 24_400]]);
}

#[test]
fn markers_beside_each_other_have_a_frame_each() {
    let second = [42_000, 0, 40_000, 24_000];
    let all = [&[FRAME][..], &parts(0), &[second], &parts(42_000)].concat();
    check(&all, &[parts(0), parts(42_000)].concat(), &["drawing/frame"]);
    let title = [&all[..], &[[0, -1600, 8000, 1600]]].concat();
    check(&title, &[parts(0), parts(42_000)].concat(), &["drawing/outside-frame", "drawing/frame"]);
}

#[test]
fn a_title_block_on_the_paper_beside_the_cloth_hides_neither_frame() {
    let [paper, title] = [[-600, -1200, 41_200, 25_800], [0, -1100, 8000, 900]];
    let all = [&[paper, FRAME, title][..], &parts(0)].concat();
    check(&all, &parts(0), &["drawing/outside-frame", "drawing/frame"]);
}

#[test]
fn a_rectangle_with_cut_outs_among_many_parts_is_one_of_them() {
    let panel = [0, 0, 12_000, 8000];
    let windows = [[400, 400, 5000, 7000], [6400, 400, 5000, 7000]];
    let others: Vec<[i64; 4]> = (0..4).map(|k| [20_000 + 9000 * k, 0, 8000, 6000]).collect();
    let all = [&[panel][..], &windows, &others].concat();
    check(&all, &[&[panel][..], &others].concat(), &["drawing/may-be-frame"]);
    // One other part may lie beside a frame, or be beside a part.
    let few = [&[panel][..], &windows, &others[..1]].concat();
    assert_eq!(cut(&few, &Job::default()).1, ["drawing/frame-or-part"]);
}

#[test]
fn somebody_says_whether_a_rectangle_that_is_nearly_empty_is_a_frame() {
    let sheet = [0, 0, 80_000, 48_000];
    let all = [&[sheet][..], &parts(0)].concat();
    assert_eq!(cut(&all, &Job::default()).1, ["drawing/frame-or-part"]);
    let mut job = Job::default();
    job.profile.hpgl.frame = Frame::Outermost;
    assert_eq!(cut(&all, &job), (parts(0).map(|[x, y, ..]| [x, y]).to_vec(), vec!["drawing/frame"]));
    let job = Job { lines: Lines { inner: Some(Inner::Ignore), ..Lines::default() }, ..Job::default() };
    assert_eq!(cut(&all, &job), (vec![[0, 0]], vec!["drawing/may-be-frame"]));
}

#[test]
fn a_frame_in_a_frame_that_is_nearly_empty_is_no_part_before_somebody_says_so() {
    let [paper, sheet] = [[-600, -600, 81_200, 49_200], [0, 0, 80_000, 48_000]];
    let all = [&[paper, sheet][..], &parts(0)].concat();
    assert_eq!(cut(&all, &Job::default()).1, ["drawing/frame-or-part"]);
    let mut job = Job::default();
    job.profile.hpgl.frame = Frame::Outermost;
    assert_eq!(cut(&all, &job).1, ["drawing/frame-or-part", "drawing/frame"]);
    job.lines.inner = Some(Inner::Ignore);
    assert_eq!(cut(&all, &job), (vec![[0, 0]], vec!["drawing/may-be-frame", "drawing/frame"]));
}

#[test]
fn parts_in_strokes_are_whole_though_a_frame_lies_on_their_edges() {
    let strokes = |[x, y, width, height]: [i64; 4]| {
        let (right, top) = (x + width, y + height);
        format!(
            "PU{x},{y};PD{right},{y};PU{right},{y};PD{right},{top};PU{right},{top};PD{x},{top};PU{x},{top};PD{x},{y};"
        )
    };
    let whole = |[x, y, width, height]: [i64; 4]| rectangle(x, y, width, height);
    let [beside, above] = [[8000, 0, 10_000, 6000], [0, 6000, 8000, 5000]];
    for (other, frame) in [(beside, [0, 0, 18_000, 6000]), (above, [0, 0, 8000, 11_000])] {
        for (other, drawn) in [(other, whole(other)), (other, strokes(other))] {
            let text = strokes([0, 0, 8000, 6000]) + &drawn + &whole(frame);
            let (marker, codes) = found(&text, &Job::default());
            let mut areas = areas(&marker);
            areas.sort_by(f64::total_cmp);
            let mut expected = [30_000.0, (other[2] * other[3]) as f64 / 1600.0];
            expected.sort_by(f64::total_cmp);
            assert_eq!((areas, codes), (expected.to_vec(), vec!["drawing/frame"]), "{text}");
        }
    }
}

#[test]
fn a_frame_that_is_cut_and_a_title_block_that_is_cut_are_refused() {
    let title = [0, -1600, 8000, 1600];
    let source = source(drawn(&[&[FRAME, title][..], &parts(0)].concat()));
    let is_refused = |marker: &Marker| {
        let findings = drawing_audit("hpgl", source.bytes(), &DrawingCuts::of(marker), &Job::default());
        findings.iter().any(|finding| finding.rule.name == "source/outermost" && !finding.holds())
    };
    let mut asked = Job::default();
    asked.profile.hpgl.frame = Frame::None;
    assert!(is_refused(&as_read(&source, &asked)));
    let every = Job { lines: Lines { all: true, ..Lines::default() }, ..Job::default() };
    assert!(is_refused(&as_read(&source, &every)));
    assert!(!is_refused(&as_read(&source, &Job::default())));
}

/// A border around one part has the seam line of the part in it; a part with a cut-out that is stitched around looks the same.
#[test]
fn a_rectangle_around_one_line_with_its_seam_line_is_refused_until_it_is_said_what_it_is() {
    let told = |lines: &str, job: &Job| read(&source(format!("IN;SP1;{lines}PU;SP0;")), job).1;
    let part = "PU4000,4000;PD14000,4000,14400,10000,12000,22000,4800,22000,4000,4000;";
    let seam = "PU4400,4400;PD13600,4400,13900,10000,11600,21500,5200,21500,4400,4400;";
    let all = format!("{}{part}{seam}", rectangle(0, 0, 20_000, 28_000));
    assert_eq!(told(&all, &Job::default()), ["drawing/frame-or-part"]);
    let mut job = Job::default();
    job.profile.hpgl.frame = Frame::Outermost;
    assert_eq!(told(&all, &job), ["drawing/frame"]);
    let as_part = Job { lines: Lines { inner: Some(Inner::Ignore), ..Lines::default() }, ..Job::default() };
    assert_eq!(told(&all, &as_part), ["drawing/may-be-frame"]);
    // A line without a sign of a part is a cut-out more often than a part, and one that fills little is a pocket.
    let bare = format!("{}{part}", rectangle(0, 0, 20_000, 28_000));
    assert_eq!(told(&bare, &Job::default()), ["drawing/may-be-frame"]);
    let far = format!("{}{part}{seam}", rectangle(0, 0, 60_000, 36_000));
    assert_ne!(told(&far, &Job::default()), ["drawing/frame-or-part"]);
}

/// Parts are laid from a corner of the cloth, and a cut-out lies in the middle of its part as a rule.
#[test]
fn a_rectangle_that_is_empty_but_for_its_corner_is_refused_until_it_is_said_what_it_is() {
    let part = [800, 800, 12_000, 8000];
    let others = [[14_000, 800, 12_000, 8000], [800, 12_000, 12_000, 8000]];
    for sheet in [[0, 0, 16_000, 12_000], [0, 0, 24_000, 24_000], [0, 0, 60_000, 60_000]] {
        assert_eq!(cut(&[sheet, part], &Job::default()).1[0], "drawing/frame-or-part", "{sheet:?}");
    }
    let sheet = [0, 0, 80_000, 60_000];
    for lines in [&[sheet, part, others[0]][..], &[sheet, part, others[0], others[1]]] {
        assert_eq!(cut(lines, &Job::default()).1[0], "drawing/frame-or-part", "{lines:?}");
    }
    let job = Job { lines: Lines { inner: Some(Inner::Ignore), ..Lines::default() }, ..Job::default() };
    assert_eq!(cut(&[sheet, part], &job).0, [[0, 0]]);
    let mut job = Job::default();
    job.profile.hpgl.frame = Frame::Outermost;
    assert_eq!(cut(&[sheet, part], &job), (vec![[800, 800]], vec!["drawing/frame"]));
    // Cut-outs in the middle, near one edge, all along the part, or as small as an eyelet.
    for inner in [[24_000, 20_000, 12_000, 8000], [24_000, 800, 12_000, 8000], [800, 800, 78_400, 58_400]] {
        assert!(!cut(&[sheet, inner], &Job::default()).1.contains(&"drawing/frame-or-part"), "{inner:?}");
    }
    check(&[sheet, [800, 800, 1600, 1600]], &[sheet], &["drawing/inner-lines"]);
}

/// A part longer than any table has lost a decimal point, or a digit of it is doubled.
#[test]
fn a_part_of_hundreds_of_metres_is_doubted() {
    for part in [[800, 800, 12_000, 8_799_200], [800, 800, 880_000, 8000]] {
        check(&[part], &[part], &["drawing/size"]);
    }
    let row: Vec<[i64; 4]> = (0..3).map(|k| [k * 2_000_000, 0, 12_000, 8000]).collect();
    check(&row, &row, &["drawing/size"]);
    check(&[[0, 0, 12_000, 390_000]], &[[0, 0, 12_000, 390_000]], &[]);
}

/// A cut-out is waste: nothing is marked on it, and its notches lead into the cloth around it.
#[test]
fn a_rectangle_around_one_line_with_the_marks_of_a_part_is_refused_until_it_is_said_what_it_is() {
    let told = |lines: &str, job: &Job| read(&source(format!("IN;SP1;{lines}PU;SP0;")), job).1;
    let part = "PU4000,4000;PD14000,4000,14400,10000,12000,22000,4800,22000,4000,4000;";
    let bare = format!("{}{part}", rectangle(0, 0, 20_000, 28_000));
    let [inwards, outwards] = ["PU8000,4000;PD8000,4240;", "PU8000,4000;PD8000,3760;"];
    let [v_inwards, v_outwards] = ["PU7900,4000;PD8000,4200,8100,4000;", "PU7900,4000;PD8000,3800,8100,4000;"];
    let [grain, beside, across] =
        ["PU8000,8000;PD8000,18000;", "PU18000,8000;PD18000,18000;", "PU8000,2000;PD8000,26000;"];
    for mark in [inwards, v_inwards, grain] {
        let all = format!("{bare}{mark}");
        assert_eq!(told(&all, &Job::default()), ["drawing/frame-or-part"], "{mark}");
        let mut job = Job::default();
        job.profile.hpgl.frame = Frame::Outermost;
        assert!(!told(&all, &job).contains(&"drawing/frame-or-part"), "{mark}");
        let as_part = Job { lines: Lines { inner: Some(Inner::Ignore), ..Lines::default() }, ..Job::default() };
        assert!(!told(&all, &as_part).contains(&"drawing/frame-or-part"), "{mark}");
        // A notch on the rectangle: that is the part.
        let notched = format!("{all}PU10000,0;PD10000,240;");
        assert!(!told(&notched, &Job::default()).contains(&"drawing/frame-or-part"), "{mark}");
    }
    for mark in [outwards, v_outwards, beside, across] {
        assert!(!told(&format!("{bare}{mark}"), &Job::default()).contains(&"drawing/frame-or-part"), "{mark}");
    }
    // A part of odd margins around a seam line with a notch on it, and one with even margins.
    let seam = |margins: [i64; 4]| {
        let [left, low, right, top] = margins;
        let inner = rectangle(left, low, 20_000 - left - right, 28_000 - low - top);
        format!("{}{inner}PU9000,{low};PD9000,{};", rectangle(0, 0, 20_000, 28_000), low + 240)
    };
    assert_eq!(told(&seam([1600, 800, 2400, 1200]), &Job::default()), ["drawing/frame-or-part"]);
    assert_ne!(told(&seam([400, 400, 400, 400]), &Job::default()), ["drawing/frame-or-part"]);
}
