//! Twins: one part as a cut file, with its notches in the outline, and as a plot, where they are strokes of their own. Both
//! give the same notches.

use std::fmt::Write as _;

use cutc::diagnostic::Diagnostics;
use cutc::front::by_name;
use cutc::ir::Marker;
use cutc::machine::Job;
use cutc::pipeline;
use cutc::source::Source;

/// A place in tenths of a millimetre.
type Place = [i64; 2];

/// Plotter units in a tenth of a millimetre.
const PLOT_UNITS: i64 = 4;
/// Side of the part, and from corner to corner of the seats of its notches, tenths of a millimetre.
const SIDE: i64 = 4000;
const SEAT: i64 = 500;

/// A notch of a form about the start of an edge: along it, and into the part.
fn form(random: &mut fastrand::Rng) -> Vec<Place> {
    let (half, depth) = (random.i64(15..50), random.i64(30..80));
    match random.u8(..4) {
        0 => vec![[-half, 0], [0, depth], [half, 0]],
        1 => vec![[-half, 0], [-half, depth], [half, depth], [half, 0]],
        2 => vec![[0, 0], [0, depth]],
        _ => {
            let step = |k: i64| {
                let angle = std::f64::consts::PI * k as f64 / 6.0;
                let [along, into] = [-angle.cos(), angle.sin()].map(|share| (share * half as f64).round() as i64);
                [along, depth - half.min(depth) + into]
            };
            let bottom = (0..=6).map(step).filter(|place| place[1] > 0);
            [[-half, 0]].into_iter().chain(bottom).chain([[half, 0]]).collect()
        }
    }
}

/// The corners of a square, each with the direction of the edge that it begins.
const EDGES: [(Place, Place); 4] =
    [([0, 0], [1, 0]), ([SIDE, 0], [0, 1]), ([SIDE, SIDE], [-1, 0]), ([0, SIDE], [0, -1])];

/// Places of a notch on an edge, `along` from its corner.
fn placed(([x, y], [dx, dy]): (Place, Place), along: i64, form: &[Place]) -> Vec<Place> {
    form.iter().map(|&[a, into]| [x + dx * (along + a) - dy * into, y + dy * (along + a) + dx * into]).collect()
}

/// The cut file and the plot of a part with notches.
fn twins(random: &mut fastrand::Rng) -> [String; 2] {
    let (mut cut, mut strokes) = (String::from("H1*G71*N1*M15*X0Y0*M14*"), String::new());
    for (i, edge) in EDGES.into_iter().enumerate() {
        for seat in (1..SIDE / SEAT).filter(|_| random.bool()).collect::<Vec<_>>() {
            let form = form(random);
            let places = placed(edge, seat * SEAT, &form);
            let mut drawn = places.clone();
            if drawn.len() == 2 {
                // A slit comes back to the edge.
                drawn.push(drawn[0]);
            }
            for [x, y] in drawn {
                write!(cut, "X{x}Y{y}*").expect("a text takes all");
            }
            let mut plotted: Vec<String> =
                places.iter().map(|p| format!("{},{}", p[0] * PLOT_UNITS, p[1] * PLOT_UNITS)).collect();
            if random.bool() {
                plotted.reverse();
            }
            write!(strokes, "PU{};PD{};", plotted[0], plotted[1..].join(",")).expect("a text takes all");
        }
        let [x, y] = EDGES[(i + 1) % EDGES.len()].0;
        write!(cut, "X{x}Y{y}*").expect("a text takes all");
    }
    let side = SIDE * PLOT_UNITS;
    [cut + "M15*M0*", format!("IN;SP1;PU0,0;PD{side},0,{side},{side},0,{side},0,0;{strokes}PU;SP0;")]
}

/// Kind, depth and root of a notch, in tenths of a millimetre.
type Row = (&'static str, i64, Place);

/// Whether two notches are the same but for a unit of the cut file.
fn are_alike(a: &Row, b: &Row) -> bool {
    let is_near = |a: i64, b: i64| (a - b).abs() <= 1;
    a.0 == b.0 && is_near(a.1, b.1) && is_near(a.2[0], b.2[0]) && is_near(a.2[1], b.2[1])
}

/// The notches of a file, by kind and seat.
fn notches(dialect: &str, text: String) -> Vec<Row> {
    let source = Source::new("twin", text.into_bytes()).expect("small");
    let mut found = Diagnostics::default();
    let input = pipeline::read(&source, by_name(dialect), &Job::default(), &mut found).expect("it is read");
    let codes: Vec<_> = found.iter().map(|said| said.code.name).collect();
    assert!(codes.is_empty(), "{dialect}: {codes:?}");
    let marker: Marker = input.marker;
    let piece = &marker.pieces[0];
    assert_eq!((marker.pieces.len(), piece.contours.len()), (1, 1), "{dialect}");
    let tenths = |mm: f64| (mm * 10.0).round() as i64;
    let slits = piece.notches.iter().map(|notch| ("slit", notch.depth(), notch.root));
    let others = piece.outline_notches.iter().map(|notch| (notch.word(), notch.depth(), notch.root()));
    let mut all: Vec<_> = slits
        .chain(others)
        .map(|(word, depth, root)| (word, tenths(depth), [tenths(root.x), tenths(root.y)]))
        .collect();
    let on_grid = |tenths: i64| (tenths + SEAT / 2) / SEAT;
    all.sort_unstable_by_key(|(word, _, [x, y])| (*word, on_grid(*x), on_grid(*y)));
    all
}

#[test]
fn a_part_as_a_plot_and_as_a_cut_file_has_the_same_notches() {
    let mut random = fastrand::Rng::with_seed(44);
    let mut seen = std::collections::BTreeMap::new();
    for case in 0..200 {
        let [cut, plot] = twins(&mut random);
        let expected = notches("iso", cut.clone());
        let found = notches("hpgl", plot.clone());
        let is_same = found.len() == expected.len() && found.iter().zip(&expected).all(|(a, b)| are_alike(a, b));
        assert!(is_same, "case {case}\n{found:?}\n{expected:?}\n{cut}\n{plot}");
        for notch in expected {
            *seen.entry(notch.0).or_insert(0) += 1;
        }
    }
    for word in ["slit", "v", "castle", "u"] {
        assert!(seen.get(word).is_some_and(|count| *count > 300), "{seen:?}");
    }
}
