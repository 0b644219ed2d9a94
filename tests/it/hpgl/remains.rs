//! Outlines that are not whole, strokes that are drawn twice, and frames: no seam line is cut in the place of its
//! outline, and what is drawn twice is cut once.

use std::fmt::Write as _;

use cutc::diagnostic::Diagnostics;
use cutc::front::by_name;
use cutc::geom::ring;
use cutc::ir::Marker;
use cutc::ir::marker::OutlineNotch;
use cutc::machine::plot::{Inner, Lines, PenUse};
use cutc::machine::{Beside, Job, Numbers};
use cutc::pipeline;

use super::closing::{areas, found, missed};
use super::{rectangle, source};
use crate::support::room::Room;

/// An outline of 12,000 by 8000 units from (400, 400) on, drawn in several ways that are not whole.
fn broken_outlines() -> Vec<(&'static str, String)> {
    let [x, y, right, top] = [400, 400, 12_400, 8400];
    let sides = |cut: i64| {
        format!(
            "PU{},{y};PD{right},{y};PU{right},{};PD{right},{top};PU{},{top};PD{x},{top};PU{x},{};PD{x},{y};",
            x + cut,
            y + cut,
            right - cut,
            top - cut
        )
    };
    let mut dashes = String::new();
    for (from, to, step) in [(x, right, 400), (x, right, 700)] {
        dashes.clear();
        let dash = step * 3 / 5;
        for at in (from..to).step_by(step as usize) {
            _ = write!(dashes, "PU{at},{y};PD{},{y};PU{at},{top};PD{},{top};", at + dash, at + dash);
        }
        for at in (y..top).step_by(step as usize) {
            _ = write!(dashes, "PU{x},{at};PD{x},{};PU{right},{at};PD{right},{};", at + dash, at + dash);
        }
    }
    vec![
        ("sides 2 mm apart", sides(80)),
        ("sides 5 mm apart", sides(200)),
        ("sides 30 mm apart", sides(1200)),
        ("sides past the corners", sides(-120)),
        ("dashes", dashes),
        ("two opposite sides", format!("PU{x},{y};PD{right},{y};PU{right},{top};PD{x},{top};")),
        (
            "stretches between notches",
            "PU4240,400;PD12400,400,12400,4000;PU12400,4240;PD12400,8400,4240,8400;PU4000,8400;PD400,8400,400,4240;\
             PU400,4000;PD400,400,4000,400;"
                .to_owned(),
        ),
    ]
}

#[test]
fn a_seam_line_is_no_part_when_its_outline_is_drawn_in_strokes_that_do_not_meet() {
    let seam = rectangle(800, 800, 11_200, 7200);
    let sound = rectangle(20_400, 400, 12_000, 12_000) + &rectangle(20_800, 800, 11_200, 11_200);
    for (name, outline) in broken_outlines() {
        for text in [format!("{outline}{seam}{sound}"), format!("{seam}{sound}{outline}")] {
            let (marker, codes) = found(&text, &Job::default());
            assert_eq!((areas(&marker), codes), (vec![90_000.0], vec!["drawing/open-part"]), "{name}");
        }
    }
    // Two outlines that were drawn without a lift between them.
    let both =
        "PU400,400;PD12400,400,12400,8400,400,8400,400,400,20400,400,32400,400,32400,12400,20400,12400,20400,400;";
    let (marker, codes) = found(&format!("{both}{seam}"), &Job::default());
    assert_eq!((areas(&marker), codes), (vec![], vec!["drawing/open-part", "drawing/nothing-to-cut"]));
}

#[test]
fn a_seam_line_with_a_topstitch_in_it_is_not_cut_in_the_place_of_a_broken_outline() {
    let lines = rectangle(800, 800, 11_200, 7200) + &rectangle(1040, 1040, 10_720, 6720);
    let mut guides = Job::default();
    guides.profile.drawing.beside = Beside::Guide;
    for (name, outline) in broken_outlines() {
        for text in [format!("{outline}{lines}"), format!("{lines}{outline}")] {
            let (_, codes) = found(&text, &Job::default());
            assert!(codes.contains(&"drawing/may-be-seam-line"), "{name}: {codes:?}");
            assert_eq!(areas(&found(&text, &guides).0), [50_400.0], "{name}");
        }
    }
}

#[test]
fn lines_in_a_neighbour_that_touches_a_part_say_nothing_about_the_part() {
    // Neighbours may overlap the part by the rounding of each.
    for over in [0, 4] {
        let parts = rectangle(0, 0, 9600, 4000 + over)
            + &rectangle(0, 4000, 3000 + over, 1280)
            + &rectangle(3000, 4000, 1280, 1280)
            + &rectangle(4280 - over, 4000, 5320 + over, 1280)
            + &rectangle(0, 5280 - over, 9600, 4000);
        let dashes = (400..9200).step_by(600).fold(String::new(), |text, x| {
            text + &format!("PU{x},3600;PD{},3600;PU{x},5680;PD{},5680;", x + 360, x + 360)
        });
        let dashes = (4100..5200)
            .step_by(300)
            .fold(dashes, |text, y| text + &format!("PU2600,{y};PD2600,{};PU4680,{y};PD4680,{};", y + 200, y + 200));
        let bars = (400..9200).step_by(600).fold(String::new(), |text, x| {
            text + &format!("PU{x},4000;PD{x},3800;PU{},3800;PD{},3800;", x - 100, x + 100)
                + &format!("PU{x},5280;PD{x},5480;PU{},5480;PD{},5480;", x - 100, x + 100)
        });
        for lines in [dashes, bars] {
            let (marker, codes) = found(&format!("{parts}{lines}"), &Job::default());
            assert_eq!(marker.pieces.len(), 5, "{codes:?} {lines}");
            assert!(!codes.contains(&"drawing/may-be-seam-line"), "{codes:?} {lines}");
        }
    }
}

#[test]
fn a_broken_outline_beside_a_part_in_a_frame_is_told_as_such() {
    let seam = rectangle(800, 800, 11_200, 7200);
    let beside = rectangle(400, 8400, 12_000, 7000) + &rectangle(800, 8800, 11_200, 6200);
    for (name, outline) in broken_outlines().into_iter().filter(|(name, _)| !name.contains("opposite")) {
        for frame in [rectangle(400, 400, 12_000, 15_000), rectangle(-200, -200, 13_200, 16_200)] {
            let (marker, codes) = found(&format!("{outline}{seam}{beside}{frame}"), &Job::default());
            assert_eq!(areas(&marker), [52_500.0], "{name} {codes:?}");
            assert!(codes.contains(&"drawing/open-part"), "{name} {codes:?}");
        }
    }
}

#[test]
fn an_open_outline_of_a_pen_that_only_draws_is_told() {
    let seam = rectangle(800, 800, 11_200, 7200);
    let text =
        format!("SP2;PU12400,400;PD400,400,400,8400,12400,8400;SP1;{seam}{}", rectangle(20_400, 400, 8000, 8000));
    let mut job = Job::default();
    job.profile.hpgl.pens.insert("2".to_owned(), PenUse::Pen);
    let (marker, codes) = found(&text, &job);
    assert_eq!((areas(&marker), codes), (vec![40_000.0], vec!["drawing/open-part"]));
}

#[test]
fn a_part_without_a_seam_line_stays_one_beside_open_lines_that_are_no_outline_of_it() {
    let part = rectangle(400, 400, 6000, 6000);
    let neighbours = [
        "PU12400,400;PD6480,400,6480,6400,12400,6400;",
        "PU-6000,400;PD320,400,320,6400,-6000,6400;",
        "PU400,12400;PD400,6480,6400,6480,6400,12400;",
    ];
    let cloth = "PU-20000,0;PD30000,0;PU-20000,6800;PD30000,6800;";
    let grain = "PU1000,3000;PD6000,3000;PU600,600;PD600,6200;PU6200,600;PD6200,6200;PU600,6200;PD6200,6200;";
    let text = (0..12).fold(String::new(), |text, i| {
        text + &format!("PU{},100;PD{},250,{},100;", 400 + i * 300, 500 + i * 300, 600 + i * 300)
    });
    for lines in [
        neighbours[0].to_owned(),
        neighbours[..2].concat(),
        neighbours[1..].concat(),
        cloth.to_owned(),
        grain.to_owned(),
        format!("{text}{cloth}{grain}"),
    ] {
        let (marker, _) = found(&format!("{part}{lines}"), &Job::default());
        assert_eq!(areas(&marker), [22_500.0], "{lines}");
    }
    // Its own seam line makes it an outline, whatever is drawn around it.
    let seam = rectangle(800, 800, 5200, 5200);
    let around = "PU200,200;PD6600,200;PU6600,0;PD6600,6600;PU6800,6600;PD200,6600;PU200,6400;PD200,400;";
    let (marker, _) = found(&format!("{part}{seam}{around}"), &Job::default());
    assert_eq!(areas(&marker), [22_500.0]);
}

/// The words of the notches of the outlines, and how many slits there are.
fn notches(marker: &Marker) -> (Vec<&'static str>, usize) {
    let words = marker.pieces.iter().flat_map(|piece| &piece.outline_notches).map(OutlineNotch::word).collect();
    (words, marker.pieces.iter().map(|piece| piece.notches.len()).sum())
}

#[test]
fn what_is_drawn_twice_is_cut_once_and_counted() {
    let part = rectangle(400, 400, 12_000, 8000);
    let sides = "PU20400,400;PD28400,400;PU28400,400;PD28400,8400;PU20400,8400;PD28400,8400;PU20400,8400;PD20400,400;";
    let v = "PU4000,400;PD4120,640,4240,400;";
    let back = "PU4240,400;PD4120,640,4000,400;";
    let slit = "PU8000,400;PD8000,640;";
    let once = format!("{part}{sides}{v}{slit}");
    let (plain, codes) = found(&once, &Job::default());
    assert_eq!((notches(&plain), codes), ((vec!["v"], 1), vec![]));
    for again in [v.to_owned(), back.to_owned(), slit.to_owned(), sides.to_owned(), once.clone(), format!("SP2;{once}")]
    {
        let (marker, codes) = found(&format!("{once}{again}"), &Job::default());
        assert_eq!((areas(&marker), notches(&marker)), (areas(&plain), notches(&plain)), "{again}");
        assert_eq!(codes, ["drawing/drawn-again"], "{again}");
    }
    // An edge that two parts draw is no repetition, and that of two parts drawn twice is one.
    let two = "PU400,400;PD4400,400;PU4400,400;PD4400,4400;PU4400,4400;PD400,4400,400,400;\
               PU4400,4400;PD4400,400;PU4400,400;PD8400,400,8400,5400,4400,5400,4400,4400;";
    let (plain, codes) = found(two, &Job::default());
    assert!(!codes.contains(&"drawing/drawn-again"), "{codes:?}");
    let (marker, codes) = found(&format!("{two}SP3;{two}"), &Job::default());
    assert_eq!(areas(&marker), areas(&plain));
    assert!(codes.contains(&"drawing/drawn-again"), "{codes:?}");
}

#[test]
fn a_rectangle_with_its_seam_line_and_marks_on_its_hem_is_a_part_and_one_around_parts_a_frame() {
    let (part, seam) = (rectangle(400, 400, 16_000, 12_000), rectangle(800, 2400, 15_200, 9600));
    for mark in [
        "PU4000,400;PD4000,2000,6000,2000,6000,400;",
        "PU4000,600;PD6000,600,6000,2000,4000,2000,4000,600;",
        "PU16400,400;PD24400,400,24400,12400,16400,12400;",
        "PU400,12400;PD400,20400,16400,20400,16400,12400;",
    ] {
        let (marker, codes) = found(&format!("{part}{seam}{mark}"), &Job::default());
        assert_eq!(areas(&marker), [120_000.0], "{mark} {codes:?}");
        assert!(!codes.contains(&"drawing/frame"), "{mark} {codes:?}");
    }
    let frames = [
        rectangle(0, 0, 16_000, 8000),
        "PU0,0;PD16000,0;PU16000,0;PD16000,8000;PU16000,8000;PD0,8000;PU0,8000;PD0,0;".to_owned(),
        "PU0,0;PD16000,0,16000,8000,0,8000,0,0,1000,0;".to_owned(),
    ];
    for frame in frames {
        let text = format!("{frame}PU0,400;PD7000,400,7000,7600,0,7600;{}", rectangle(8000, 400, 7000, 7000));
        let (marker, codes) = found(&text, &Job::default());
        assert_eq!(areas(&marker).len(), 2, "{frame}");
        assert!(codes.contains(&"drawing/closed") && codes.contains(&"drawing/frame"), "{frame} {codes:?}");
    }
}

#[test]
fn a_reader_that_takes_a_part_with_a_mark_on_its_hem_for_a_frame_is_caught() {
    let (part, seam) = (rectangle(400, 400, 16_000, 12_000), rectangle(800, 2800, 15_200, 9200));
    let mark = rectangle(4000, 600, 2000, 1800);
    assert_eq!(missed(&seam, &format!("{part}{seam}{mark}")), ["source/outermost"]);
    // A frame around a part that is cut and one whose outline has a gap.
    let open = "PU20400,400;PD16500,400,16500,12400,20400,12400;";
    let frame = rectangle(0, 0, 24_000, 12_800);
    let held = rectangle(16_900, 800, 3500, 11_200);
    assert_eq!(missed(&part, &format!("{frame}{part}{open}{held}")), [""; 0]);
}

#[test]
fn an_outline_that_is_lifted_at_its_notches_is_cut_and_a_notch_beside_it_that_is_not_is_caught() {
    let outline = "PU4240,400;PD12400,400,12400,8400,400,8400,400,400,4000,400;";
    for notch in [
        "PU4000,400;PD4120,640,4240,400;",
        "PU4012,408;PD4120,640,4228,408;",
        "PU4000,400;PD4000,640,4240,640,4240,400;",
    ] {
        let (marker, _) = found(&format!("{outline}{notch}"), &Job::default());
        assert_eq!(notches(&marker).0.len(), 1, "{notch}");
        let whole = rectangle(400, 400, 12_000, 8000);
        assert_eq!(missed(&whole, &format!("{whole}{notch}")), ["source/strokes"], "{notch}");
    }
    // Two mouths that touch, and notches beside each other.
    let v = |x: i64| format!("PU{x},400;PD{},640,{},400;", x + 120, x + 240);
    let part = rectangle(400, 400, 12_000, 8000);
    for step in [280, 320, 360, 440, 480, 700] {
        for count in 1..=4 {
            let text = (0..count).fold(part.clone(), |text, k| text + &v(4000 + k * step));
            let (marker, _) = found(&text, &Job::default());
            assert_eq!(notches(&marker).0.len(), count as usize, "{count} notches {step} units apart");
        }
    }
    let (marker, _) = found(&(part + &v(4000) + &v(4240)), &Job::default());
    let full = 300.0 * 200.0 - 2.0 * 18.0;
    assert!(areas(&marker).iter().all(|area| (area - full).abs() <= 1.0), "{:?}", areas(&marker));
    assert!(marker.contours().all(|(_, contour)| ring::area(&marker.points(contour)).abs() > 0.0));
}

#[test]
fn gaps_are_bridged_up_to_the_limit_whichever_way_they_lie_and_to_the_nearer_end() {
    let outline = |dx: i64, dy: i64| {
        format!("PU400,400;PD12400,400,12400,8400;PU{},{};PD400,8400,400,400;", 12_400 + dx, 8400 + dy)
    };
    for (dx, dy, closes) in [(56, 0, true), (40, 40, true), (56, 56, false), (0, 61, false)] {
        let (marker, _) = found(&outline(dx, dy), &Job::default());
        assert_eq!(areas(&marker).len(), usize::from(closes), "{dx} {dy}");
    }
    // Two outlines with gaps of 0.9 mm, 1 mm from each other.
    let sides = |x: i64| {
        let right = x + 6000;
        format!(
            "PU{},400;PD{right},400;PU{right},436;PD{right},8400;PU{},8400;PD{x},8400;PU{x},8364;PD{x},400;",
            x + 36,
            right - 36
        )
    };
    let (marker, codes) = found(&(sides(400) + &sides(6440)), &Job::default());
    assert_eq!((areas(&marker).len(), codes), (2, vec!["drawing/closed"]));
}

#[test]
fn a_reader_that_cuts_a_seam_line_inside_a_broken_outline_is_caught() {
    let seam = rectangle(800, 800, 11_200, 7200);
    let other = rectangle(20_400, 400, 12_000, 12_000);
    for (name, outline) in broken_outlines().into_iter().filter(|(name, _)| *name != "two opposite sides") {
        let whole = format!("{outline}{seam}{other}");
        assert_eq!(missed(&format!("{seam}{other}"), &whole), ["source/outermost"], "{name}");
        assert_eq!(missed(&other, &whole), [""; 0], "{name}");
        // A seam line in it makes an outline of a cut, and lines that others stand before are theirs.
        let inner = rectangle(1200, 1200, 10_400, 6400);
        assert_eq!(missed(&format!("{seam}{inner}"), &format!("{outline}{seam}{inner}")), [""; 0], "{name}");
    }
}

#[test]
fn a_rectangle_around_one_cut_is_no_frame_for_the_sake_of_a_closed_line_beside_it() {
    let part = rectangle(400, 400, 24_000, 12_000);
    let [one, other] = [rectangle(1200, 1200, 8000, 8000), rectangle(12_000, 1200, 8000, 8000)];
    assert_eq!(missed(&one, &format!("{part}{one}{other}")), ["source/outermost"]);
    // Beside an outline with a gap it is one, and beside a line in a broken outline.
    let open = "PU12000,1200;PD20000,1200,20000,9200,12000,9200,12000,2000;";
    assert_eq!(missed(&one, &format!("{part}{one}{open}")), [""; 0]);
    let sides =
        "PU11700,900;PD20300,900;PU20400,1000;PD20400,9400;PU20300,9500;PD11700,9500;PU11600,9400;PD11600,1000;";
    assert_eq!(missed(&one, &format!("{part}{one}{other}{sides}")), [""; 0]);
}

#[test]
fn a_slit_at_the_mouth_of_a_notch_is_one_of_its_own_and_a_notch_in_two_strokes_stays_one() {
    let part = rectangle(400, 400, 8000, 4000);
    let slit = "PU3240,400;PD3340,800;";
    for (strokes, notches) in [
        ("PU3000,400;PD3120,640,3240,400;", ["v"]),
        ("PU3240,400;PD3120,640,3000,400;", ["v"]),
        ("PU3000,400;PD3000,600,3240,600,3240,400;", ["castle"]),
    ] {
        for text in [format!("{part}{strokes}{slit}"), format!("{slit}{strokes}{part}")] {
            let (marker, codes) = found(&text, &Job::default());
            let words: Vec<&str> = marker.pieces[0].outline_notches.iter().map(OutlineNotch::word).collect();
            assert_eq!((&words[..], marker.pieces[0].notches.len(), codes), (&notches[..], 1, vec![]), "{text}");
        }
    }
    for strokes in [
        "PU3000,400;PD3000,600,3240,600;PU3240,600;PD3240,400;",
        "PU3000,400;PD3000,600;PU3240,400;PD3240,600,3000,600;",
    ] {
        let (marker, _) = found(&format!("{part}{strokes}"), &Job::default());
        let words: Vec<&str> = marker.pieces[0].outline_notches.iter().map(OutlineNotch::word).collect();
        assert_eq!((&words[..], marker.pieces[0].notches.len()), (&["castle"][..], 0), "{strokes}");
    }
}

#[test]
fn a_line_that_begins_at_the_foot_of_a_notch_is_none_of_it() {
    let part = rectangle(400, 400, 8000, 4000);
    let sides = "PU400,400;PD8400,400;PU8400,400;PD8400,4400;PU8400,4400;PD400,4400;PU400,4400;PD400,400;";
    for (strokes, notch) in [
        ("PU3000,400;PD3120,640,3240,400;", "v"),
        ("PU3000,400;PD3000,600,3240,600,3240,400;", "castle"),
        ("PU3240,400;PD3240,600,3180,660,3060,660,3000,600,3000,400;", "u"),
    ] {
        for line in
            ["PU3000,400;PD3400,3600;", "PU3242,402;PD5000,2600;", "PU3000,400;PD2800,-1000;PU3240,400;PD3400,3600;"]
        {
            for text in [format!("{part}{strokes}{line}"), format!("{line}{sides}{strokes}")] {
                let (marker, codes) = found(&text, &Job::default());
                let words: Vec<&str> = marker.pieces[0].outline_notches.iter().map(OutlineNotch::word).collect();
                assert_eq!((&words[..], codes), (&[notch][..], vec!["drawing/line-from-edge"]), "{text}");
            }
        }
    }
}

/// A job in which lines beside parts guide a worker.
fn guided() -> Job {
    let mut job = Job::default();
    job.profile.drawing.beside = Beside::Guide;
    job
}

#[test]
fn a_part_beside_less_than_half_an_outline_is_refused_unless_somebody_says_what_that_is() {
    let seam = rectangle(800, 800, 6800, 2800);
    let corners = "PU400,1200;PD400,400,1200,400;PU7200,400;PD8000,400,8000,1200;PU8000,3200;PD8000,4000,7200,4000;";
    let sides = "PU400,400;PD400,4000;PU8000,400;PD8000,4000;";
    let mut left_out = Job::default();
    left_out.selection.skip = Numbers::parse("1").ok();
    let other = rectangle(20_400, 400, 8000, 8000);
    for lines in [corners, sides] {
        let text = format!("{seam}{lines}{other}");
        assert_eq!(found(&text, &Job::default()).1, ["drawing/may-be-seam-line"], "{lines}");
        for (job, cut) in [(guided(), &[11_900.0, 40_000.0][..]), (left_out.clone(), &[40_000.0])] {
            let (marker, codes) = found(&text, &job);
            assert_eq!((&areas(&marker)[..], codes), (cut, vec![]), "{lines}");
        }
    }
    // A line along one side is a fold, a grain line or the edge of the cloth.
    for (line, codes) in
        [("PU400,400;PD8000,400;", &["drawing/open-outlines"][..]), ("PU8400,1200;PD8400,3200;", &[""; 0])]
    {
        let (marker, found) = found(&format!("{seam}{line}"), &Job::default());
        assert_eq!((areas(&marker), &found[..]), (vec![11_900.0], codes), "{line}");
    }
}

#[test]
fn a_line_along_one_side_is_refused_where_it_runs_as_far_off_as_other_outlines_do() {
    let other = rectangle(10_000, 400, 7600, 3600) + &rectangle(10_400, 800, 6800, 2800);
    let seam = rectangle(800, 800, 6800, 2800);
    let doubted = ["drawing/may-be-seam-line", "drawing/open-outlines"];
    for (line, codes) in [
        ("PU400,400;PD8000,400;", &doubted[..]),
        ("PU400,160;PD8000,160;", &doubted[1..]),
        ("PU0,400;PD8000,700;", &doubted[1..]),
    ] {
        let (marker, mut found) = found(&format!("{other}{seam}{line}"), &Job::default());
        found.sort_unstable();
        assert_eq!((areas(&marker), &found[..]), (vec![17_100.0, 11_900.0], codes), "{line}");
    }
}

/// What is left of a rectangle of 8400 by 6000 units when so many units of its edge are missing from a place on.
fn remains(x: i64, from: i64, missing: i64) -> String {
    let corners = [[x, 400], [x + 8400, 400], [x + 8400, 6400], [x, 6400]];
    let lengths = [8400, 6000, 8400, 6000];
    let round = 28_800;
    let at = |mut station: i64| {
        station %= round;
        let mut side = 0;
        while station > lengths[side] {
            station -= lengths[side];
            side += 1;
        }
        let ([ax, ay], [bx, by]) = (corners[side], corners[(side + 1) % 4]);
        let way = [(bx - ax).signum(), (by - ay).signum()];
        [ax + way[0] * station, ay + way[1] * station]
    };
    let [first, end] = [from + missing, from + round];
    let stations =
        [0, 8400, 14_400, 22_800].into_iter().flat_map(|corner| [corner, corner + round, corner + 2 * round]);
    let mut inner: Vec<i64> = stations.filter(|station| (first + 1..end).contains(station)).collect();
    inner.sort_unstable();
    let [sx, sy] = at(first);
    inner.iter().chain([&end]).fold(format!("PU{sx},{sy};"), |text, &station| {
        let [x, y] = at(station);
        text + &format!("PD{x},{y};")
    })
}

#[test]
fn no_seam_line_is_cut_for_an_outline_of_which_any_stretch_is_missing() {
    for seed in 0..200 {
        let mut random = fastrand::Rng::with_seed(seed);
        // Three whole parts beside each other, and one that touches them and lacks some of its outline.
        let whole = (0..3).fold(String::new(), |text, i| {
            text + &rectangle(400 + i * 8400, 400, 8400, 6000) + &rectangle(800 + i * 8400, 800, 7600, 5200)
        });
        let seam = rectangle(26_000, 800, 7600, 5200);
        let open = remains(25_600, random.i64(0..28_800), random.i64(100..24_000));
        let mut strokes = [whole, seam, open];
        random.shuffle(&mut strokes);
        let (marker, codes) = found(&strokes.concat(), &Job::default());
        let is_refused = codes.contains(&"drawing/may-be-seam-line");
        assert!(is_refused || areas(&marker) == [31_500.0; 3], "seed {seed}: {codes:?} {}", strokes.concat());
        let is_named = codes.contains(&"drawing/open-part");
        assert!(is_refused || is_named, "seed {seed}: {codes:?}");
    }
}

#[test]
fn a_reader_that_cuts_a_seam_line_in_what_is_left_of_an_outline_is_caught() {
    for seed in 0..50 {
        let mut random = fastrand::Rng::with_seed(seed);
        let open = remains(25_600, random.i64(0..28_800), random.i64(100..4000));
        let (seam, other) = (rectangle(26_000, 800, 7600, 5200), rectangle(400, 400, 8400, 6000));
        let text = format!("{seam}{other}");
        assert_eq!(missed(&text, &format!("{text}{open}")), ["source/outermost"], "seed {seed}");
    }
}

#[test]
fn lines_between_two_parts_are_named_by_both() {
    let parts = rectangle(400, 400, 4000, 4000) + &rectangle(8400, 400, 4000, 4000);
    let one = source(format!("IN;SP1;{parts}PU4400,2000;PD8400,2000;PU4400,2400;PD6000,2500,8400,2400;PU;"));
    let mut told = Diagnostics::default();
    cutc::pipeline::marker_of(by_name("hpgl").expect("a dialect"), &one, &Job::default(), &mut told);
    let told: Vec<_> = told.iter().map(|said| (said.code.name, said.pieces.to_vec())).collect();
    assert_eq!(told, [("drawing/line-from-edge", vec![1, 2])]);
}

#[test]
fn a_line_between_strokes_of_an_outline_is_refused_until_somebody_says_what_it_is() {
    let strokes = "PU0,0;PD4000,0;PU4000,0;PD8000,0,8000,4000,4000,4000;PU4000,4000;PD0,4000,0,0;PU4000,0;PD4000,4000;";
    let codes = |job: &Job| {
        let source = source(format!("IN;SP1;{strokes}PU;SP0;"));
        let mut said = Diagnostics::default();
        pipeline::marker_of(by_name("hpgl").expect("a dialect"), &source, job, &mut said);
        said.iter().map(|diagnostic| diagnostic.code.name).collect::<Vec<_>>()
    };
    assert_eq!(codes(&Job::default()), ["drawing/shared-edge"]);
    let lines = |inner, all| Job { lines: Lines { inner, all, ..Lines::default() }, ..Job::default() };
    assert_eq!(codes(&lines(Some(Inner::Ignore), false)), ["drawing/divided-part"]);
    assert_eq!(codes(&lines(None, true)), [""; 0]);
}

#[test]
fn an_outline_that_is_not_cut_has_a_band_in_the_picture() {
    let seam = rectangle(800, 800, 11_200, 7200);
    let sound = rectangle(20_400, 400, 12_000, 12_000);
    let open = "PU2400,400;PD12400,400,12400,8400,400,8400,400,400;".to_owned();
    for (name, outline) in broken_outlines().into_iter().chain([("a gap", open)]) {
        let room = Room::with("a.plt", &format!("IN;SP1;{outline}{seam}{sound}PU;SP0;"));
        let said = room.says("compile a.plt -t svg", 0);
        assert!(said.contains("drawing/open-part"), "{name}: {said}");
        let picture = room.text("a.svg");
        assert_eq!(picture.matches("class=\"doubt\"").count(), 1, "{name}");
        assert_eq!(picture.matches("class=\"doubt-sign\"").count(), 1, "{name}");
        let is_broken = picture.contains("broken outline: ");
        assert!(is_broken != picture.contains("open outline: "), "{name}");
    }
}
