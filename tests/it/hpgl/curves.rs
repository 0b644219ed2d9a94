//! Arcs: circles in the numbers of the file, whatever its scale makes of them.

use cutc::geom::Point;
use cutc::ir::Marker;
use cutc::machine::Job;
use cutc::machine::plot::Lines;

use super::audit::audit;
use super::{as_drawn, as_read, read, source};

#[test]
fn arcs_through_places_on_a_line_are_lines_whatever_the_scale() {
    let mut random = fastrand::Rng::with_seed(3);
    for _ in 0..2000 {
        let corners = [(); 2].map(|()| random.i32(3000..9000));
        let range = random.i32(7..500);
        let (x, y) = (f64::from(range) * 0.1, f64::from(range) * 0.3);
        let (way, rise) = (f64::from(random.i32(1..9)) / 10.0, f64::from(random.i32(-9..9)) / 10.0);
        let at = |k: i32| format!("{:.1},{:.1}", x + way * f64::from(k), y + rise * f64::from(k));
        let (from, middle, to) = (random.i32(-3..3), random.i32(-9..9), random.i32(3..9));
        let text = format!(
            "IN;IP0,0,{},{};SC0,{range},0,{range};PU{};PD;AT{},{};PA0,0,{};PU;",
            corners[0],
            corners[1],
            at(from),
            at(middle),
            at(to),
            at(from)
        );
        let source = source(text.clone());
        let job = Job { lines: Lines { all: true, ..Lines::default() }, ..Job::default() };
        let marker = as_read(&source, &job);
        assert!(marker.pieces.iter().flat_map(|p| &p.contours).all(|c| marker.points(c).len() <= 4), "{text}");
        assert_eq!(audit(&source, &marker, &job), [], "{text}");
    }
}

#[test]
fn a_mirrored_scale_gives_the_mirror_image_curves_and_all() {
    let drawing = "SP1;PU20,20;PD100,20;AA100,60,180;AR0,10,-90;PD20,100,20,20;PU40,60;EW10,0,90;PU80,60;EW10,30,-200;\
                   PU60,40;AT70,50,60,60;PD60,40;PU150,150;CI20;PU;";
    let job = as_drawn();
    let plain = source(format!("IN;IP0,0,8000,8000;SC0,200,0,200;{drawing}"));
    let whole = read(&plain, &job).0;
    for (scale, is_turned) in [("0,200,200,0", false), ("200,0,0,200", true)] {
        let mirrored = source(format!("IN;IP0,0,8000,8000;SC{scale};{drawing}"));
        let marker = read(&mirrored, &job).0;
        assert_eq!(audit(&mirrored, &as_read(&mirrored, &job), &job), []);
        let points =
            |marker: &Marker| -> Vec<Point> { marker.contours().flat_map(|(_, c)| marker.points(c)).collect() };
        let (points, mirrored) = (points(&whole), points(&marker));
        assert_eq!(points.len(), mirrored.len());
        let image = |p: &Point| if is_turned { Point::new(200.0 - p.x, p.y) } else { Point::new(p.x, 200.0 - p.y) };
        assert!(points.iter().zip(&mirrored).all(|(p, q)| (image(p) - q).norm() < 1e-9), "{scale}");
    }
}

/// An arc in the numbers of the file.
struct Arc {
    drawn: &'static str,
    /// Where it starts and ends, and a place on the way.
    from: [f64; 2],
    by: [f64; 2],
    to: [f64; 2],
}

/// Around this place with this radius.
const CENTRE: [f64; 2] = [50.0, 40.0];
const RADIUS: f64 = 10.0;
/// How near the middle of a chord must come to a place on the arc, mm: the chords are shorter, and the arc by the other way
/// stays farther away.
const NEAR: f64 = 3.0;

const ARCS: [Arc; 8] = [
    Arc { drawn: "PU60,40;PD;AA50,40,180;PU;", from: [60.0, 40.0], by: [50.0, 50.0], to: [40.0, 40.0] },
    Arc { drawn: "PU60,40;PD;AR-10,0,-180;PU;", from: [60.0, 40.0], by: [50.0, 30.0], to: [40.0, 40.0] },
    Arc { drawn: "PU60,40;PD;AT50,50,50,30;PU;", from: [60.0, 40.0], by: [40.0, 40.0], to: [50.0, 30.0] },
    Arc { drawn: "PU60,40;PD;RT-10,-10,-10,10;PU;", from: [60.0, 40.0], by: [40.0, 40.0], to: [50.0, 50.0] },
    Arc { drawn: "PU60,40;PD;AT40,40,60,40;PU;", from: [60.0, 40.0], by: [40.0, 40.0], to: [60.0, 40.0] },
    Arc { drawn: "PU50,40;CI10;PU;", from: [60.0, 40.0], by: [40.0, 40.0], to: [60.0, 40.0] },
    Arc { drawn: "PU50,40;EW10,90,180;PU;", from: [50.0, 50.0], by: [40.0, 40.0], to: [50.0, 30.0] },
    Arc { drawn: "PU60,40;PM0;PD;AA50,40,180;PM2;EP;PU;", from: [60.0, 40.0], by: [50.0, 50.0], to: [40.0, 40.0] },
];

/// A scale of two factors, and what it makes of places, mm before the page is turned.
struct Scaling {
    scale: &'static str,
    offset: [f64; 2],
    factor: [f64; 2],
}

/// 8000 by 4000 units for a hundred, or factors.
const SCALINGS: [Scaling; 5] = [
    Scaling { scale: "SC0,100,0,100;", offset: [0.0, 0.0], factor: [2.0, 1.0] },
    Scaling { scale: "SC100,0,0,100;", offset: [200.0, 0.0], factor: [-2.0, 1.0] },
    Scaling { scale: "SC0,100,100,0;", offset: [0.0, 100.0], factor: [2.0, -1.0] },
    Scaling { scale: "SC100,0,100,0;", offset: [200.0, 100.0], factor: [-2.0, -1.0] },
    Scaling { scale: "SC0,4,0,120,2;", offset: [0.0, 0.0], factor: [0.1, 3.0] },
];

#[test]
fn arcs_are_ellipses_where_the_two_axes_are_scaled_differently() {
    let job = Job { lines: Lines { all: true, ..Lines::default() }, ..Job::default() };
    let sagitta = job.profile.tolerance(job.profile.hpgl.unit.mm()) / 4.0;
    for (&Arc { drawn, from, by, to }, Scaling { scale, offset, factor }, degrees) in combinations() {
        let text = format!("IN;PS8000,4000;RO{degrees};IP0,0,8000,4000;{scale}SP1;{drawn}SP0;");
        let source = source(text.clone());
        let marker = as_read(&source, &job);
        assert_eq!(audit(&source, &marker, &job), [], "{text}");
        let unturned = |p: Point| match degrees {
            90 => Point::new(p.y, 200.0 - p.x),
            180 => Point::new(200.0 - p.x, 100.0 - p.y),
            270 => Point::new(100.0 - p.y, p.x),
            _ => p,
        };
        let place = |[x, y]: [f64; 2]| Point::new(offset[0] + factor[0] * x, offset[1] + factor[1] * y);
        let seen = |p: Point| {
            let p = unturned(p);
            [(p.x - offset[0]) / factor[0] - CENTRE[0], (p.y - offset[1]) / factor[1] - CENTRE[1]]
        };
        let is_on = |p: &Point| (seen(*p)[0].hypot(seen(*p)[1]) - RADIUS).abs() < 1e-9;
        let contour = *marker.contours().next().expect("a line").1;
        let on: Vec<Point> = marker.points(&contour).into_iter().filter(is_on).collect();
        let is_at = |p: Point, q: [f64; 2]| (unturned(p) - place(q)).norm() < 1e-9;
        assert!(is_at(on[0], from), "{text}: {:?}", on[0]);
        assert!(on.iter().skip(1).any(|&p| is_at(p, to)), "{text}");
        assert!(on.len() > 20, "{text}");
        // The farthest place of an ellipse from its chord is where the angle between the ends is halved.
        let mut nearest = f64::INFINITY;
        for pair in on.windows(2) {
            let [a, b] = [seen(pair[0]), seen(pair[1])];
            let middle = [f64::midpoint(a[0], b[0]), f64::midpoint(a[1], b[1])];
            let height = middle[0].hypot(middle[1]);
            if height < 0.9 * RADIUS {
                continue; // the line that closes a polygon
            }
            let half = middle.map(|v| v / height * RADIUS);
            let half = place([CENTRE[0] + half[0], CENTRE[1] + half[1]]);
            let (way, bow) = (unturned(pair[1]) - unturned(pair[0]), half - unturned(pair[0]));
            let off = (way.x * bow.y - way.y * bow.x).abs() / way.norm();
            assert!(off <= sagitta + 1e-9, "{text}: {off}");
            nearest = nearest.min((half - place(by)).norm()).min((unturned(pair[0]) - place(by)).norm());
        }
        // It goes by way of the place, and not the other way round.
        assert!(nearest < NEAR, "{text}: {nearest}");
    }
}

fn combinations() -> impl Iterator<Item = (&'static Arc, &'static Scaling, u32)> {
    let pairs = ARCS.iter().flat_map(|arc| SCALINGS.iter().map(move |scaling| (arc, scaling)));
    pairs.flat_map(|(arc, scaling)| [0, 90, 180, 270].map(move |degrees| (arc, scaling, degrees)))
}

#[test]
fn a_polygon_that_is_drawn_twice_may_lack_twice_as_much() {
    let text = "IN;SP1;PU0,0;PM0;PD;AA4000,0,180;PD8000,4000,0,4000;PM2;EP;EP;EP;PU;SP0;";
    let job = Job { lines: Lines { all: true, ..Lines::default() }, ..Job::default() };
    assert_eq!(audit(&source(text), &as_read(&source(text), &job), &job), []);
}
