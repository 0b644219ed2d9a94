//! What holds of the controller on plants of any kind.

use std::fmt::Write as _;

use cutc::machine::Tracking;
use cutc::track::controller::{Controller, Law, Reading, Status};
use cutc::track::law::{law, overshoot};
use cutc::track::measure::{Measures, measure};
use cutc::track::scenario::{Damage, Edge, Scenario};
use cutc::track::simulate::{compare, run};
use cutc::units::number::fixed;
use fastrand::Rng;

use super::scenario;

/// Plants that are tried.
const PLANTS: usize = 500;

/// The plant of the paper's law without a debounce time: gain, brake, rulers upstream.
fn plant(gain_mm_s: f64, brake: bool, upstream_mm: Option<f64>) -> Tracking {
    Tracking { gain_mm_s, brake, upstream_mm, debounce_ms: 0.0, ..Tracking::default() }
}

/// How well the controller follows a scenario.
fn followed(scenario: &Scenario, track: &Tracking) -> Measures {
    let simulation = run(scenario, track);
    measure(&simulation.followers[0], &simulation.cloth, scenario, track)
}

#[test]
fn each_controller_does_as_well_as_is_said_of_it() {
    let seed = plant(3.0, false, None);
    let brake = plant(6.0, true, None);
    let ahead = plant(6.0, true, Some(400.0));
    let step = |track: &Tracking| followed(&scenario("track/step.toml", track), track);
    for (track, settling) in [(&seed, 0.46), (&brake, 0.34), (&ahead, 0.34)] {
        let measures = step(track);
        assert!(measures.settling_s.is_some_and(|time| time <= settling + 1e-9), "{measures:?}");
        assert_eq!((measures.overshoot_mm, measures.late_reversals), (Some(0.0), 0), "{measures:?}");
    }
    let wander = |name: &str, track: &Tracking| followed(&scenario(name, track), track).worst_mm;
    for (track, slow, fast) in [(&seed, 1.6, 4.1), (&brake, 1.3, 2.9), (&ahead, 0.3, 0.3)] {
        let worst = [wander("track/wander.toml", track), wander("track/wander-fast.toml", track)];
        assert!(worst[0] <= slow && worst[1] <= fast, "{worst:?}");
    }
}

#[test]
fn the_others_do_as_is_said_of_them() {
    let mut all = String::new();
    for name in ["track/step.toml", "track/wander.toml", "track/wander-fast.toml"] {
        let track = plant(3.0, false, None);
        let scenario = scenario(name, &track);
        let simulation = compare(&scenario, &track);
        let _ = writeln!(all, "{name}");
        for follower in &simulation.followers {
            let m = measure(follower, &simulation.cloth, &scenario, &track);
            let settling = m.settling_s.map_or("-".to_owned(), |time| fixed(time, 2));
            let overshoot = m.overshoot_mm.map_or("-".to_owned(), |way| fixed(way, 1));
            let _ = writeln!(
                all,
                "  {}: settling {settling} s, overshoot {overshoot} mm, residual {} mm, worst {} mm",
                follower.name,
                fixed(m.residual_mm, 1),
                fixed(m.worst_mm, 1)
            );
        }
    }
    insta::assert_snapshot!(all);
}

/// A plant of any kind that keeps all conditions.
fn any_plant(rng: &mut Rng) -> Tracking {
    loop {
        let track = Tracking {
            sensors: rng.u32(16..=128),
            pitch_mm: 0.25 + 2.0 * rng.f64(),
            period_ms: f64::from(rng.u8(1..=20)),
            least_speed_mm_s: 5.0 * rng.f64(),
            gain_mm_s: 0.2 + 8.0 * rng.f64(),
            max_speed_mm_s: 20.0 + 400.0 * rng.f64(),
            carriage_acceleration_mm_s2: 100.0 + 4000.0 * rng.f64(),
            latency_ms: 20.0 * rng.f64(),
            lag_ms: 40.0 * rng.f64(),
            brake: rng.bool(),
            debounce_ms: if rng.bool() { 0.0 } else { 40.0 * rng.f64() },
            ..Tracking::default()
        };
        if overshoot(&track).iter().all(|&ratio| ratio <= 1.0) {
            return track;
        }
    }
}

#[test]
fn where_the_conditions_hold_no_plant_swings_and_none_overshoots() {
    let mut rng = Rng::with_seed(27);
    for number in 0..PLANTS {
        let track = any_plant(&mut rng);
        let reach = track.pitch_mm * (f64::from(track.sensors) / 2.0 - 2.0);
        let offset = reach * (2.0 * rng.f64() - 1.0);
        let width = track.width_mm + track.pitch_mm * (rng.f64() - 0.5);
        // Long enough for the slowest of them: the last counts are made good at the least speed, which may be next to none.
        let slowest = law(&track).speeds[1..].iter().copied().fold(f64::INFINITY, f64::min).max(0.2);
        let duration = 10.0 + 4.0 * offset.abs() / slowest.min(track.gain_mm_s + track.least_speed_mm_s);
        let scenario = Scenario { duration, offset: [offset, 0.1], width, ..Scenario::still(&track) };
        let measures = followed(&scenario, &track);
        let case = || format!("plant {number}: {offset} mm, {track:?}: {measures:?}");
        assert!(measures.overshoot_mm.is_some_and(|over| over <= 1.5 * track.pitch_mm), "{}", case());
        assert_eq!(measures.late_reversals, 0, "{}", case());
        assert!(measures.residual_mm <= track.pitch_mm + 0.1, "{}", case());
    }
}

#[test]
fn damage_that_passes_within_the_debounce_time_moves_nothing() {
    let nick = |edge, depth_mm, at_s| Damage { at_s, for_s: 0.05, depth_mm, edge };
    for (edge, depth) in [(Edge::Left, 10.0), (Edge::Right, 10.0), (Edge::Left, -5.0), (Edge::Right, -12.0)] {
        for upstream_mm in [None, Some(400.0)] {
            let track = Tracking { upstream_mm, ..Tracking::default() };
            let damage = (0..10).map(|i| nick(edge, depth, 0.5 + 0.3037 * f64::from(i))).collect();
            let still = Scenario { damage, ..Scenario::still(&track) };
            let simulation = run(&still, &track);
            assert!(simulation.followers[0].places.iter().all(|&place| place == 0.0), "{edge:?} {depth}");
            let seen = simulation.replay.commands.iter().filter(|command| command.status == Status::Waiting).count();
            assert!(seen >= 45, "{seen} samples saw it");
        }
    }
    // The same without it: what is tried does move a carriage.
    let track = Tracking { debounce_ms: 0.0, ..Tracking::default() };
    let still = Scenario { damage: vec![nick(Edge::Left, 10.0, 0.5)], ..Scenario::still(&track) };
    assert!(run(&still, &track).followers[0].places.iter().any(|&place| place > 0.5));
}

#[test]
fn damage_beside_an_edge_that_is_followed_makes_no_jump() {
    // Cloth that drifts is followed a little behind; the nick would call for ten times the speed.
    let track = Tracking::default();
    let drifting = Scenario { drift: 10.0, duration: 3.0, ..Scenario::still(&track) };
    let damage = vec![Damage { at_s: 2.0, for_s: 0.05, depth_mm: 10.0, edge: Edge::Left }];
    let damaged = Scenario { damage, ..drifting.clone() };
    let fastest = |scenario| {
        let commands = run(scenario, &track).replay.commands;
        commands.iter().map(|command| command.velocity.abs()).fold(0.0, f64::max)
    };
    assert_eq!(fastest(&damaged), fastest(&drifting));
}

/// Readings of any kind, lost edges and leaps among them.
fn any_reading(rng: &mut Rng, track: &Tracking) -> Reading {
    let sensors = track.sensors as u16;
    let count = |rng: &mut Rng| if rng.u8(0..8) == 0 { rng.u16(..) } else { rng.u16(0..=sensors) };
    let upstream = rng.bool().then(|| [count(rng), count(rng)]);
    Reading { left: count(rng), right: count(rng), upstream }
}

#[test]
fn two_controllers_that_read_the_same_say_the_same_to_the_bit() {
    let mut rng = Rng::with_seed(3);
    for _ in 0..20 {
        let upstream_mm = rng.bool().then_some(400.0);
        let track = Tracking { upstream_mm, width_range_mm: Some([1490.0, 1510.0]), ..any_plant(&mut rng) };
        // What was made a second time goes by the same numbers.
        let laws: [Law; 2] = [law(&track), law(&track)];
        let mut controllers = [Controller::new(), Controller::default()];
        let mut reading = any_reading(&mut rng, &track);
        for _ in 0..4000 {
            if rng.u8(0..6) == 0 {
                reading = any_reading(&mut rng, &track);
            }
            let [one, other] = [0, 1].map(|i: usize| controllers[i].step(&laws[i], reading));
            assert_eq!((one.status, one.velocity.to_bits()), (other.status, other.velocity.to_bits()));
            assert!(
                one.velocity.abs() <= track.max_speed_mm_s && !(one.velocity == 0.0 && one.velocity.is_sign_negative())
            );
            // A copy goes on as the one it was made of.
            if rng.u8(..) == 0 {
                controllers[1] = controllers[0].clone();
            }
        }
        assert_eq!(controllers[0], controllers[1]);
    }
}

#[test]
fn a_controller_decides_as_the_paper_has_it() {
    let track = Tracking { width_range_mm: Some([1490.0, 1510.0]), ..plant(3.0, false, None) };
    let law = law(&track);
    let said = |left, right| {
        let command = Controller::new().step(&law, Reading { left, right, upstream: None });
        (command.status, command.velocity)
    };
    assert_eq!(said(32, 32), (Status::Centred, 0.0));
    assert_eq!(said(34, 32), (Status::Driving, -7.0));
    assert_eq!(said(22, 42), (Status::Driving, 61.0));
    assert_eq!(said(64, 10), (Status::LostCovered, 0.0));
    assert_eq!(said(10, 64), (Status::LostCovered, 0.0));
    assert_eq!(said(0, 40), (Status::LostOpen, 0.0));
    assert_eq!(said(40, 0), (Status::LostOpen, 0.0));
    // 10 mm wider or narrower than nominal, a count more for the reading.
    assert_eq!([said(37, 38), said(38, 38)].map(|said| said.0), [Status::Driving, Status::Width]);
    assert_eq!([said(27, 26), said(26, 26)].map(|said| said.0), [Status::Driving, Status::Width]);
}

#[test]
fn cloth_that_moved_while_its_edge_was_lost_upstream_is_no_motion_when_it_is_seen_again() {
    let track = Tracking { upstream_mm: Some(400.0), ..Tracking::default() };
    let (law, mut controller) = (law(&track), Controller::new());
    let mut step = |upstream: [u16; 2]| {
        controller.step(&law, Reading { left: 32, right: 32, upstream: Some(upstream) }).velocity.abs()
    };
    let settled = (0..400).map(|_| step([32, 32])).fold(0.0, f64::max);
    // Nothing is seen for a second, in which the cloth moves by 5 mm.
    let lost = (0..100).map(|_| step([0, 32])).fold(0.0, f64::max);
    let found = (0..400).map(|_| step([27, 37])).fold(0.0, f64::max);
    assert_eq!([settled, lost, found], [0.0; 3]);
    // The same motion before the eyes of the rulers is fed forward.
    assert!((0..400).map(|_| step([32, 32])).fold(0.0, f64::max) > 0.0);
}
