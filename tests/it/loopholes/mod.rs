//! Programs made by hand to slip through the verifier: each does a harm that the rules of the cut must see, and keeps the
//! limits of the machine, so that nothing else refuses it.

mod meetings;
mod nibbles;
mod overlaps;
mod program;

use std::f64::consts::TAU;

use cutc::geom::{Heading, Vector};
use cutc::ir::Marker;
use cutc::ir::declaration::{Declaration, Kind, Which};
use cutc::ir::marker::{Drill, Event, Notch, NotchKind};
use cutc::ir::toolpath;
use cutc::machine::Job;
use cutc::pipeline::Declared;
use cutc::source::Span;
use cutc::verify;

use crate::loopholes::program::{Outputs, Program, broken, check, circle, p};

use crate::support;

/// A line of 100 mm along X.
fn long_line() -> Marker {
    support::marker(&[p(100.0, 50.0), p(200.0, 50.0)])
}

/// The whole of it in one stroke.
fn cut_long_line(program: &mut Program) {
    program.run(p(99.5, 50.0), p(200.8, 50.0), 1);
}

#[test]
fn what_is_done_by_hand_and_well_is_accepted() {
    let mut program = Program::new(&Job::default());
    cut_long_line(&mut program);
    check(program, &long_line(), &[]);
    // Lifted amid the line and rejoined with overlap: not as the compiler does it, but sound.
    let mut program = Program::new(&Job::default());
    program.run(p(99.5, 50.0), p(150.0, 50.0), 1);
    program.run(p(149.0, 50.0), p(200.8, 50.0), 1);
    check(program, &long_line(), &[]);
    // A line shorter than the blade in one plunge, with overlaps at both ends.
    let mut program = Program::new(&Job::default());
    program.plunge_cut(p(105.8, 50.0), 0.0, 1);
    check(program, &support::marker(&[p(100.0, 50.0), p(105.0, 50.0)]), &[]);
}

#[test]
fn a_plunge_cut_across_a_line_is_no_cut_of_it() {
    for heading in [5.0, 10.0, 20.0, 45.0, 90.0] {
        let mut program = Program::new(&Job::default());
        let along = Heading::new(f64::to_radians(heading)).unit();
        program.plunge_cut(p(150.0, 50.0) + along * 6.0, heading, 1);
        cut_long_line(&mut program);
        assert!(!program.judge(&long_line()).passes(), "{heading}");
    }
}

#[test]
fn a_plunge_cut_across_a_line_that_is_cut_but_for_a_little_is_no_cut_of_it() {
    for heading in [5.0, 10.0, 20.0] {
        let mut program = Program::new(&Job::default());
        program.run(p(99.5, 50.0), p(150.0, 50.0), 1);
        let along = Heading::new(f64::to_radians(heading)).unit();
        program.plunge_cut(p(150.1, 50.0) + along * 3.0, heading, 1);
        program.run(p(150.05, 50.0), p(200.8, 50.0), 1);
        assert!(!program.judge(&long_line()).passes(), "{heading}");
    }
}

#[test]
fn a_blade_that_cuts_the_last_bit_of_a_line_and_much_beyond_it_is_astray() {
    let mut program = Program::new(&Job::default());
    program.run(p(99.5, 50.0), p(199.7, 50.0), 1);
    program.plunge_cut(p(199.65 + 6.6, 50.0), 0.0, 1);
    check(program, &long_line(), &["verify/stray", "verify/declared"]);
}

#[test]
fn an_overcut_at_the_wrong_end_is_refused_though_it_is_declared() {
    let corners = [p(100.0, 0.0), p(200.0, 0.0), p(200.0, 100.0), p(100.0, 100.0), p(100.0, 0.0)];
    for i in 0..30 {
        // From the edge inwards; behind the mouth is waste, beyond the tip the part.
        let (x, depth) = (120.0 + f64::from(i), 1.0 + 0.16 * f64::from(i));
        let mut marker = support::marker(&corners);
        let (root, tip) = (p(x, 100.0), p(x, 100.0 - depth));
        let span = Span { block: 11, ..Span::default() };
        marker.pieces[0].notches = vec![Notch { kind: NotchKind::Slit, root, tip, percent: 100, span }];
        let cut = |beyond: f64| {
            let mut program = Program::new(&Job::default());
            program.plunge_cut(tip - Vector::new(0.0, beyond), -90.0, 11);
            let surplus = 6.6 - depth;
            program.declared = Some(Declared::new(vec![Declaration {
                kind: Kind::Surplus,
                cut: 0,
                from_mm: 0.0,
                to_mm: depth,
                end: Some(Which::End),
                part: Some(0),
                magnitude_mm: surplus,
                at_mm: [0.0; 2],
                seen_mm: None,
                within: None,
            }]));
            broken(&program.judge(&marker))
        };
        assert!(cut(6.6 - depth).contains(&"verify/overcut-part"), "{depth}: {:?}", cut(6.6 - depth));
        assert!(!cut(0.0).contains(&"verify/overcut-part"), "{depth}: {:?}", cut(0.0));
    }
}

#[test]
fn a_short_line_is_not_cut_by_many_plunge_cuts() {
    let marker = support::marker(&[p(100.0, 50.0), p(106.0, 50.0)]);
    let mut program = Program::new(&Job::default());
    for i in 0..60 {
        program.plunge_cut(p(101.0 + 0.1 * f64::from(i), 50.0), 0.0, 1);
    }
    assert!(!program.judge(&marker).passes());
}

#[test]
fn little_by_little_a_line_is_cut_twice_all_the_same() {
    let mut program = Program::new(&Job::default());
    for i in 0..20 {
        let start = 99.5 + f64::from(i);
        program.run(p(start, 50.0), p(start + 8.0, 50.0), 1);
    }
    program.run(p(127.0, 50.0), p(200.8, 50.0), 1);
    assert!(!program.judge(&long_line()).passes());
    let mut program = Program::new(&Job::default());
    program.run(p(99.5, 50.0), p(120.0, 50.0), 1);
    for i in 0..20 {
        // Each goes on by a tenth and cuts again 1.2 mm of what was cut, by a blade that stands beside what is left.
        let end = 120.1 + 0.1 * f64::from(i);
        program.run(p(end - 6.61, 50.0), p(end, 50.0), 1);
    }
    program.run(p(121.9, 50.0), p(200.8, 50.0), 1);
    assert!(!program.judge(&long_line()).passes());
}

#[test]
fn a_circle_is_not_cut_as_a_polygon() {
    let marker = circle(8.0);
    // Nor where C has to begin elsewhere to go round it in one.
    for range_deg in [None, Some([-200.0, 200.0])] {
        let mut job = Job::default();
        job.profile.c.range_deg = range_deg;
        let mut program = Program::new(&job);
        for i in 0..8 {
            let from = TAU * f64::from(i) / 8.0;
            let reach = 2.0 * (3.3_f64 / 8.0).asin();
            let (a, b) = (Heading::new(from).unit() * 8.0, Heading::new(from + reach).unit() * 8.0);
            let along: Vector = (b - a).normalize();
            let tail = p(100.0, 50.0) + a;
            program.plunge_cut(tail + along * 6.6, along.y.atan2(along.x).to_degrees(), (6 * i + 6) as u32);
        }
        let found = broken(&program.judge(&marker));
        assert!(found.contains(&"verify/complete"), "{range_deg:?}: {found:?}");
    }
}

#[test]
fn a_drill_that_is_on_at_the_start_makes_a_hole() {
    let mut program = Program::new(&Job::default());
    program.outputs[0].drill = 1;
    program.rest(300, Outputs { drill: 1, ..Outputs::default() });
    cut_long_line(&mut program);
    check(program, &long_line(), &["verify/drills"]);
}

/// A piece with two holes, a slit and a line.
fn drilled() -> Marker {
    let mut marker = long_line();
    let span = |block| Span { block, ..Span::default() };
    let piece = &mut marker.pieces[0];
    piece.drills = vec![
        Drill { at: p(120.0, 60.0), tool: 1, span: span(11) },
        Drill { at: p(180.0, 60.0), tool: 1, span: span(12) },
    ];
    piece.notches =
        vec![Notch { kind: NotchKind::Slit, root: p(150.0, 50.0), tip: p(150.0, 58.0), percent: 100, span: span(13) }];
    marker
}

#[test]
fn holes_come_in_their_order_and_before_the_cuts_of_their_piece() {
    let slit = |program: &mut Program| program.run(p(150.0, 50.0), p(150.0, 58.0), 13);
    let holes = |program: &mut Program, order: [f64; 2]| order.iter().for_each(|&x| program.drill(p(x, 60.0), 1));
    let mut program = Program::new(&Job::default());
    holes(&mut program, [120.0, 180.0]);
    slit(&mut program);
    cut_long_line(&mut program);
    check(program, &drilled(), &[]);
    let mut program = Program::new(&Job::default());
    holes(&mut program, [180.0, 120.0]);
    slit(&mut program);
    cut_long_line(&mut program);
    check(program, &drilled(), &["verify/order"]);
    let mut program = Program::new(&Job::default());
    slit(&mut program);
    cut_long_line(&mut program);
    holes(&mut program, [120.0, 180.0]);
    check(program, &drilled(), &["verify/order"]);
}

#[test]
fn rows_name_the_block_that_is_cut_and_none_in_the_air() {
    let marker = support::marker(&[p(100.0, 50.0), p(150.0, 50.0), p(200.0, 50.5)]);
    let made = |change: fn(&mut Outputs)| {
        let mut program = Program::new(&Job::default());
        program.plunge(p(106.1, 50.0), 0.0, 1);
        program.go(program.at(p(130.0, 50.0), 0.0), Program::down(1));
        program.outputs.iter_mut().for_each(change);
        let verdict = program.judge(&marker);
        let found = broken(&verdict);
        found.contains(&"verify/block")
    };
    assert!(!made(|_| {}));
    assert!(made(|outputs| outputs.block *= 2), "the block behind it");
    assert!(made(|outputs| outputs.block *= 7), "no block of the marker");
    assert!(made(|outputs| outputs.block = 0), "no block while it cuts");
    assert!(made(|outputs| outputs.block = 1), "a block in the air");
}

#[test]
fn an_event_that_the_marker_does_not_have_is_refused() {
    let mut program = Program::new(&Job::default());
    cut_long_line(&mut program);
    program.rest(1, Outputs { event: 1, ..Outputs::default() });
    check(program, &long_line(), &["verify/events"]);
}

#[test]
fn the_events_of_the_marker_are_told_in_their_turn() {
    let mut marker = drilled();
    let event = |kind, block| Event { kind, span: Span { block, ..Span::default() } };
    marker.pieces[0].events = vec![event(toolpath::Event::Stop, 9), event(toolpath::Event::Advance, 10)];
    marker.closing = vec![event(toolpath::Event::Stop, 20)];
    let made = |numbers: [u8; 3], cut_first: bool| {
        let mut program = Program::new(&Job::default());
        let tell = |program: &mut Program, event: u8| program.rest(1, Outputs { event, ..Outputs::default() });
        let cut = |program: &mut Program| {
            for x in [120.0, 180.0] {
                program.drill(p(x, 60.0), 1);
            }
            program.run(p(150.0, 50.0), p(150.0, 58.0), 13);
            cut_long_line(program);
        };
        if cut_first {
            cut(&mut program);
        }
        numbers[..2].iter().for_each(|&number| tell(&mut program, number));
        if !cut_first {
            cut(&mut program);
        }
        tell(&mut program, numbers[2]);
        program
    };
    check(made([1, 2, 1], false), &marker, &[]);
    check(made([2, 1, 1], false), &marker, &["verify/events"]);
    check(made([1, 2, 0], false), &marker, &["verify/events"]);
    check(made([1, 0, 1], false), &marker, &["verify/events"]);
    check(made([1, 2, 1], true), &marker, &["verify/order"]);
}

#[test]
fn a_blade_that_is_clear_may_be_led_on_but_nothing_happens_before_it_is_up() {
    let mut job = Job::default();
    job.profile.knife.clear_ms = Some(20.0);
    let marker = support::marker(&[p(100.0, 50.0), p(200.0, 50.0)]);
    // Lifted for so long at rest and then led away, or told an event.
    let made = |job: &Job, rest: usize, event: u8| {
        let mut program = Program::new(job);
        program.plunge(p(106.1, 50.0), 0.0, 1);
        program.go(program.at(p(200.8, 50.0), 0.0), Program::down(1));
        program.rest(rest, Outputs::default());
        if event == 0 {
            program.go([0.0; 3], Outputs::default());
        }
        program.rest(1, Outputs { event, ..Outputs::default() });
        program.rest(program.ticks(job.profile.knife.lift_ms), Outputs::default());
        broken(&program.judge(&marker))
    };
    let none: [&str; 0] = [];
    assert_eq!(made(&job, 21, 0), none);
    assert_eq!(made(&job, 10, 0), ["verify/rest"]);
    assert_eq!(made(&Job::default(), 21, 0), ["verify/rest"]);
    assert_eq!(made(&Job::default(), 61, 0), none);
    assert_eq!(made(&job, 59, 1), ["verify/dwell", "verify/events"]);
    assert_eq!(made(&job, 60, 1), ["verify/events"]);
}

#[test]
fn the_limits_of_travel_hold_while_the_knife_is_up_and_those_of_cutting_while_it_is_down() {
    let made = |speed: f64, travel: Option<f64>, to: f64| {
        let mut job = Job::default();
        let axis = &mut job.profile.axes.x;
        (axis.speed_mm_s, axis.travel.speed_mm_s) = (speed, travel);
        let mut program = Program::new(&job);
        program.run(p(99.5, 50.0), p(to + 0.8, 50.0), 1);
        program.judge(&support::marker(&[p(100.0, 50.0), p(to, 50.0)]))
    };
    let none: [&str; 0] = [];
    // A hundred millimetres take 2.2 s by hand: the greatest speed is 15 / 8 of the mean.
    assert_eq!(broken(&made(120.0, None, 200.0)), none);
    assert_eq!(broken(&made(40.0, Some(120.0), 108.0)), none);
    assert_eq!(broken(&made(40.0, None, 108.0)), ["verify/speed-x"]);
    assert_eq!(broken(&made(120.0, Some(40.0), 108.0)), ["verify/speed-x"]);
    let verdict = made(40.0, Some(120.0), 200.0);
    assert_eq!(broken(&verdict), ["verify/speed-x"]);
    let finding = verdict.broken().next().expect("one is broken");
    assert!(finding.worst > 70.0 && finding.limit.is_some_and(|limit| (40.0..41.0).contains(&limit)), "{finding:?}");
}

/// An angle of two lines, with a corner between them; the second one is drawn at half of its speed.
fn angle() -> Marker {
    let mut marker = support::marker(&[p(100.0, 50.0), p(200.0, 50.0), p(200.0, 150.0)]);
    let Marker { list, pieces, .. } = &mut marker;
    let mut cursor = list.cursor(&mut pieces[0].contours[0].range);
    assert!(cursor.advance());
    *cursor.percent_mut() = 50;
    marker
}

#[test]
fn every_part_of_a_line_has_its_own_greatest_speed() {
    let made = |feed: [Option<f64>; 2], before_corner: Option<f64>| {
        let mut job = Job::default();
        job.profile.knife.feed_mm_s = feed[0];
        job.profile.slow.before_corner_mm = before_corner;
        job.profile.slow.before_corner_percent = 40.0;
        let mut marker = angle();
        marker.pieces[0].feed = feed[1];
        let mut program = Program::new(&job);
        program.run(p(99.5, 50.0), p(200.8, 50.0), 1);
        program.run(p(200.0, 49.5), p(200.0, 150.8), 2);
        let verdict = program.judge(&marker);
        let limit = verdict.broken().next().and_then(|finding| finding.limit).map(f64::round);
        (broken(&verdict), limit)
    };
    let feed = vec!["verify/feed"];
    // Each line takes 2.1 s by hand, and its greatest speed is 85 mm/s in its midst.
    assert_eq!(made([Some(200.0), None], None), (vec![], None));
    assert_eq!(made([Some(120.0), None], None), (feed.clone(), Some(60.0)));
    assert_eq!(made([None, Some(120.0)], None), (feed.clone(), Some(60.0)));
    assert_eq!(made([None, None], None), (vec![], None));
    assert_eq!(made([Some(200.0), None], Some(10.0)), (vec![], None));
    // Before the corner less is allowed; where the contour ends, no corner lies ahead.
    assert_eq!(made([Some(172.0), None], Some(60.0)), (feed, Some(69.0)));
}

#[test]
fn a_plunge_cut_askew_is_seen_though_it_stays_in_the_band() {
    for heading in [0.0, 0.4, 0.6, 0.8] {
        let mut program = Program::new(&Job::default());
        // Turned about its middle, so that neither end leaves the tolerance band.
        program.plunge_cut(p(102.5, 50.0) + Heading::new(f64::to_radians(heading)).unit() * 3.3, heading, 1);
        let expected: &[&str] = if heading > 0.5 { &["verify/heading"] } else { &[] };
        let found = broken(&program.judge(&support::marker(&[p(100.0, 50.0), p(105.0, 50.0)])));
        assert_eq!(found, expected, "{heading}");
    }
}

#[test]
fn a_blade_does_not_plunge_askew_to_come_straight_on_its_way() {
    for heading in [0.0, 0.4, 0.6, 1.2] {
        let mut program = Program::new(&Job::default());
        let start = p(106.1, 50.0);
        program.plunge(start, heading, 1);
        let fade = |way: f64| {
            let x = (way / 6.6).min(1.0);
            1.0 - x.powi(4) * (35.0 - x * (84.0 - x * (70.0 - x * 20.0)))
        };
        let poses: Vec<[f64; 3]> = (0..=1000)
            .map(|i| {
                let way = 94.7 * f64::from(i) / 1000.0;
                program.at(start + Vector::new(way, 0.0), heading * fade(way))
            })
            .collect();
        program.along(94.7, Program::down(1), |x| {
            let at = x * 1000.0;
            let i = (at as usize).min(999);
            let part = at - i as f64;
            std::array::from_fn(|axis| poses[i][axis] + (poses[i + 1][axis] - poses[i][axis]) * part)
        });
        program.lift();
        let found = broken(&program.judge(&long_line()));
        assert_eq!(found.contains(&"verify/heading"), heading > 0.5, "{heading}: {found:?}");
    }
}

#[test]
fn a_tip_that_rests_on_a_curve_with_noise_in_its_last_decimal_is_read_from_nearby() {
    let marker = circle(20.0);
    let mut program = Program::new(&Job::default());
    program.plunge(p(120.0, 50.0), 90.0, 1);
    let led = |program: &mut Program, from: f64, to: f64| {
        program.along(300.0, Program::down(1), |x| {
            let turn = from + (to - from) * x;
            let tip = p(100.0, 50.0) + Heading::new(turn).unit() * 20.0;
            let centre = tip - Heading::new(turn + TAU / 4.0).unit() * 0.25;
            [centre.x, centre.y, 90.0 + turn.to_degrees()]
        });
    };
    led(&mut program, 0.0, TAU / 2.0);
    for i in 0..200 {
        program.rest(1, Program::down(24));
        let last = program.poses.len() - 1;
        program.poses[last][0] += if i % 2 == 0 { 1e-6 } else { -1e-6 };
    }
    led(&mut program, TAU / 2.0, TAU + 0.04);
    program.lift();
    let verdict = program.judge(&marker);
    let heading =
        verdict.findings.iter().find(|finding| finding.rule.name == "verify/heading").expect("it is reported");
    assert!(heading.holds(), "{heading:?}");
}

#[test]
fn the_bow_under_a_plunged_blade_is_reported() {
    let arc = |i: i32| p(100.0, 50.0) + Heading::new(TAU * f64::from(i) / 96.0).unit() * 20.0;
    let marker = support::marker(&(0..=24).map(arc).collect::<Vec<_>>());
    let job = Job::default();
    let program = support::program::setpoints(&marker, &job);
    let verdict = verify::setpoints(&mut program.as_slice(), None, &verify::Ground::new(&marker, &job.profile), &job);
    assert!(verdict.passes(), "{:?}", broken(&verdict));
    let body = verdict.findings.iter().find(|finding| finding.rule.name == "verify/body").expect("it is reported");
    // w^2 / 8 R of the plunge is the least; on its way the tail leaves the circle farther.
    assert!(body.worst >= 6.6 * 6.6 / (8.0 * 20.0), "{}", body.worst);
}

#[test]
fn leaps_across_the_world_are_refused() {
    // A search through all that lies between would never end.
    let marker = circle(20.0);
    let mut program = Program::new(&Job::default());
    program.plunge(p(120.0, 50.0), 90.0, 1);
    for i in 0..2000 {
        program.rest(1, Program::down(1));
        let last = program.poses.len() - 1;
        program.poses[last][0] = if i % 2 == 0 { 1e12 } else { 120.0 };
    }
    program.lift();
    assert!(!program.judge(&marker).passes());
}
