//! Drawings with more lines over one another than any lay of parts: they are refused, or it is said what was not looked at,
//! and nothing goes on for ever.

use std::fmt::Write as _;

use cutc::diagnostic::Diagnostics;
use cutc::geom::Extent;
use cutc::ir::Marker;
use cutc::machine::Job;
use cutc::pass::marker::MARKER_PASSES;
use cutc::pipeline;
use cutc::source::Source;

/// The blocks of a closed rectangle, in units of the file.
fn rectangle([left, low, right, high]: [u32; 4]) -> String {
    format!("M15*X{left}Y{low}*M14*X{right}Y{low}*X{right}Y{high}*X{left}Y{high}*X{left}Y{low}*M15*")
}

/// A rectangle that lies deeper in all others with each step, farther than contours that are one edge.
fn nested(depth: u32) -> [u32; 4] {
    let depth = 3 * depth;
    [depth, depth, 30_000 - depth, 30_000 - depth]
}

/// The marker of blocks after all passes, and the codes of what was found: each once.
fn read(blocks: &str) -> (Marker, Vec<&'static str>) {
    let source = Source::new("a.cut", format!("H1*G71*{blocks}M0*").into_bytes()).expect("small");
    let (job, mut found) = (Job::default(), Diagnostics::default());
    let mut marker = pipeline::read(&source, None, &job, &mut found).expect("a cut file").marker;
    for pass in MARKER_PASSES {
        (pass.run)(&mut marker, &job, &mut found);
    }
    let mut codes: Vec<_> = found.iter().map(|finding| finding.code.name).collect();
    codes.dedup();
    (marker, codes)
}

/// Rectangles, each a piece.
fn pieces(rectangles: impl Iterator<Item = [u32; 4]>) -> String {
    let mut blocks = String::new();
    for (corners, number) in rectangles.zip(1..) {
        let _ = write!(blocks, "N{number}*{}", rectangle(corners));
    }
    blocks
}

#[test]
fn pieces_in_one_another_are_cut_from_the_inside_out_or_not_at_all() {
    let (marker, codes) = read(&pieces((0..300).map(nested)));
    assert_eq!(codes, [""; 0]);
    assert!(marker.pieces.iter().map(|piece| piece.number).eq((1..=300).rev()));
    assert_eq!(read(&pieces((0..4000).map(nested))).1.first(), Some(&"marker/too-many-outlines"));
}

/// Rectangles, halved again and again, each some way within that which it is half of: deep ones, and ones beside each other.
fn halved(random: &mut fastrand::Rng, [left, low, right, high]: [u32; 4], all: &mut Vec<[u32; 4]>) {
    all.push([left, low, right, high]);
    if right - left < 200 || high - low < 200 || random.u8(..5) == 0 {
        return;
    }
    let split = random.u32(60..140);
    let halves = if random.bool() {
        [[left + 20, low + 20, left + split - 20, high - 20], [left + split + 20, low + 20, right - 20, high - 20]]
    } else {
        [[left + 20, low + 20, right - 20, low + split - 20], [left + 20, low + split + 20, right - 20, high - 20]]
    };
    for half in halves.into_iter().filter(|half| half[0] + 10 < half[2] && half[1] + 10 < half[3]) {
        halved(random, half, all);
    }
}

#[test]
fn no_piece_comes_behind_one_that_it_lies_in_and_none_is_moved_needlessly() {
    let mut random = fastrand::Rng::with_seed(5);
    for seed in 0..200 {
        let mut all = Vec::new();
        halved(&mut random, [0, 0, 3000, 2000], &mut all);
        random.shuffle(&mut all);
        // Before some the cloth is advanced: they and what comes behind them are a bite of its own.
        let mut bites = Vec::new();
        let mut blocks = String::new();
        for (&corners, number) in all.iter().zip(1..) {
            let is_next = number > 1 && random.u8(..10) == 0;
            bites.push(bites.last().copied().unwrap_or(0) + usize::from(is_next));
            let _ = write!(blocks, "{}N{number}*{}", if is_next { "M69*" } else { "" }, rectangle(corners));
        }
        let (marker, codes) = read(&blocks);
        assert!(!codes.contains(&"marker/too-many-outlines"), "{seed}: {codes:?}");
        let order: Vec<usize> = marker.pieces.iter().map(|piece| piece.number as usize - 1).collect();
        let lies_in = |a: usize, b: usize| {
            let ([left, low, right, high], [l, b, r, h]) = (all[a], all[b]);
            l < left && b < low && right < r && high < h
        };
        assert!(order.iter().map(|&i| bites[i]).is_sorted());
        for (k, piece) in marker.pieces.iter().enumerate() {
            let is_first = k > 0 && bites[order[k - 1]] < bites[order[k]];
            assert_eq!(!piece.events.is_empty(), is_first, "{seed}: before {}", piece.number);
        }
        for (k, &earlier) in order.iter().enumerate() {
            for &later in order[k + 1..].iter().filter(|&&later| bites[later] == bites[earlier]) {
                assert!(!lies_in(later, earlier), "{seed}: {} behind {}", later + 1, earlier + 1);
                // Of two that the file has the other way round one, or what it lies in, waited for the other.
                let waits = |inner: usize| (0..all.len()).any(|part| part <= later && lies_in(inner, part));
                assert!(earlier < later || waits(earlier), "{seed}: {} before {}", earlier + 1, later + 1);
            }
        }
    }
}

#[test]
fn the_same_outline_twice_stays_where_it_is() {
    let square = [100, 100, 900, 900];
    let (marker, codes) = read(&pieces([square, [2000, 0, 3000, 900], square].into_iter()));
    assert!(marker.pieces.iter().map(|piece| piece.number).eq(1..=3));
    assert_eq!(codes, ["marker/contour-twice"]);
}

#[test]
fn contours_in_one_another_are_cut_from_the_inside_out_or_not_at_all() {
    let contours = |count| format!("N1*{}", (0..count).map(nested).map(rectangle).collect::<String>());
    let (marker, codes) = read(&contours(300));
    assert_eq!(codes, [""; 0]);
    let widths = marker.contours().map(|(_, contour)| Extent::of(&marker.points(contour)).size().0);
    assert!(widths.is_sorted());
    assert_eq!(read(&contours(4000)).1.first(), Some(&"marker/too-many-outlines"));
}

/// A ring of so many vertices around a square of 3 m.
fn fine_outline(count: u32) -> String {
    let mut blocks = "M15*".to_owned();
    for i in 0..=count {
        let angle = f64::from(i % count) * std::f64::consts::TAU / f64::from(count);
        let [x, y] = [angle.cos(), angle.sin()].map(|part| (15_000.0 + 25_000.0 * part).round());
        let _ = write!(blocks, "X{x}Y{y}*{}", if i == 0 { "M14*" } else { "" });
    }
    blocks + "M15*"
}

#[test]
fn a_hide_with_thirty_thousand_holes_is_no_crowd() {
    let holes = (0..30_000).map(|k| (150 * (k % 200), 150 * (k / 200))).map(|(x, y)| [x, y, x + 40, y + 40]);
    let outline = fine_outline(15_000);
    let (marker, codes) = read(&format!("N1*{outline}{}", holes.clone().map(rectangle).collect::<String>()));
    assert!(!codes.iter().any(|code| code.starts_with("marker/")), "{codes:?}");
    let last = marker.pieces[0].contours.last().expect("the outline");
    assert_eq!((marker.pieces[0].contours.len(), marker.points(last).len()), (30_001, 15_001));
    // Without numbers each hole is a piece.
    let (marker, codes) = read(&format!("{outline}{}", holes.map(rectangle).collect::<String>()));
    assert!(!codes.iter().any(|code| code.starts_with("marker/")), "{codes:?}");
    assert_eq!(marker.points(&marker.pieces[30_000].contours[0]).len(), 15_001);
}

#[test]
fn open_lines_and_a_far_part_are_no_crowd() {
    let mut blocks =
        pieces((0..20_000).map(|k| (100 * (k % 100), 100 * (k / 100))).map(|(x, y)| [x, y, x + 80, y + 80]));
    for k in 0..150_000 {
        let _ = write!(blocks, "N{}*M15*X{}Y21000*M14*X{}Y21010*M15*", k + 20_001, 10 * (k % 1000), 10 * (k % 1000));
    }
    let _ = write!(blocks, "N200000*{}", rectangle([9_000_000, 0, 9_000_100, 100]));
    let (_, codes) = read(&blocks);
    assert!(!codes.contains(&"marker/too-many-outlines"), "{codes:?}");
}

#[test]
fn what_was_not_looked_at_is_said() {
    let across = (0..2000).map(|k| [0, 2 * k, 4000, 2 * k + 1]);
    let along = (0..2000).map(|k| [2 * k, 0, 2 * k + 1, 4000]);
    let (_, codes) = read(&pieces(across.chain(along)));
    assert!(codes.contains(&"marker/overlapping-pieces") && codes.contains(&"marker/search-ended"), "{codes:?}");
    // Short strokes in the boxes of long edges.
    let mut teeth = "N1*M15*X0Y0*M14*".to_owned();
    for k in 0..5000 {
        let _ = write!(teeth, "X30000Y{}*X0Y{}*", 2 * k + 20_001, 2 * k + 2);
    }
    teeth.push_str("X0Y0*");
    for x in (0..5000).map(|k| 5 * k) {
        let _ = write!(teeth, "M15*X{x}Y15000*M14*X{x}Y15030*M15*");
    }
    let (_, codes) = read(&teeth);
    assert!(codes.contains(&"marker/search-ended"), "{codes:?}");
}
