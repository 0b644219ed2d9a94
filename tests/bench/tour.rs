//! Orders points as the pass `route` orders visits, for `tests/bench/tours.py`: reads a point a line, `x y`, and writes how long
//! ordering them took, s, then their places in the tour, one a line:
//! `cargo run --release --features bench --example tour < points.txt`.

#[path = "../../src/pass/marker/route/near.rs"]
mod near;
#[path = "../../src/pass/marker/route/sequence.rs"]
mod sequence;
#[path = "../../src/pass/marker/route/tour.rs"]
mod tour;

use std::io::{self, BufWriter, Write};
use std::time::Instant;

use cutc::geom;
use geom::Point;
use sequence::{START, Ways};

fn main() -> io::Result<()> {
    let point = |line: io::Result<String>| {
        let line = line?;
        let numbers: Result<Vec<f64>, _> = line.split_whitespace().map(str::parse).collect();
        match numbers.as_deref() {
            Ok(&[x, y]) => Ok(Point::new(x, y)),
            Ok(_) | Err(_) => Err(io::Error::new(io::ErrorKind::InvalidData, format!("`{line}` is no point"))),
        }
    };
    let points: Vec<Point> = io::stdin().lines().map(point).collect::<io::Result<_>>()?;
    let start = Instant::now();
    let order = toured(&points);
    let took = start.elapsed().as_secs_f64();
    let mut out = BufWriter::new(io::stdout().lock());
    writeln!(out, "{took:.3}")?;
    order.iter().try_for_each(|visit| writeln!(out, "{visit}"))?;
    out.flush()
}

/// The tour from the origin through points, from strips on as the pass begins with.
fn toured(points: &[Point]) -> Vec<usize> {
    let count = points.len();
    let [width, height] = [0, 1].map(|axis| points.iter().fold(0.0, |most: f64, point| most.max(point[axis])));
    let strip = (2.0 * (width * height / count.max(1) as f64).sqrt()).max(1.0);
    let key = |&i: &usize| {
        let strip = (points[i].x / strip).floor();
        (strip, if strip % 2.0 == 0.0 { points[i].y } else { -points[i].y })
    };
    let mut order: Vec<usize> = (0..count).collect();
    order.sort_by(|a, b| {
        let ((a, up), (b, other)) = (key(a), key(b));
        a.total_cmp(&b).then(up.total_cmp(&other))
    });
    let near = near::near(&points.iter().map(|&point| [point; 2]).collect::<Vec<_>>());
    let time =
        |from: usize, to: usize| (points[to] - if from == START { Point::origin() } else { points[from] }).norm();
    let (before, along) = (vec![Vec::new(); count], vec![0.0; count]);
    let ways = Ways { time: &time, near: &near, before: &before, along: &along, window: None };
    tour::improve(&mut order, &ways, Some(1));
    order
}
