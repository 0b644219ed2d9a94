//! The report of a page: places, options, limits and lengths that it tells.

use cutc::geom::{Point, polyline};
use cutc::ir::toolpath::Pose;
use serde_json::Value;

use crate::player::{GAP, Page, between, table};
use crate::support::room::{DONE, FAULTY, Room};

/// A part with a bend of 15 degrees, at X 100, amid its lower edge.
const BEND: &str = "H1*G71*N1*X0Y0*M14*X1000Y0*X2000Y268*X2000Y2000*X0Y2000*X0Y0*M15*M0*";
/// A square with a name.
const NAMED: &str = "H1*G71*N1*X0Y0*M14*X400Y0*X400Y400*X0Y400*X0Y0*M15*X100Y100*M31*COLLAR*\
                     N2*X600Y0*M14*X1000Y0*X1000Y400*X600Y400*X600Y0*M15*M0*";

/// Declarations of a program.
fn declared(room: &Room, program: &str) -> Vec<Value> {
    let meta: Value = serde_json::from_str(&room.text(&format!("{program}.meta.json"))).expect("JSON");
    meta["declared"].as_array().expect("a list").clone()
}

/// Place of the tip in the rows of a program at which the heel of the default blade is farthest from the bend, and how far.
fn farthest(rows: &str) -> (Point, f64) {
    let bend = [[0.0, 0.0], [100.0, 0.0], [200.0, 26.8]].map(Point::from);
    let ends = |row: &str| {
        let cells: Vec<f64> = row.split(',').map(|cell| cell.parse().expect("a number")).collect();
        let pose = Pose::new(cells[1], cells[2], cells[3].to_radians());
        (cells[4] == 1.0).then(|| [pose.ahead(0.25), pose.ahead(-6.35)])
    };
    let rows = rows.lines().skip(1).filter_map(ends);
    let near = rows.filter(|[tip, _]| (90.0..130.0).contains(&tip.x) && tip.y < 40.0);
    let off = near.map(|[tip, heel]| (tip, polyline::distance(heel, &bend)));
    off.reduce(|worst, next| if next.1 > worst.1 { next } else { worst }).expect("rows at the bend")
}

/// Cell of the facts of a page by the name of its row.
fn fact(page: &str, name: &str) -> String {
    between(page, &format!("<th scope=\"row\">{name}</th>\n<td>"), "</td>").to_owned()
}

#[test]
fn a_declared_deviation_stands_where_it_is_greatest() {
    let room = Room::with("bend.cut", BEND);
    let said = room.says("compile bend.cut -t csv,html", DONE);
    assert!(said.contains("1 swing at a bend, at most 1.17 mm (piece 1 at 102, 0)"), "{said}");
    let [swing] = &declared(&room, "bend.csv")[..] else { panic!("one deviation") };
    assert_eq!(swing["from_mm"], 0.0);
    // The rows have it as large, in the waste beside the square.
    let (tip, off) = farthest(&room.text("bend.csv"));
    let number = |value: &Value| value.as_f64().expect("mm");
    assert!((number(&swing["seen_mm"]) - off).abs() < 0.01 && swing.get("within").is_none(), "{off}: {swing}");
    let at = [0, 1].map(|axis| number(&swing["at_mm"][axis]));
    assert!((at[0] - tip.x).hypot(at[1] - tip.y) < 0.5, "{tip:?}: {swing}");
    let page = Page::of(&room, "bend.html");
    assert_eq!(page.facts["declared"], serde_json::json!([at]));
    let place = format!("data-x=\"{:.3}\" data-y=\"{:.3}\"", at[0], at[1]);
    assert!(between(&page.text, "id=\"deviations\"", "</section>").contains(&place), "{place}");
    // The end of a blade that is longer than its cut is where the warning has it.
    room.write("gap.cut", GAP.as_bytes());
    let output = room.command("compile gap.cut -t csv --format json").output().expect("it starts");
    let report: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let warned: Vec<&Value> = report["warnings"].as_array().expect("a list").iter().collect();
    let surplus = declared(&room, "gap.csv");
    assert_eq!((surplus.len(), warned.len()), (4, 4));
    for entry in &surplus {
        let is_there = |other: &&&Value| {
            let [x, y] = ["x_mm", "y_mm"].map(|key| number(&other[key]));
            (x - number(&entry["at_mm"][0])).hypot(y - number(&entry["at_mm"][1])) < 0.01
        };
        assert_eq!(warned.iter().filter(is_there).count(), 1, "{entry}");
    }
}

#[test]
fn options_that_change_what_is_cut_stand_in_the_job() {
    let room = Room::with("named.cut", NAMED);
    room.says("compile named.cut -t html --skip 2 --dry-run", DONE);
    let page = room.text("named.html");
    assert_eq!(fact(&page, "Options"), "--skip 2 --dry-run");
    let head = between(&page, "<header>", "</header>");
    assert!(head.contains(">dry run: nothing is cut</p>") && !page.contains(">Cut in all<"), "{head}");
    room.says("compile named.cut -t html --force", DONE);
    let page = room.text("named.html");
    assert!(!page.contains(">Options</th>") && !page.contains(": nothing is cut</p>"));
}

#[test]
fn limits_of_the_report_are_those_of_the_profile() {
    let room = Room::with("named.cut", NAMED);
    room.says("compile named.cut -t html", DONE);
    let page = room.text("named.html");
    let findings = table(&page, "findings");
    let of = |rule: &str| findings.iter().find(|row| row[0].1 == rule).expect("a row");
    for (rule, limit) in [("verify/jerk-x", 200_000.0), ("verify/acceleration-c", 20_000.0), ("verify/speed-y", 1200.0)]
    {
        assert_eq!(of(rule)[3].0, Some(limit), "{rule}");
    }
    // Rows are rounded: a jerk may be above its limit by that, and is not broken.
    let jerk = of("verify/jerk-x");
    let (worst, share) = (jerk[2].0.expect("a jerk"), jerk[4].0.expect("a share"));
    assert!((share - worst / 2040.0).abs() < 1e-3 && worst > 200_000.0 && jerk[1].1 == "holds", "{jerk:?}");
    assert_eq!(jerk[3].1, "200000 mm/s3 and 4000 mm/s3 of rounding");
    assert!(!of("verify/speed-y")[3].1.contains("rounding"));
}

#[test]
fn lengths_of_a_page_say_what_they_hold() {
    let room = Room::with("named.cut", NAMED);
    room.says("compile named.cut -t html", DONE);
    let page = room.text("named.html");
    assert_eq!(fact(&page, "Lines to cut"), "0.320 m as they are drawn");
    assert_eq!(fact(&page, "Extent of the pieces"), "100.0 x 40.0 mm");
    let all = fact(&page, "Cut in all");
    let (cut, overlaps) = all.split_once(" m, of it overlaps past ends ").expect("both");
    let [cut, overlaps] = [cut, overlaps.trim_end_matches(" m")].map(|metres| metres.parse::<f64>().expect("m"));
    assert!(overlaps > 0.001 && (cut - overlaps - 0.320).abs() < 2e-3, "{all}");
    // The tip goes all of that but for the blade's own width at each plunge.
    let tip = &table(&page, "spent")[0][3];
    let plunges: f64 = fact(&page, "Plunges").parse().expect("a number");
    let off = tip.0.expect("mm") - (1000.0 * cut - 6.6 * plunges);
    assert!(tip.1.ends_with(" m of the tip") && off.abs() < 1.0, "{tip:?}, {off}");
}

#[test]
fn a_piece_has_one_name_and_hints_follow_their_messages() {
    let room = Room::with("gap.cut", &GAP.replace("M15*N2*", "M15*X300Y200*M31*COLLAR*N2*"));
    room.says("compile gap.cut -t html", DONE);
    let page = Page::of(&room, "gap.html");
    assert_eq!([0, 1].map(|piece| page.facts["pieces"][piece]["title"].clone()), ["piece 1 \"COLLAR\"", "piece 2"]);
    let messages = between(&page.text, "id=\"messages\"", "</section>");
    assert_eq!(page.facts["warned"].as_array().map(Vec::len), Some(4));
    assert!(messages.contains("<span class=\"quiet\">piece 1 &quot;COLLAR&quot;</span>"), "{messages}");
    assert!(messages.find("</ol>").expect("a list") < messages.find("class=\"hint\"").expect("a hint"), "{messages}");
    let deviations = table(&page.text, "deviations");
    assert!(!deviations.is_empty() && deviations.iter().all(|row| row[1].1 == "piece 1 &quot;COLLAR&quot;"));
    // The labels of a piece that windows split are in its last section.
    room.write("split.cut", b"H1*G71*N1*X0Y0*M14*X6000Y0*X6000Y3000*X0Y3000*X0Y0*M15*X5000Y100*M31*TOP*M0*");
    room.says("compile split.cut -t html --set bite.length_mm=400", DONE);
    let page = Page::of(&room, "split.html");
    assert_eq!([0, 1].map(|section| page.facts["pieces"][section]["title"].clone()), ["piece 1 \"TOP\""; 2]);
    assert_eq!(page.facts["window_mm"], 400.0);
}

#[test]
fn a_page_beside_g_code_has_the_time_of_its_controller() {
    let room = Room::with("named.cut", NAMED);
    let said = room.says("compile named.cut -t gcode,html --rate 36/h", DONE);
    let page = room.text("named.html");
    let time = fact(&page, "Time on the controller");
    let of_controller = between(&time, "about ", " by LinuxCNC's planner, ");
    let seconds: f64 = of_controller.trim_end_matches(" s").parse().expect("seconds");
    assert!(said.contains("controller about"), "{said}");
    assert!(between(&page, "<header>", "</header>").contains(&format!("about {of_controller} on the controller")));
    // A hundredth a second.
    let cost: f64 = fact(&page, "Cost").split_once(' ').expect("words").0.parse().expect("money");
    assert!((cost - seconds / 100.0).abs() < 0.01, "{cost} for {seconds} s");
    assert_ne!(fact(&page, "Time as played here"), of_controller);
    room.says("compile named.cut -t html --force", DONE);
    let page = room.text("named.html");
    assert!(!page.contains("on the controller") && fact(&page, "Time").ends_with(" s"));
}

#[test]
fn a_page_of_a_plot_says_what_is_not_cut() {
    let room = Room::with(
        "seam.plt",
        "IN;SP1;PU0,0;PD4000,0,4000,4000,0,4000,0,0;PU400,400;PD3600,400,3600,3600,400,3600,400,400;PU;",
    );
    room.says("compile seam.plt -t html", DONE);
    let page = room.text("seam.html");
    let head = between(&page, "<header>", "</header>");
    assert!(head.contains("; 1 line (0.32 m) not cut"), "{head}");
    let rows: Vec<Vec<String>> =
        table(&page, "lines").iter().map(|row| row.iter().map(|cell| cell.1.clone()).collect()).collect();
    assert_eq!(
        (&rows[0][..3], &rows[1][..3]),
        (&["part", "cut", "1"].map(String::from)[..], &["seam line", "not cut", "1"].map(String::from)[..])
    );
    // A cut file says itself what is cut.
    room.write("named.cut", NAMED.as_bytes());
    room.says("compile named.cut -t html", DONE);
    assert!(!room.text("named.html").contains("id=\"lines\""));
}

#[test]
fn the_messages_of_a_piece_open_in_its_row() {
    let room = Room::with("gap.cut", GAP);
    room.says("compile gap.cut -t html", DONE);
    let page = room.text("gap.html");
    let pieces = between(&page, "<section id=\"pieces\">", "</section>");
    let lists: Vec<&str> = pieces.split("<details>").skip(1).map(|list| between(list, "", "</details>")).collect();
    let counts: Vec<usize> = lists.iter().map(|list| list.matches("<li>").count()).collect();
    // Two of the four are about both pieces.
    assert_eq!(counts, [4, 2], "{pieces}");
    for (list, count) in lists.iter().zip(counts) {
        assert!(list.starts_with(&format!("<summary>{count}</summary>")) && list.contains("path/overcut"), "{list}");
    }
}

#[test]
fn an_overview_tells_the_errors_of_a_file_and_the_costs() {
    let room = Room::new();
    std::fs::create_dir(room.at("in")).expect("writable");
    room.write("in/named.cut", NAMED.as_bytes());
    room.write(
        "in/short.cut",
        b"H1*G71*N1*X0Y0*M14*X400Y0*X4O0Y400*X0Y0*M15*N2*X0Y600*M14*X400Y6a0*X200Y800*X0Y600*M15*M0*",
    );
    room.says("compile in -o out/ -t html,csv --rate 36/h --plies 2", FAULTY);
    let page = room.text("out/index.html");
    let rows: Vec<&str> = page.split("<tr").skip(2).collect();
    assert!(rows[0].contains("block 7: ") && rows[0].matches("<li>").count() == 1, "{}", rows[0]);
    assert!(rows[1].contains("data-name=\"Cost\" data-value=\"0.0"), "{}", rows[1]);
    assert!(between(&page, "<header>", "</header>").contains(" for 2 plies: "));
    room.says("compile in -o out/ -t html,csv --force", FAULTY);
    assert!(!room.text("out/index.html").contains("Cost"));
}
