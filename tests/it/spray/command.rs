//! Heads and other tools on the command line.

use cutc::machine::{Job, load};

use crate::support::nests::compiled;
use crate::support::room::{DONE, FAULTY, Room, USAGE};

fn room() -> Room {
    let room = Room::new();
    for name in ["spray/panel.csv", "machines/spray.toml"] {
        let path = format!("{}/fixtures/{name}", env!("CARGO_MANIFEST_DIR"));
        room.write(name.rsplit('/').next().expect("a name"), &std::fs::read(path).expect("a fixture"));
    }
    room
}

#[test]
fn one_command_compiles_by_either_planner_and_another_judges_it() {
    let room = room();
    let (_, said) = room.expect("compile panel.csv -p spray.toml --planner quintic -t csv -o quintic.csv", DONE);
    for line in ["  edge      length      time   deviation", "planner quintic", "pieces   condition", "rules hold"] {
        assert!(said.contains(line), "{line}: {said}");
    }
    let (_, said) = room.expect("compile panel.csv -p spray.toml -t csv -o optimal.csv", DONE);
    assert!(said.contains("planner optimal") && !said.contains("condition"), "{said}");
    let (told, _) = room.expect("verify optimal.csv --source panel.csv -p spray.toml", DONE);
    assert!(told.contains("spray-verify/edge-speed") && told.contains("PASS"), "{told}");
    let (told, _) =
        room.expect("verify optimal.csv --source panel.csv -p spray.toml --set tool.edge_speed_mm_s=200", FAULTY);
    assert!(told.contains("FAIL"), "{told}");
    room.expect("compile panel.csv -p spray.toml --planner cubic", USAGE);
}

#[test]
fn figures_of_each_edge_come_as_json_with_the_coefficients() {
    let room = room();
    let (json, _) = room.expect("compile panel.csv -p spray.toml --planner quintic --format json -o quintic.csv", DONE);
    let figures: serde_json::Value = serde_json::from_str(&json).expect("JSON");
    let edges = figures["edges"].as_array().expect("a list");
    assert_eq!(edges.len(), 4);
    for edge in edges {
        let pieces = edge["pieces"].as_array().expect("a list");
        assert!(edge["deviation_mm"].as_f64().is_some_and(|off| off <= 0.05));
        assert!(pieces.iter().all(|piece| piece["coefficients"].as_array().is_some_and(|terms| terms.len() == 6)));
    }
}

#[test]
fn a_tool_without_a_blade_follows_lines_as_a_point_does() {
    let cut = String::from_utf8(Room::new().read("circle.cut")).expect("text");
    let job = |sets: &[&str]| {
        let sets: Vec<String> = sets.iter().map(ToString::to_string).collect();
        Job { profile: load(None, &sets).expect("a legal profile"), ..Job::default() }
    };
    let point = job(&[
        "knife.width_mm=0",
        "knife.radius_mm=0",
        "knife.front_overlap_mm=0",
        "knife.corner_front_overlap_mm=0",
        "knife.heel_overlap_mm=0",
        "knife.corner_heel_overlap_mm=0",
    ]);
    let expected = compiled(&cut, "csv", &point).expect("a program").1;
    for kind in ["wheel", "pen", "router"] {
        let (found, program) = compiled(&cut, "csv", &job(&[&format!("tool.kind={kind}")])).expect("a program");
        assert_eq!(program, expected, "{kind}");
        assert!(found.verdict.is_some_and(|verdict| verdict.passes()));
    }
    let odd = load(None, &["tool.kind=wheel".to_owned(), "knife.width_mm=6".to_owned()]).expect_err("a contradiction");
    let said: Vec<&str> = odd.arguments.iter().map(|fault| fault.message.as_str()).collect();
    assert_eq!(
        said,
        ["--set knife.width_mm=6: `tool.kind` is \"wheel\", which has no blade, but `knife.width_mm` is given"]
    );
}

#[test]
fn tools_without_a_blade_follow_real_markers_within_the_limits_and_without_overlaps() {
    for name in ["iso/seed-circle.cut", "iso/spaced-corner-lifts.cut", "iso/slit-in-the-contour.cut", "hpgl/arcs.plt"] {
        let source = super::fixture(name);
        for kind in ["wheel", "pen", "router"] {
            let sets = [format!("tool.kind={kind}")];
            let job = Job { profile: load(None, &sets).expect("a legal profile"), ..Job::default() };
            let (made, ..) =
                super::compiled(&source, "csv", &job).unwrap_or_else(|said| panic!("{name} {kind}: {said}"));
            let verdict = made.verdict.expect("a verdict");
            assert!(verdict.passes() && verdict.findings.len() > 20, "{name} {kind}");
            // What is cut beyond a line would be an overlap.
            let stray = verdict.findings.iter().find(|finding| finding.rule.name == "verify/stray");
            assert!(stray.is_none_or(|finding| finding.worst < 0.1), "{name} {kind}: {stray:?}");
        }
    }
}
