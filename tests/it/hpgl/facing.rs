//! Notches of two parts at one place of their common edge, notches on edges that are drawn twice, and slits that an outline begins
//! or ends with.

use std::fmt::Write as _;

use cutc::ir::Marker;
use cutc::ir::marker::OutlineNotch;
use cutc::machine::Job;

use super::closing::found;
use super::rectangle;
use crate::support::room::{DONE, Room};

/// The words of all notches, sorted.
fn words(marker: &Marker) -> Vec<&'static str> {
    let mut words: Vec<_> =
        marker.pieces.iter().flat_map(|piece| &piece.outline_notches).map(OutlineNotch::word).collect();
    words.sort_unstable();
    words
}

/// A plot becomes a program that is proven.
fn compiles(plot: &str) {
    let room = Room::with("plot.plt", &format!("IN;SP1;{plot}PU;SP0;"));
    room.says("compile plot.plt", DONE);
}

/// Strokes of a notch about (4400, y), to the right or to the left, in units.
fn stroke(word: &str, y: i64, away: i64) -> String {
    let x = 4400 + away.signum() * (away.abs() - 1);
    let deep = |by: i64| x + away.signum() * by;
    match word {
        "v" => format!("PU{x},{};PD{},{y},{x},{};", y - 80, deep(200), y + 80),
        "castle" => {
            let [low, high] = [y - 80, y + 80];
            format!("PU{x},{low};PD{},{low},{},{high},{x},{high};", deep(200), deep(200))
        }
        _ => {
            let mut text = format!("PU{x},{};PD{},{}", y - 80, deep(120), y - 80);
            for k in 1..=8 {
                let angle = std::f64::consts::PI * f64::from(k) / 8.0;
                let [out, up] = [80.0 * angle.sin(), -80.0 * angle.cos()].map(|by| by.round() as i64);
                _ = write!(text, ",{},{}", deep(120 + out), y + up);
            }
            text + &format!(",{x},{};", y + 80)
        }
    }
}

#[test]
fn notches_of_both_parts_at_one_place_of_their_common_edge_are_two() {
    for one in ["v", "castle", "u"] {
        for other in ["v", "castle", "u"] {
            // Edges to the bit, and some units apart.
            for gap in [1, 2, 3] {
                let parts = rectangle(400, 400, 4000 - (gap - 1), 4000) + &rectangle(4400 + gap - 1, 400, 4000, 4000);
                let strokes = stroke(one, 2000, -gap) + &stroke(other, 2000, gap);
                for text in [format!("{parts}{strokes}"), format!("{strokes}{parts}")] {
                    let (marker, codes) = found(&text, &Job::default());
                    let mut both = vec![one, other];
                    both.sort_unstable();
                    assert_eq!((words(&marker), codes), (both, vec![]), "gap {gap}: {text}");
                    assert!(marker.pieces.iter().all(|piece| piece.outline_notches.len() == 1), "gap {gap}: {text}");
                }
            }
        }
    }
    compiles(
        &(rectangle(400, 400, 4000, 4000)
            + &rectangle(4400, 400, 4000, 4000)
            + &stroke("v", 2000, -1)
            + &stroke("u", 2000, 1)),
    );
    // Where no edge is, two strokes make a closed line.
    let (marker, codes) =
        found(&(rectangle(400, 400, 8000, 4000) + &stroke("v", 2000, -1) + &stroke("v", 2000, 1)), &Job::default());
    assert_eq!((words(&marker), codes), (vec![], vec!["drawing/inner-lines"]));
}

#[test]
fn notches_on_an_edge_that_is_drawn_twice_are_all_kept() {
    let ring = "8000,400,8000,4400,400,4400,400,400";
    let notch = |k: i64| 1600 + 1600 * k;
    let notches: Vec<String> =
        (0..4).map(notch).map(|x| format!("PU{x},400;PD{},640,{},400;", x + 120, x + 240)).collect();
    let notches = notches.concat();
    for (outline, code) in [
        (format!("PU400,400;PD{ring},{ring};"), "marker/round-again"),
        (format!("PU400,400;PD{ring},7000,400;"), "marker/overrun"),
    ] {
        let text = format!("{outline}{notches}");
        let (marker, codes) = found(&text, &Job::default());
        assert_eq!((words(&marker), codes), (vec!["v"; 4], vec![code]), "{text}");
        compiles(&text);
    }
    // The outline is lifted at the mouth, and the edge over that is drawn by itself.
    let text = "PU1600,400;PD400,400,400,4400,8000,4400,8000,400,1840,400;PU1600,400;PD1720,640,1840,400;PU1600,400;PD1840,400;";
    let (marker, codes) = found(text, &Job::default());
    assert_eq!((words(&marker), codes), (vec!["v"], vec![]));
    compiles(text);
}

#[test]
fn an_outline_that_begins_or_ends_at_the_tip_of_a_slit_is_whole() {
    let ring = [[4000, 400], [8000, 400], [8000, 4400], [400, 4400], [400, 400], [4000, 400]];
    let tip = [4000, 640];
    let line = |places: &[[i64; 2]]| {
        let all: Vec<String> = places.iter().map(|[x, y]| format!("{x},{y}")).collect();
        format!("PU{};PD{};", all[0], all[1..].join(","))
    };
    let first: Vec<[i64; 2]> = [tip].into_iter().chain(ring).collect();
    let last: Vec<[i64; 2]> = ring.into_iter().chain([tip]).collect();
    let other = rectangle(10_000, 400, 4000, 4000);
    for text in [line(&first), line(&last), line(&first) + &other, line(&last) + &other] {
        let (marker, codes) = found(&text, &Job::default());
        assert_eq!((marker.pieces[0].notches.len(), codes), (1, vec![]), "{text}");
        assert_eq!(marker.pieces.len(), 1 + usize::from(text.contains("10000")));
        compiles(&text);
    }
}
