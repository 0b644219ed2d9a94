//! Seams inside contours: on the cloth, wherever that is.

use cutc::geom::{Point, polyline, ring};
use cutc::machine::Job;
use cutc::sew::{self, Asked, Element};
use cutc::source::Source;

use super::{fixture, plan_as, target};

/// A closed square of a plot, from a corner, mm.
fn square(at: f64, size: f64) -> String {
    let [a, b] = [at, at + size].map(|mm| (mm * 40.0).round() as i32);
    format!("PU{a},{a};PD{b},{a},{b},{b},{a},{b},{a},{a};")
}

/// The seams of a plot with an inset, or what is said of it.
fn seams(plot: &str, line: Option<&str>, inset: f64) -> Result<Vec<Vec<Point>>, String> {
    let source = Source::new("x.plt", format!("IN;SP1;{plot}SP0;").into_bytes()).expect("small");
    let asked = Asked { line: line.map(str::to_owned), inset, ..Asked::default() };
    let mut out = cutc::diagnostic::Diagnostics::default();
    let program = sew::plan(&source, &asked, &Job::default(), &mut out);
    let program = program.ok_or_else(|| cutc::diagnostic::render(&out, &source))?;
    let mut bytes = Vec::new();
    (target("queue").emit.write)(&program, &Job::default(), &mut bytes).expect("a vector takes bytes");
    Ok(program.pattern.expect("lines").seams.into_iter().map(|seam| seam.points).collect())
}

fn sizes(plot: &str, line: Option<&str>, inset: f64) -> Vec<f64> {
    let seams = seams(plot, line, inset).unwrap_or_else(|said| panic!("{said}"));
    seams.iter().map(|seam| ring::area(seam).abs().sqrt().round()).collect()
}

#[test]
fn the_seam_of_a_cut_out_lies_on_the_cloth_around_it() {
    // A part, a cut-out in it, and a part that lies in the cut-out.
    let plot = [square(0.0, 100.0), square(20.0, 60.0), square(40.0, 20.0)].concat();
    assert_eq!(sizes(&plot, Some("1"), 5.0), [90.0, 70.0, 10.0]);
}

#[test]
fn a_seam_too_near_to_another_contour_of_its_part_is_refused() {
    let plot = [square(0.0, 100.0), square(8.0, 60.0)].concat();
    assert_eq!(sizes(&plot, Some("1"), 4.0), [92.0, 68.0]);
    let said = seams(&plot, Some("1"), 4.1).expect_err("too near");
    assert!(said.contains("sew/inset") && said.contains("too near to another of its part"), "{said}");
}

#[test]
fn notches_are_not_sewn_and_seams_run_straight_past_them() {
    let asked = Asked { inset: 12.0, ..Asked::default() };
    // An inset keeps places amid straight edges; four corners are left.
    let corners = |seam: &[Point]| {
        (1..seam.len())
            .filter(|&k| {
                let next = if k + 1 < seam.len() { seam[k + 1] } else { seam[1] };
                polyline::turn_at(seam[k - 1], seam[k], next).abs() > 0.1
            })
            .count()
    };
    for name in
        ["pattern/notches-of-all-kinds.dxf", "iso/slit-in-the-contour.cut", "iso/slits-behind-their-outline.cut"]
    {
        let (program, said, _) = plan_as(&asked, name, fixture(name), &Job::default());
        let seams = program.unwrap_or_else(|| panic!("{said}")).pattern.expect("lines").seams;
        assert!(seams.iter().all(|seam| corners(&seam.points) == 4), "{name}: {seams:?}");
    }
}

/// A rectangle on a layer of a DXF file.
fn rectangle(layer: &str) -> String {
    let places = [[0, 0], [90, 0], [90, 60], [0, 60]];
    let vertices = places.map(|[x, y]| format!("0\nVERTEX\n10\n{x}\n20\n{y}\n")).concat();
    format!("0\nPOLYLINE\n8\n{layer}\n66\n1\n70\n1\n{vertices}0\nSEQEND\n")
}

fn dxf(entities: &str) -> Vec<u8> {
    format!("0\nSECTION\n2\nENTITIES\n{entities}0\nENDSEC\n0\nEOF\n").into_bytes()
}

#[test]
fn a_seam_line_is_sewn_whether_or_not_an_outline_is_there() {
    for entities in [rectangle("14"), rectangle("1") + &rectangle("14")] {
        for name in ["14", "seam"] {
            let asked = Asked { line: Some(name.to_owned()), ..Asked::default() };
            let (program, said, _) = plan_as(&asked, "x.dxf", dxf(&entities), &Job::default());
            assert_eq!(program.unwrap_or_else(|| panic!("{said}")).pattern.expect("lines").seams.len(), 1);
        }
    }
}

#[test]
fn a_seam_line_of_a_kind_that_is_not_read_is_refused() {
    let asked = Asked { line: Some("14".to_owned()), ..Asked::default() };
    for (layer, is_refused) in [("14", true), ("8", false)] {
        let spline = format!("0\nSPLINE\n8\n{layer}\n10\n5\n20\n5\n");
        let entities = rectangle("1") + &rectangle("14") + &spline;
        let (program, said, out) = plan_as(&asked, "x.dxf", dxf(&entities), &Job::default());
        assert_eq!(out.iter().any(|found| found.code.name == "sew/unread-line"), is_refused, "{said}");
        assert_eq!(program.is_none(), is_refused, "{said}");
    }
}

#[test]
fn a_seam_line_in_a_block_within_a_block_is_refused() {
    let block = |name: &str, entities: &str| format!("0\nBLOCK\n2\n{name}\n10\n0\n20\n0\n{entities}0\nENDBLK\n");
    let piece = rectangle("1") + &rectangle("14") + "0\nINSERT\n2\nSEAM\n10\n0\n20\n0\n";
    let blocks = block("PIECE", &piece) + &block("SEAM", &rectangle("14"));
    let text = format!("0\nSECTION\n2\nBLOCKS\n{blocks}0\nENDSEC\n0\nEOF\n");
    let asked = Asked { line: Some("14".to_owned()), ..Asked::default() };
    let (program, said, _) = plan_as(&asked, "x.dxf", text.into_bytes(), &Job::default());
    assert!(program.is_none() && said.contains("sew/unread-line") && said.contains("INSERT"), "{said}");
}

#[test]
fn layers_that_the_convention_does_not_have_keep_their_names() {
    let entities = rectangle("1") + &rectangle("STITCH") + &rectangle("20") + &rectangle("020").replace("90", "80");
    for (name, count) in [("STITCH", 1), ("20", 1), ("020", 1), ("0", 0)] {
        let asked = Asked { line: Some(name.to_owned()), ..Asked::default() };
        let (program, said, _) = plan_as(&asked, "x.dxf", dxf(&entities), &Job::default());
        let seams = program.map_or(0, |program| program.pattern.expect("lines").seams.len());
        assert_eq!(seams, count, "{name}: {said}");
        assert!(count > 0 || said.contains("its pens or layers are 1, STITCH, 20, 020"), "{said}");
    }
}

#[test]
fn layers_are_sewn_with_the_elements_that_are_named_with_them() {
    let plot = "IN;SP1;PU0,0;PD1600,0;SP2;PU0,400;PD400,400;SP0;";
    let sewn = |line: &str| {
        let asked = Asked { line: Some(line.to_owned()), ..Asked::default() };
        let job = Job::default();
        let (program, said, _) = plan_as(&asked, "x.plt", plot.as_bytes().to_vec(), &job);
        let program = program.ok_or(said)?;
        let bytes = super::written(&program, &job, "queue");
        assert_eq!(super::broken(&program, &[], &job, ("queue", &bytes)), [""; 0]);
        let seams = program.pattern.expect("lines").seams;
        Ok(seams.iter().map(|seam| (seam.element, seam.pitch, seam.points[0].y)).collect::<Vec<_>>())
    };
    let (first, tack) = ((Element::Straight, Some(3.0), 0.0), (Element::BarTack, None, 10.0));
    assert_eq!(sewn("1=pitch 3,2=bar-tack"), Ok(vec![first, tack]));
    // In the order of the names.
    assert_eq!(sewn("2=bar-tack,1=pitch 3"), Ok(vec![tack, first]));
    assert_eq!(sewn("1"), Ok(vec![(Element::Straight, None, 0.0)]));
    for (line, fault) in [
        ("1,2=box-x", "a box has four corners, and this has 2"),
        ("1=bartack", "`bartack` is no element of a pattern"),
        ("1,7=zigzag", "the file has no line `7`"),
    ] {
        let said: Result<Vec<_>, String> = sewn(line);
        assert!(said.as_ref().is_err_and(|said| said.contains(fault)), "{line}: {said:?}");
    }
}
