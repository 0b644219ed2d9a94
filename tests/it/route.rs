//! The order in which pieces are cut: the same pieces, each whole, what lies in a part before it, on a shorter way.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::io::{BufReader, Cursor};

use cutc::back::TARGETS;
use cutc::diagnostic::{Diagnostics, render};
use cutc::geom::{Extent, Point};
use cutc::ir::Marker;
use cutc::ir::list::Segment;
use cutc::ir::marker::{CutKind, Piece};
use cutc::machine::{CommonLines, Job, Lines, OrderPolicy};
use cutc::pipeline::{self, Report};
use cutc::source::Source;
use cutc::verify::{self, Ground};
use fastrand::Rng;

use crate::support::program::setpoints;
use crate::support::with_cuts;

/// Parts in a row of the lay.
const ROW: usize = 5;

/// A lay of parts in no order, as a nesting program writes it: some with a cut-out that is a piece of its own, drawn behind
/// its part or before it, slits in the order in which somebody set them, and two places where something is asked.
fn lay(seed: u64, parts: usize) -> String {
    let mut rng = Rng::with_seed(seed);
    let mut places: Vec<usize> = (0..parts).collect();
    rng.shuffle(&mut places);
    let mut pieces = Vec::new();
    for place in places {
        let [x, y] = [(place / ROW) * 2000, (place % ROW) * 1500];
        let (width, height) = (rng.usize(900..1700), rng.usize(800..1300));
        let mut slits =
            [0, 300, 600].map(|along| format!("X{}Y{y}*M14*X{}Y{}*M15*", x + 100 + along, x + 100 + along, y + 50));
        rng.shuffle(&mut slits);
        let part = format!(
            "M15*{}X{x}Y{y}*M14*X{}Y{y}*X{}Y{}*X{x}Y{}*X{x}Y{y}*M15*",
            slits.concat(),
            x + width,
            x + width,
            y + height,
            y + height
        );
        let cut_out = format!(
            "M15*X{}Y{}*M14*X{}Y{}*X{}Y{}*X{}Y{}*M15*",
            x + 300,
            y + 300,
            x + 500,
            y + 300,
            x + 500,
            y + 600,
            x + 300,
            y + 300
        );
        pieces.push(part);
        if rng.u8(0..3) == 0 {
            let at = pieces.len() - rng.usize(0..2);
            pieces.insert(at, cut_out);
        }
    }
    let mut text = "H1*G71*".to_owned();
    let asked = [pieces.len() / 3, 2 * pieces.len() / 3];
    for (i, piece) in pieces.iter().enumerate() {
        let stop = if asked.contains(&i) { "M01*" } else { "" };
        let _infallible = write!(text, "N{}*{stop}{piece}", i + 1);
    }
    text + "M0*\n"
}

fn job(policy: OrderPolicy) -> Job {
    let mut job = Job::default();
    job.profile.order.policy = policy;
    job
}

fn read(text: &str, job: &Job) -> Marker {
    let source = Source::new("lay.cut", text.as_bytes().to_vec()).expect("small");
    let mut found = Diagnostics::default();
    let input = pipeline::read(&source, None, job, &mut found);
    assert!(!found.has_errors(), "{}", render(&found, &source));
    input.expect("it is read").marker
}

pub(crate) fn compiled(text: &str, job: &Job) -> (Report, Vec<u8>) {
    let source = Source::new("lay.cut", text.as_bytes().to_vec()).expect("small");
    let target = TARGETS.iter().find(|target| target.name == "csv").expect("setpoints are a target");
    let order = pipeline::Order { from: None, target, verify: true };
    let (mut out, mut found) = (Cursor::new(Vec::new()), Diagnostics::default());
    let compiled = pipeline::compile(&source, job, order, &mut out, &mut found).expect("memory takes everything");
    let compiled = compiled.unwrap_or_else(|| panic!("{}", render(&found, &source)));
    assert!(compiled.verdict.is_some_and(|verdict| verdict.passes()));
    (compiled.report, out.into_inner())
}

fn extent(marker: &Marker, piece: usize) -> Extent {
    Extent::of(&marker.points(marker.pieces[piece].contours.last().expect("each has one")))
}

/// What is cut, whatever the order: of each piece its number, slits and lines, without where these start and which way they go.
fn contents(marker: &Marker) -> BTreeMap<u32, BTreeSet<String>> {
    let of_piece = |i: usize| {
        let piece = &marker.pieces[i];
        let slits = piece.notches.iter().map(|notch| format!("slit {:?} {:?}", notch.root, notch.tip));
        let lines = piece.contours.iter().flat_map(|contour| marker.list.walk(contour.range));
        // From whichever end it is cut.
        let lines = lines.map(|(_, Segment { from, to, span, .. })| {
            let [low, high] =
                if from.x.total_cmp(&to.x).then(from.y.total_cmp(&to.y)).is_lt() { [from, to] } else { [to, from] };
            format!("line {low:?} {high:?} {span:?}")
        });
        slits.chain(lines).collect()
    };
    (0..marker.pieces.len()).map(|i| (marker.pieces[i].number, of_piece(i))).collect()
}

#[test]
fn an_order_leaves_every_piece_whole_and_what_lies_in_a_part_before_it() {
    for seed in 0..40 {
        let text = lay(seed, 30);
        let file = read(&text, &job(OrderPolicy::File));
        for policy in [OrderPolicy::Fastest, OrderPolicy::Steady] {
            let job = job(policy);
            let marker = read(&text, &job);
            assert_eq!(contents(&marker), contents(&file), "seed {seed}");
            let extents: Vec<Extent> = (0..marker.pieces.len()).map(|piece| extent(&marker, piece)).collect();
            for (i, inner) in extents.iter().enumerate() {
                let is_held = |outer: &Extent| holds(outer, inner);
                let early = extents[..i].iter().any(|outer| is_held(outer) && outer != inner);
                // Where something is asked between the two the file's order stands.
                assert!(!early || file_has_it_so(&file, &marker, i), "seed {seed}: piece {}", marker.pieces[i].number);
            }
            // What is asked is asked between the same pieces.
            let asked = |marker: &Marker| {
                let mut groups = vec![BTreeSet::new()];
                for piece in &marker.pieces {
                    if !piece.events.is_empty() {
                        groups.push(BTreeSet::new());
                    }
                    groups.last_mut().expect("there is one").insert(piece.number);
                }
                groups
            };
            assert_eq!(asked(&marker), asked(&file), "seed {seed}");
            if policy == OrderPolicy::Steady {
                let mut front = f64::NEG_INFINITY;
                for (piece, extent) in marker.pieces.iter().zip(&extents) {
                    if !piece.events.is_empty() {
                        front = f64::NEG_INFINITY;
                    }
                    assert!(extent.min.x >= front - job.profile.order.window_mm, "seed {seed}: {}", piece.number);
                    front = front.max(extent.min.x);
                }
            }
        }
    }
}

fn holds(outer: &Extent, inner: &Extent) -> bool {
    let mut both = *outer;
    both.join(inner);
    both == *outer
}

/// Whether a piece lies in one that the file has in an earlier group.
fn file_has_it_so(file: &Marker, marker: &Marker, inner: usize) -> bool {
    let group = |number: u32| {
        let at = file.pieces.iter().position(|piece| piece.number == number).expect("it is there");
        file.pieces[..=at].iter().filter(|piece| !piece.events.is_empty()).count()
    };
    let own = extent(marker, inner);
    let holders = (0..inner).filter(|&outer| {
        let outer = extent(marker, outer);
        holds(&outer, &own) && outer != own
    });
    let mut holders = holders.map(|outer| marker.pieces[outer].number);
    holders.all(|outer| group(outer) < group(marker.pieces[inner].number))
}

#[test]
fn an_order_for_the_shortest_travel_is_sound_saves_half_of_it_and_is_always_the_same() {
    let text = lay(7, 30).replace("M01*", "");
    let (file, _) = compiled(&text, &job(OrderPolicy::File));
    let travel = |report: &Report| report.program.travel_m.expect("it is planned");
    for policy in [OrderPolicy::Fastest, OrderPolicy::Steady] {
        let (report, program) = compiled(&text, &job(policy));
        assert!(travel(&report) < 0.5 * travel(&file), "{policy:?}: {} m", travel(&report));
        assert!((report.cut_m - file.cut_m).abs() < 1e-9);
        assert!(report.time_s() < file.time_s());
        for threads in [1, 2] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
            let again = pool.install(|| compiled(&text, &job(policy)).1);
            assert!(again == program, "the same bytes on {threads} threads");
        }
    }
}

/// A pass that orders wrongly is found by the drawing: the order of the marker is no excuse.
#[test]
fn what_lies_in_a_part_is_cut_before_that_whatever_the_marker_says() {
    // A part with a cut-out, a slit and a hole; its cut-out is a piece of its own in the second file.
    let outline = "X0Y0*M14*X1000Y0*X1000Y800*X0Y800*X0Y0*M15*";
    let cut_out = "X400Y300*M14*X600Y300*X600Y500*X400Y300*M15*";
    let neighbour = "N9*X1500Y0*M14*X2500Y0*X2500Y800*X1500Y0*M15*";
    let part = format!("H1*G71*M15*N1*X200Y600*M43*X500Y0*M14*X500Y60*M15*{cut_out}{outline}{neighbour}M0*");
    let in_two = format!("H1*G71*M15*N1*{cut_out}N2*{outline}{neighbour}M0*");
    let job = Job::default();
    let freed = |marker: &Marker| {
        let marker = with_cuts(marker, &job);
        let program = setpoints(&marker, &job);
        let ground = Ground::new(&marker, &job.profile);
        let verdict = verify::setpoints(&mut BufReader::new(&program[..]), None, &ground, &job);
        let value = |rule: &str| {
            let finding = verdict.findings.iter().find(|finding| finding.rule.name == rule);
            finding.expect("it is judged").worst
        };
        assert_eq!(value("verify/order"), 0.0, "{:#?}", verdict.findings);
        value("verify/freed")
    };
    let change = |text: &str, change: &dyn Fn(&mut Vec<Piece>)| {
        let mut marker = read(text, &job);
        change(&mut marker.pieces);
        marker
    };
    assert_eq!(freed(&read(&part, &job)), 0.0);
    assert_eq!(freed(&read(&in_two, &job)), 0.0);
    assert_eq!(freed(&change(&part, &|pieces| pieces[0].contours.reverse())), 1.0);
    assert_eq!(freed(&change(&in_two, &|pieces| pieces.swap(0, 1))), 1.0);
    assert_eq!(freed(&change(&in_two, &|pieces| pieces.swap(0, 2))), 1.0);
    // What lies beside each other has no order.
    assert_eq!(freed(&change(&in_two, &|pieces| pieces.rotate_right(1))), 0.0);
}

/// Rows of parts that touch on all sides, in no order, each third of them with a cut-out that is a piece of its own.
fn touching(seed: u64, parts: usize) -> String {
    let mut rng = Rng::with_seed(seed);
    let mut places: Vec<usize> = (0..parts).collect();
    rng.shuffle(&mut places);
    let mut text = "H1*G71*".to_owned();
    let mut number = 0;
    for place in places {
        let [x, y] = [(place / ROW) * 1600, (place % ROW) * 1000];
        let (right, top) = (x + 1600, y + 1000);
        let mut pieces = vec![format!("X{x}Y{y}*M14*X{right}Y{y}*X{right}Y{top}*X{x}Y{top}*X{x}Y{y}*M15*")];
        if place % 3 == 0 {
            let (x, y) = (x + 600, y + 300);
            let cut_out = format!("X{x}Y{y}*M14*X{}Y{y}*X{}Y{}*X{x}Y{y}*M15*", x + 300, x + 300, y + 300);
            pieces.insert(rng.usize(0..2), cut_out);
        }
        for piece in pieces {
            number += 1;
            let _infallible = write!(text, "N{number}*M15*{piece}");
        }
    }
    text + "M0*\n"
}

#[test]
fn with_common_lines_an_order_saves_time_and_breaks_no_rule() {
    let time = |report: &Report| report.time_s().expect("it is planned");
    for seed in 0..4 {
        let text = touching(seed, 30);
        let (file, _) = compiled(&text, &job(OrderPolicy::File));
        assert!(file.common.as_ref().is_some_and(|common| common.length_m > 2.0), "the parts touch");
        for policy in [OrderPolicy::Fastest, OrderPolicy::Steady] {
            let job = job(policy);
            let (report, program) = compiled(&text, &job);
            assert!(time(&report) < 0.95 * time(&file), "seed {seed}: {} {}", time(&report), time(&file));
            let mut apart = job.clone();
            apart.profile.common.lines = Lines::Word(CommonLines::Off);
            let (apart, _) = compiled(&text, &apart);
            assert!(time(&report) < time(&apart), "seed {seed}: {} {}", time(&report), time(&apart));
            let marker = read(&text, &job);
            assert_eq!(contents(&marker), contents(&read(&text, &self::job(OrderPolicy::File))), "seed {seed}");
            if policy == OrderPolicy::Steady {
                let lefts = (0..marker.pieces.len()).map(|piece| extent(&marker, piece).min.x);
                let mut front = f64::NEG_INFINITY;
                for (left, place) in lefts.zip(0..) {
                    let holds_nothing = extent(&marker, place).size().0 < 100.0;
                    assert!(holds_nothing || left >= front - job.profile.order.window_mm, "seed {seed}: {place}");
                    front = front.max(left);
                }
            }
            for threads in [1, 2] {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
                let again = pool.install(|| compiled(&text, &job).1);
                assert!(again == program, "the same bytes on {threads} threads");
            }
        }
    }
}

/// The points of each line of a file as it writes them, by the number of the piece, tenths of a millimetre.
fn written(text: &str) -> BTreeMap<u32, Vec<Vec<[i64; 2]>>> {
    let place = |block: &str| {
        let (x, y) = block.strip_prefix('X')?.split_once('Y')?;
        Some([x.parse().expect("a number"), y.parse().expect("a number")])
    };
    let line = |up: &str| {
        let points: Vec<[i64; 2]> = up.split('*').filter_map(place).collect();
        (points.len() > 1).then_some(points)
    };
    let piece = |text: &str| {
        let (number, lines) = text.split_once('*').expect("a number has an end");
        (number.parse().expect("a number"), lines.split("M15*").filter_map(line).collect())
    };
    text.split('N').skip(1).map(piece).collect()
}

#[test]
fn the_order_of_the_file_stays_to_the_start_and_direction_of_each_line() {
    for seed in 0..10 {
        for (text, lines) in [
            (lay(seed, 30), CommonLines::Off),
            (touching(seed, 30), CommonLines::Auto),
            (touching(seed, 30), CommonLines::Off),
            (with_small(seed, 40), CommonLines::Auto),
        ] {
            let mut job = job(OrderPolicy::File);
            job.profile.common.lines = Lines::Word(lines);
            let marker = read(&text, &job);
            let written = written(&text);
            for (i, piece) in marker.pieces.iter().enumerate() {
                let tenths = |value: f64| (10.0 * value).round() as i64;
                let place = |at: Point| [tenths(at.x), tenths(at.y)];
                let slits = piece.notches.iter().map(|notch| vec![place(notch.root), place(notch.tip)]);
                let contours =
                    piece.contours.iter().map(|contour| marker.points(contour).into_iter().map(place).collect());
                assert!(
                    slits.chain(contours).eq(written[&piece.number].iter().cloned()),
                    "seed {seed}: piece {}",
                    piece.number
                );
                // What comes before a piece that the file has behind it lies in it.
                let late = marker.pieces[..i].iter().zip(0..).filter(|(other, _)| other.number > piece.number);
                for (other, at) in late {
                    let held = |holder: &usize| holds(&extent(&marker, *holder), &extent(&marker, at));
                    let mut behind = (at + 1..marker.pieces.len()).filter(|&k| marker.pieces[k].number < other.number);
                    assert!(behind.any(|k| held(&k)), "seed {seed}: piece {} before {}", other.number, piece.number);
                }
            }
            let made = with_cuts(&marker, &job);
            assert!(made.cuts.is_sorted_by_key(|cut| cut.piece), "seed {seed}");
            let numbers = |marker: &Marker| marker.pieces.iter().map(|piece| piece.number).collect::<Vec<_>>();
            assert_eq!(numbers(&made), numbers(&marker), "seed {seed}");
        }
    }
}

#[test]
fn a_cut_out_behind_a_part_that_others_share_edges_with_is_found() {
    let text = touching(2, 9);
    let job = job(OrderPolicy::File);
    let freed = |marker: &Marker| {
        let marker = with_cuts(marker, &job);
        let program = setpoints(&marker, &job);
        let ground = Ground::new(&marker, &job.profile);
        let verdict = verify::setpoints(&mut BufReader::new(&program[..]), None, &ground, &job);
        verdict.findings.iter().find(|finding| finding.rule.name == "verify/freed").expect("it is judged").worst
    };
    let mut marker = read(&text, &job);
    assert_eq!(freed(&marker), 0.0);
    // All cut-outs behind all parts, the edges of which are cut with one another.
    marker.pieces.sort_by_key(|piece| {
        let lines = piece.contours.iter().map(|contour| contour.range);
        lines.map(|range| Extent::of(&marker.list.points(range)).size().0 < 100.0).max()
    });
    assert_eq!(freed(&marker), 3.0);
}

/// A lay with a gap of 4 mm in which each third place holds a small piece, in no order.
fn with_small(seed: u64, places: usize) -> String {
    let mut rng = Rng::with_seed(seed);
    let mut order: Vec<usize> = (0..places).collect();
    rng.shuffle(&mut order);
    let mut text = "H1*G71*".to_owned();
    for (place, number) in order.into_iter().zip(1..) {
        let [x, y] = [(place / ROW) * 1640, (place % ROW) * 1040];
        let [width, height] = if place % 3 == 1 { [400, 400] } else { [1600, 1000] };
        let (right, top) = (x + width, y + height);
        let _infallible =
            write!(text, "N{number}*M15*X{x}Y{y}*M14*X{right}Y{y}*X{right}Y{top}*X{x}Y{top}*X{x}Y{y}*M15*");
    }
    text + "M0*\n"
}

/// How many larger pieces come before a small one next to them.
fn freed_before_small(marker: &Marker, window_mm: f64) -> usize {
    let extents: Vec<Extent> = (0..marker.pieces.len()).map(|piece| extent(marker, piece)).collect();
    let is_small = |extent: &Extent| extent.size().0 < 100.0;
    let is_next = |large: &Extent, small: &Extent| {
        let is_ahead = small.min.x > large.min.x + 0.5 * window_mm;
        !is_ahead && large.grown(10.0).meets(small)
    };
    let early = |(i, small): (usize, &Extent)| {
        extents[..i].iter().filter(|large| !is_small(large) && is_next(large, small)).count()
    };
    extents.iter().enumerate().filter(|(_, extent)| is_small(extent)).map(early).sum()
}

#[test]
fn small_pieces_are_cut_before_the_larger_ones_next_to_them_when_the_work_is_steady() {
    let mut freed = [0; 2];
    for seed in 0..10 {
        let text = with_small(seed, 40);
        for lines in [CommonLines::Off, CommonLines::Auto] {
            let mut job = job(OrderPolicy::Steady);
            job.profile.common.lines = Lines::Word(lines);
            let window_mm = job.profile.order.window_mm;
            let marker = read(&text, &job);
            assert_eq!(freed_before_small(&marker, window_mm), 0, "seed {seed}");
            let lefts: Vec<f64> = (0..marker.pieces.len()).map(|piece| extent(&marker, piece).min.x).collect();
            let fronts = lefts.iter().scan(f64::NEG_INFINITY, |front, &left| {
                *front = front.max(left);
                Some(*front)
            });
            assert!(fronts.zip(&lefts).all(|(front, &left)| left >= front - window_mm), "seed {seed}");
            // Without a small one nothing asks for it, nor does another policy.
            job.profile.order.small_mm2 = 0.0;
            freed[0] += freed_before_small(&read(&text, &job), window_mm);
            job.profile.order = cutc::machine::Order { policy: OrderPolicy::Fastest, ..Job::default().profile.order };
            freed[1] += freed_before_small(&read(&text, &job), window_mm);
        }
    }
    assert!(freed.iter().all(|&freed| freed > 20), "{freed:?}");
}

#[test]
fn pieces_end_towards_the_cloth_that_is_still_uncut_when_the_work_is_steady() {
    let mut elsewhere = 0;
    for seed in 0..10 {
        for (text, lines) in [(lay(seed, 30), CommonLines::Off), (touching(seed, 30), CommonLines::Auto)] {
            for policy in [OrderPolicy::Steady, OrderPolicy::Fastest] {
                let mut job = job(policy);
                job.profile.common.lines = Lines::Word(lines);
                let marker = with_cuts(&read(&text, &job), &job);
                for piece in 0..marker.pieces.len() {
                    let front = extent(&marker, piece);
                    let front = front.max.x - front.size().0 / 3.0;
                    let range = marker.range_of(piece as u32);
                    // Behind slits and inner lines; a corner in front there is always, and each end of an edge may be there.
                    let outline =
                        marker.cuts[range].iter().filter(|cut| matches!(cut.kind, CutKind::Outline | CutKind::Edge));
                    let ends: Vec<f64> = outline
                        .map(|cut| *marker.list.points(cut.range).last().expect("a cut has an end"))
                        .map(|end| end.x)
                        .collect();
                    let is_at_front = ends.last().is_none_or(|&end| end >= front);
                    let can_be = ends.iter().any(|&end| end >= front) || ends.len() == 1 && lines == CommonLines::Off;
                    if policy == OrderPolicy::Steady {
                        assert!(is_at_front || !can_be, "seed {seed}: piece {}", marker.pieces[piece].number);
                    } else {
                        elsewhere += usize::from(!is_at_front && can_be);
                    }
                }
            }
        }
    }
    assert!(elsewhere > 100, "{elsewhere}");
}
