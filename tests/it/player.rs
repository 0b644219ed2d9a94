//! The page that plays a program: what it may run, that texts stay texts, and that it tells what the setpoints tell.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Output;

use cutc::machine::sha256_hex;
use serde_json::Value;

use crate::support::nests::Recipe;
use crate::support::room::{DONE, FAULTY, Room, USAGE};

/// A square with a slit and a label that is markup, a short line and a drill.
const HOSTILE: &str = "H1*G71*N1*X0Y0*M14*X400Y0*X400Y400*X0Y400*X0Y0*M15*X100Y100*M31*</script><img src=x onerror=alert(1)>*\
                       N2*X600Y0*M14*X640Y0*M15*X600Y200*M43*M0*";
/// Three squares, the last one longer than a window of 400 mm.
const LONG: &str = "H1*G71*N1*X0Y0*M14*X3000Y0*X3000Y3000*X0Y3000*X0Y0*M15*\
                    N2*X3500Y0*M14*X3500Y50*M15*X3100Y0*M14*X6100Y0*X6100Y3000*X3100Y3000*X3100Y0*M15*\
                    N3*X6200Y0*M14*X12200Y0*X12200Y3000*X6200Y3000*X6200Y0*M15*M0*";
/// A V notch over a gap that is narrower than the surplus of the blade.
pub(crate) const GAP: &str = "H1*G71*N1*X0Y0*M14*X290Y0*X300Y50*X310Y0*X600Y0*X600Y400*X0Y400*X0Y0*M15*\
                   N2*X0Y-200*M14*X600Y-200*X600Y-5*X0Y-5*X0Y-200*M15*M0*";
/// Greatest distance of a place of the page from the setpoint, mm and degrees.
const PROMISED: f64 = 0.01;

/// Text between two others.
pub(crate) fn between<'t>(text: &'t str, start: &str, end: &str) -> &'t str {
    let rest = text.split_once(start).unwrap_or_else(|| panic!("no {start}")).1;
    rest.split_once(end).unwrap_or_else(|| panic!("no {end}")).0
}

/// Bytes of base64.
fn unbase64(text: &str) -> Vec<u8> {
    let value = |letter: u8| match letter {
        b'A'..=b'Z' => letter - b'A',
        b'a'..=b'z' => letter - b'a' + 26,
        b'0'..=b'9' => letter - b'0' + 52,
        b'+' => 62,
        b'/' => 63,
        _ => panic!("{letter} is no letter of base64"),
    };
    let letters: Vec<u8> = text.trim().trim_end_matches('=').bytes().map(value).collect();
    let group = |four: &[u8]| {
        let bits = four.iter().fold(0_u32, |bits, &value| bits << 6 | u32::from(value)) << (6 * (4 - four.len()));
        bits.to_be_bytes()[1..four.len()].to_vec()
    };
    letters.chunks(4).flat_map(group).collect()
}

/// A page as its script reads it.
pub(crate) struct Page {
    pub(crate) text: String,
    pub(crate) facts: Value,
    columns: BTreeMap<String, Vec<f64>>,
}

impl Page {
    fn new(text: String) -> Self {
        let facts: Value = serde_json::from_str(between(&text, "id=\"facts\">", "</script>")).expect("JSON");
        let packed = unbase64(between(&text, "id=\"columns\">", "</script>"));
        let bytes = miniz_oxide::inflate::decompress_to_vec_zlib(&packed).expect("deflated");
        let (mut rest, mut columns) = (&bytes[..], BTreeMap::new());
        for column in facts["columns"].as_array().expect("a list") {
            let unit = column[2].as_f64().expect("a unit");
            let mut sum = 0;
            let mut next = || {
                let length = 1 + rest.iter().position(|byte| byte & 0x80 == 0).expect("a last byte");
                let (number, after) = rest.split_at(length);
                rest = after;
                let value = number.iter().rev().fold(0_i64, |value, byte| value << 7 | i64::from(byte & 0x7f));
                sum += (value >> 1) ^ -(value & 1);
                sum as f64 * unit
            };
            let numbers = (0..column[1].as_u64().expect("a length")).map(|_| next()).collect();
            columns.insert(column[0].as_str().expect("a name").to_owned(), numbers);
        }
        assert!(rest.is_empty(), "{} bytes are of no column", rest.len());
        Self { text, facts, columns }
    }

    pub(crate) fn of(room: &Room, name: &str) -> Self {
        Self::new(room.text(name))
    }

    /// X, Y in mm and C in degrees at a tick, by the cubic between the knots about it.
    fn at(&self, tick: f64) -> [f64; 3] {
        let ticks = &self.columns["tick"];
        let i = ticks.partition_point(|&knot| knot <= tick).clamp(1, ticks.len() - 1) - 1;
        let span = ticks[i + 1] - ticks[i];
        let u = (tick - ticks[i]) / span;
        let v = 1.0 - u;
        ["x", "y", "c"].map(|axis| {
            let (place, rate) = (&self.columns[axis], &self.columns[&format!("rate_{axis}")]);
            let places = place[i] * v * v * (1.0 + 2.0 * u) + place[i + 1] * u * u * (1.0 + 2.0 * v);
            places + (rate[i] * v - rate[i + 1] * u) * u * v * span
        })
    }
}

fn rows(csv: &str) -> Vec<Vec<f64>> {
    csv.lines().skip(1).map(|line| line.split(',').map(|field| field.parse().expect("a number")).collect()).collect()
}

#[test]
fn the_page_runs_its_own_script_and_nothing_else() {
    let room = Room::new();
    room.says("compile circle.cut -t html", DONE);
    let page = Page::of(&room, "circle.html").text;
    let policy = between(&page, "http-equiv=\"Content-Security-Policy\" content=\"", "\">");
    let script = page.rsplit_once("<script>").expect("a script").1.split_once("</script>").expect("its end").0;
    for (kind, text) in [("script-src", script), ("style-src", between(&page, "<style>", "</style>"))] {
        let digest = between(policy, &format!("{kind} 'sha256-"), "'");
        let bytes: Vec<String> = unbase64(digest).iter().map(|byte| format!("{byte:02x}")).collect();
        assert_eq!(bytes.concat(), sha256_hex(text.as_bytes()), "{kind}");
    }
    let digests: Vec<&str> = policy.split("sha256-").skip(1).map(|rest| rest.split('\'').next().expect("it")).collect();
    let head = page.split_once("<style>").expect("a style").0.to_owned();
    let head = digests.iter().fold(head, |head, digest| head.replace(digest, "DIGEST"));
    insta::assert_snapshot!(head);
    let page = page.replace("href=\"#", "");
    for word in ["http://", "https://", "src=", "href=", "style=", "onclick", "import "] {
        assert!(!page.contains(word), "`{word}` in the page");
    }
}

/// Lines of a script that are neither blank nor comment.
fn code_lines(text: &str) -> usize {
    let mut is_comment = false;
    let code = text.lines().map(str::trim).filter(|line| {
        let is_code = !is_comment && !line.is_empty() && !line.starts_with("//") && !line.starts_with("/**");
        is_comment = (is_comment || line.starts_with("/**")) && !line.ends_with("*/");
        is_code
    });
    code.count()
}

#[test]
fn the_scripts_are_short_and_plain() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/picture/player");
    let mut lines = 0;
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("readable").path();
        let text = fs::read_to_string(&path).expect("text");
        let name = path.display();
        assert!(text.lines().all(|line| line.chars().count() <= 150), "{name} has long lines");
        if path.extension().is_some_and(|extension| extension == "js") {
            assert!(text.starts_with("// ") && text.lines().all(|line| line.chars().count() <= 120), "{name}");
            lines += code_lines(&text);
        }
    }
    assert!(lines <= 1500, "{lines} lines of script");
}

#[test]
fn texts_of_a_file_stay_texts() {
    let room = Room::with("<b>&.cut", HOSTILE);
    let output: Output = room.command("compile -t html -o out.html").arg("<b>&.cut").output().expect("it starts");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let page = Page::of(&room, "out.html");
    assert_eq!(page.facts["pieces"][0]["name"], "</script><img src=x onerror=alert(1)>");
    assert!(!page.text.contains("<img") && !page.text.contains("<b>"), "markup came out of a text");
    assert_eq!(page.text.matches("</script>").count(), 3);
    assert!(page.text.contains("&lt;/script&gt;&lt;img src=x onerror=alert(1)&gt;</td>"));
    assert!(page.text.contains("<title>&lt;b&gt;&amp;.cut: verified</title>"));
}

#[test]
fn the_way_of_the_page_is_that_of_the_setpoints() {
    let room = Room::with("hostile.cut", HOSTILE);
    for name in ["circle", "hostile"] {
        room.says(&format!("compile {name}.cut -t csv,html"), DONE);
        let (page, rows) = (Page::of(&room, &format!("{name}.html")), rows(&room.text(&format!("{name}.csv"))));
        assert_eq!(page.facts["ticks"], rows.len());
        let (starts, kinds) = (&page.columns["phase_tick"], &page.columns["phase_kind"]);
        for (tick, row) in rows.iter().enumerate() {
            let found = page.at(tick as f64);
            let off = [0, 1, 2].map(|axis| (found[axis] - row[axis + 1]).abs());
            assert!(off.iter().all(|off| *off <= PROMISED), "{name}, tick {tick}: {off:?}");
            let kind = kinds[starts.partition_point(|&start| start <= tick as f64) - 1];
            assert_eq!((4.0..=5.0).contains(&kind), row[4] == 1.0, "{name}, tick {tick}: the knife");
        }
        assert!(page.columns["tick"].len() * 8 < rows.len(), "{} knots", page.columns["tick"].len());
        let most = |column: &str| page.columns[column].iter().copied().fold(0.0, f64::max);
        let [speed, acceleration, jerk] = ["speed_x_most", "acc_x_most", "jerk_x_most"].map(most);
        let shares = [speed, acceleration, jerk];
        assert!(
            speed <= 1.0 && (0.4..=1.0).contains(&acceleration) && (0.4..=1.0).contains(&jerk),
            "{name}: {shares:?}"
        );
    }
}

#[test]
fn the_page_is_the_same_on_any_number_of_threads() {
    let room = Room::with("hostile.cut", HOSTILE);
    let page = |threads: &str| {
        let mut command = room.command("compile hostile.cut -t html,svg --force");
        let output = command.env("RAYON_NUM_THREADS", threads).output().expect("it starts");
        assert!(output.status.success());
        room.read("hostile.html")
    };
    let one = page("1");
    assert!(one == page("3") && one == page("2"));
}

#[test]
fn a_page_shows_what_was_refused() {
    let room = Room::with("hostile.cut", HOSTILE);
    let said = room.says("compile hostile.cut -t html,csv --set verify.max_overcut_waste_mm=0", FAULTY);
    assert!(said.contains("wrote `hostile.html`, a picture of what was refused") && !room.has("hostile.csv"), "{said}");
    let page = Page::of(&room, "hostile.html");
    assert!(page.text.contains("data-worth=\"refused\"") && page.text.contains("<tr class=\"broken\">"));
    let broken = page.facts["broken"].as_array().expect("places");
    assert!(!broken.is_empty() && page.text.contains("verify/overcut-waste, broken with"), "{broken:?}");
    // What is refused before anything is planned has its cloth with the place of the fault, and no time.
    room.write("wide.cut", b"H1*G71*N1*X0Y0*M14*X90000Y0*X90000Y400*X0Y0*M15*M0*");
    room.says("compile wide.cut -t html --set table.x_mm=[0,1000]", FAULTY);
    let page = Page::of(&room, "wide.html");
    assert!(page.text.contains("<div class=\"still\">") && page.facts["ticks"] == 0);
    assert_eq!(page.facts["broken"], serde_json::json!([[9000.0, 0.0]]));
    assert!(page.text.contains("class=\"jump\" data-x=\"9000.000\" data-y=\"0.000\""));
    assert_eq!((page.columns["tick"].len(), page.columns["phase_kind"].as_slice()), (1, &[0.0][..]));
}

#[test]
fn a_folder_of_pages_has_an_overview() {
    let room = Room::new();
    fs::create_dir(room.at("in")).expect("writable");
    room.write("in/<i>.cut", HOSTILE.as_bytes());
    room.write("in/circle.cut", &room.read("circle.cut"));
    room.write("in/junk.cut", &room.read("junk.cut"));
    room.write("in/gap.cut", GAP.as_bytes());
    room.says("compile in -o out/ -t html,csv", FAULTY);
    let page = room.text("out/index.html");
    assert!(page.contains("<a href=\"./%3Ci%3E.html\">in/&lt;i&gt;.cut</a>") && !page.contains("<i>"), "{page}");
    assert!(page.contains("<a href=\"./circle.html\">") && page.contains("1 failed") && !page.contains("./junk.html"));
    let again = room.says("compile in -o out/ -t html,csv --changed", FAULTY);
    assert!(again.contains("wrote `out/index.html`") && room.text("out/index.html").contains("unchanged"), "{again}");
    // The broken file is the first, with its message; the others follow by their warnings, with their verdicts.
    let rows: Vec<&str> = page.split("<tr").skip(2).collect();
    let order = ["junk.cut", "gap.cut", "&lt;i&gt;.cut", "circle.cut"];
    for (row, name) in rows.iter().zip(order) {
        assert!(row.contains(&format!("in/{name}<")), "{name} is not in its place: {row}");
    }
    assert!(
        rows[0].contains("class=\"broken\"") && rows[0].contains("<td>refused</td>\n<td data-name=\"Made\">not</td>")
    );
    let told = "<td>this is binary data, not a cutter file <code class=\"quiet\">source/unknown-format</code>";
    assert!(rows[0].contains(told) && rows[0].contains("it has no page"), "{}", rows[0]);
    assert!(rows[1].contains("data-name=\"May spoil parts\" data-value=\"4\">4</td>"), "{}", rows[1]);
    assert!(
        rows[1].contains("<td>piece 1, block 7: ") && rows[1].contains("<p class=\"hint\">a narrower blade"),
        "{}",
        rows[1]
    );
    assert!(rows[2].contains("<td>verified</td>\n<td data-name=\"Made\">now</td>"), "{}", rows[3]);
    let digest = meta(&room, "out/circle.csv")["profile_sha256"].as_str().expect("a digest").to_owned();
    assert!(page.contains(&format!("Profile: default machine, SHA-256 of all values {digest}")));
    // What is no overview stays, and neither a part of the files nor setpoints have one.
    room.write("out/index.html", b"mine");
    assert!(room.says("compile in -o out/ -t html", USAGE).contains("`out/index.html` is no overview of pages"));
    room.says("compile in -o out/ -t csv", FAULTY);
    room.says("compile in -o out/ -t html --shard 1/1", FAULTY);
    assert_eq!(room.text("out/index.html"), "mine");
}

#[test]
fn a_page_that_nobody_judged_says_so() {
    let room = Room::new();
    room.says("compile circle.cut -t html --no-verify", DONE);
    assert!(room.text("circle.html").contains("data-worth=\"not-judged\">not verified</p>"));
    room.says("compile circle.cut -t html -o - --set tool.kind=spray", FAULTY);
    room.says("compile circle.cut -t html,html", USAGE);
}

#[test]
fn a_date_and_a_price_are_printed_by_a_page_and_refused_without_one() {
    let room = Room::new();
    room.says("compile circle.cut -t csv,html --date 2031-05-06 --rate 3600/h --plies 10", DONE);
    let page = room.text("circle.html");
    assert!(page.contains("<th scope=\"row\">Date</th>\n<td>2031-05-06</td>"));
    assert!(between(&page, "<th scope=\"row\">Cost</th>\n<td>", "</td>").contains(" for 10 plies: 0."));
    let meta = room.text("circle.html.meta.json");
    assert!(meta.contains("\"options\": \"--date 2031-05-06 --rate 1/s --plies 10\""), "{meta}");
    assert!(!room.text("circle.csv.meta.json").contains("--date"));
    for arguments in ["--date today", "-t csv --rate 45/h", "-t html --dump-after cut --date today"] {
        let said = room.says(&format!("compile circle.cut {arguments}"), USAGE);
        assert!(said.contains("is printed by a page") && said.contains("-t html"), "{said}");
    }
    room.says("compile circle.cut -o out/ -t html --changed --date monday", DONE);
    let again = |date: &str| room.says(&format!("compile circle.cut -o out/ -t html --changed --date {date}"), DONE);
    assert!(again("monday").contains("unchanged") && !again("tuesday").contains("unchanged"));
}

/// Cells of the rows of a section: the value to sort by, and the text.
pub(crate) fn table(page: &str, section: &str) -> Vec<Vec<(Option<f64>, String)>> {
    let section = between(page, &format!("<section id=\"{section}\">"), "</section>");
    let cell = |cell: &str| {
        let (attributes, text) = cell.split_once('>').expect("an end");
        let value = attributes.split_once("data-value=\"").and_then(|(_, rest)| rest.split('"').next());
        (value.map(|value| value.parse().expect("a number")), between(text, "", "</td>").to_owned())
    };
    let rows = section.split("<tr").skip(2);
    rows.map(|row| row.split("<td").skip(1).map(cell).collect()).collect()
}

/// Values of a column.
fn column(rows: &[Vec<(Option<f64>, String)>], column: usize) -> Vec<f64> {
    rows.iter().map(|row| row[column].0.expect("a number")).collect()
}

#[test]
fn a_piece_that_windows_split_is_one_row() {
    let room = Room::with("long.cut", LONG);
    room.says("compile long.cut -t html --set bite.length_mm=400", DONE);
    let page = Page::of(&room, "long.html");
    let wholes: Vec<u64> =
        page.facts["pieces"].as_array().expect("a list").iter().filter_map(|p| p["whole"].as_u64()).collect();
    assert_eq!(wholes, [0, 1, 3, 3]);
    let pieces = table(&page.text, "pieces");
    let named: Vec<[&str; 2]> = pieces[..3].iter().map(|row| [row[1].1.as_str(), row[2].1.as_str()]).collect();
    assert_eq!((pieces.len(), named), (4, vec![["1", "1"], ["2", "2"], ["3", "3, 4"]]));
    assert_eq!([3, 4].map(|cell| pieces[1][cell].1.as_str()), ["1 slit", "1.205"]);
    let windows: Vec<String> = table(&page.text, "windows").into_iter().map(|row| row[1].1.clone()).collect();
    assert_eq!(windows, ["1 piece", "1 piece", "a section of 3", "a section of 3"]);
}

#[test]
fn times_and_ways_of_a_page_add_up() {
    let room = Room::with("long.cut", LONG);
    for options in ["", " --set bite.length_mm=400"] {
        room.says(&format!("compile long.cut -t csv,html --force{options}"), DONE);
        let (page, rows) = (room.text("long.html"), rows(&room.text("long.csv")));
        let (pieces, spent) = (table(&page, "pieces"), table(&page, "spent"));
        // Totals have a head in the place of their first cell.
        let (spent, totals) = (&spent[..spent.len() - 1], &spent[spent.len() - 1]);
        let (spent_s, all) = (column(spent, 1), totals[0].0.expect("a time"));
        let times = [spent_s[0], spent_s[1], all - spent_s[0] - spent_s[1], all];
        assert!((spent_s.iter().sum::<f64>() - all).abs() < 1e-6 && times.iter().all(|&time| time > 0.5), "{times:?}");
        // The row of totals has one cell for the columns before the metres.
        let last = pieces.last().expect("totals");
        let first = pieces[0].len() - last.len();
        for (i, time) in times.into_iter().enumerate() {
            let sum: f64 = column(&pieces[..pieces.len() - 1], first + 1 + i).iter().sum();
            let told = last[1 + i].0.expect("a time");
            assert!((sum - time).abs() < 1e-6 && (told - time).abs() < 1e-6, "{options}, {i}: {sum} {told} {time}");
        }
        let up = rows.windows(2).filter(|pair| pair.iter().all(|row| row[4] == 0.0));
        let way: f64 = up.map(|pair| (pair[1][1] - pair[0][1]).hypot(pair[1][2] - pair[0][2])).sum();
        let [cut_mm, travel_mm] = [0, 1].map(|row| spent[row][3].0.expect("mm"));
        assert!((travel_mm - way).abs() < 0.01 * way && way > 500.0, "{options}: {way} {travel_mm}");
        assert_eq!(totals[2].0, Some(cut_mm + travel_mm));
    }
}

/// Provenance of a program.
fn meta(room: &Room, program: &str) -> Value {
    serde_json::from_str(&room.text(&format!("{program}.meta.json"))).expect("JSON")
}

#[test]
fn the_end_belongs_to_the_last_piece() {
    let room = Room::with("long.cut", LONG);
    room.says("compile long.cut -t html --set park=[10,20,0]", DONE);
    let page = Page::of(&room, "long.html");
    let (kinds, parts) = (&page.columns["phase_kind"], &page.columns["phase_part"]);
    let last = page.facts["pieces"].as_array().expect("a list").len() - 1;
    assert_eq!((kinds.last(), parts.last()), (Some(&0.0), Some(&(last as f64))));
    // With the knife up around the box no piece is cut at any time.
    room.says("compile long.cut -t html --force --frame", DONE);
    let page = Page::of(&room, "long.html");
    assert!(page.columns["phase_part"].iter().all(|&part| part == -1.0));
}

#[test]
fn limits_and_times_of_a_page_are_those_of_info() {
    let room = Room::with("long.cut", LONG);
    room.write("gap.cut", GAP.as_bytes());
    for name in ["long", "gap", "circle"] {
        room.says(&format!("compile {name}.cut -t html"), DONE);
        let page = room.text(&format!("{name}.html"));
        let output = room.command(&format!("info {name}.cut --time --format json")).output().expect("it starts");
        let info: Value = serde_json::from_slice(&output.stdout).expect("JSON");
        let bounds = info["spent"]["cut_bound_by"].as_object().expect("limits");
        let limited = table(&page, "limited");
        assert!(!bounds.is_empty() && limited.len() == bounds.len(), "{name}: {bounds:?}");
        for row in &limited {
            let key = format!("{}_s", row[0].1.to_lowercase().replace(' ', "_"));
            let (told, time) = (bounds[&key].as_f64().expect("s"), row[1].0.expect("s"));
            assert!((told - time).abs() < 1e-6, "{name}, {key}: {told} {time}");
        }
        let pieces = table(&page, "pieces");
        for (row, timed) in pieces.iter().zip(info["time_by_piece"].as_array().expect("pieces")) {
            let most = timed["spent"]["cut_bound_by"].as_object().expect("limits");
            let most = most.iter().max_by(|a, b| a.1.as_f64().expect("s").total_cmp(&b.1.as_f64().expect("s")));
            let most = most.expect("a limit").0.trim_end_matches("_s").replace('_', " ");
            let bound = row.iter().find(|cell| cell.0.is_none() && cell.1.ends_with('%')).expect("a limit");
            assert!(bound.1.to_lowercase().starts_with(&most), "{name}: {} instead of {most}", bound.1);
            let time = row
                .iter()
                .filter_map(|cell| cell.0)
                .find(|&time| (time - timed["time_s"].as_f64().expect("s")).abs() < 1e-6);
            assert!(time.is_some(), "{name}: no time of {}", timed["time_s"]);
        }
    }
}

#[test]
fn a_page_names_its_machine_its_program_and_its_windows() {
    let room = Room::with("long.cut", LONG);
    room.says("compile long.cut -t csv,html --set bite.length_mm=400 --set knife.lift_ms=0.05s", DONE);
    let page = room.text("long.html");
    let fact = |name: &str| between(&page, &format!("<th scope=\"row\">{name}</th>\n<td>"), "</td>").to_owned();
    let meta = meta(&room, "long.csv");
    assert_eq!(fact("Set for this job"), "bite.length_mm = 400; knife.lift_ms = 0.05s");
    assert_eq!(fact("SHA-256 of all values in force"), meta["profile_sha256"]);
    assert_eq!((fact("Program"), fact("BLAKE3 of the program")), ("long.csv".into(), digest_of(&meta)));
    assert!(fact("Verified").starts_with("read back, ") && fact("Verified").ends_with(" rules hold"));
    assert!(
        page.contains(" m of lines to cut in 4 windows, ")
            && fact("Time").ends_with(" without the time in which the cloth is moved on")
    );
    room.says("compile long.cut -t html --force --no-verify", DONE);
    let page = room.text("long.html");
    assert!(page.contains("<td>none beside this page") && page.contains("with --no-verify nobody has read"));
    assert!(!page.contains("Set for this job") && !page.contains("windows, "));
}

fn digest_of(meta: &Value) -> String {
    meta["program_blake3"].as_str().expect("a digest").to_owned()
}

#[test]
fn a_place_of_a_page_tells_both_pieces() {
    let room = Room::with("gap.cut", GAP);
    room.says("compile gap.cut -t html", DONE);
    let page = room.text("gap.html");
    let told: Vec<&str> = page.split("data-told=\"").skip(1).map(|rest| between(rest, "", "\"")).collect();
    assert_eq!(told.len(), page.matches("class=\"jump\"").count());
    let of = |words: &[&str]| told.iter().filter(|told| words.iter().all(|word| told.contains(word))).count();
    assert!(of(&["piece 1: the blade", "it cuts 0.45 mm into piece 2"]) > 0, "{told:?}");
    assert!(of(&["verify/overcut-neighbour, holds with 0.4", "piece 1: the blade", "into piece 2"]) == 1, "{told:?}");
    assert!(of(&["in a part, 0.4", "piece 1 into piece 2"]) > 0, "{told:?}");
    let body = between(&page, "<body>", "<script");
    assert!(body.contains("<code>") && !body.contains('`'), "backticks are no text for people");
}

#[test]
fn messages_and_rules_name_one_deepest_place() {
    let room = Room::with("gap.cut", GAP);
    room.write("nest.cut", Recipe::of(2, 14, 6).nest().text.as_bytes());
    let mut pairs = 0;
    for name in ["gap", "nest"] {
        room.says(&format!("compile {name}.cut -t html"), DONE);
        let page = room.text(&format!("{name}.html"));
        for (code, rule) in
            [("path/overcut", "verify/overcut-part"), ("path/overcut-neighbour", "verify/overcut-neighbour")]
        {
            let Some((_, group)) = page.split_once(&format!("<code>{code}</code>")) else { continue };
            let items = between(group, "<ol", "</ol>").split("<li>").skip(1);
            let depths: Vec<f64> =
                items.clone().map(|item| between(item, "it cuts ", " mm into ").parse().expect("mm")).collect();
            assert!(depths.is_sorted_by(|a, b| a >= b), "{name} {code}: {depths:?}");
            let first = items.clone().next().expect("a message");
            let row = page.split(&format!("<td>{rule}</td>")).nth(1).expect("a row").split("</tr>").next().expect("it");
            let other = first.split_once(" mm into piece ").map(|(_, rest)| rest.split(' ').next().expect("a number"));
            assert_eq!(other.is_some(), code == "path/overcut-neighbour", "{first}");
            let into = other.map_or_else(String::new, |other| format!(" into piece {other}"));
            assert!(row.contains("deepest") && row.contains(&into), "{first} {row}");
            let told = between(row, "<p class=\"hint\">", "<");
            let told = told.split_once(": ").map(|(_, depth)| between(depth, "", " mm").parse().expect("mm"));
            let worst = between(row, "data-value=\"", "\"").parse::<f64>().expect("mm");
            assert!((told.unwrap_or(worst) - depths[0]).abs() < 0.011, "{name} {code}: {told:?} {worst} {depths:?}");
            pairs += 1;
        }
    }
    assert!(pairs > 2, "{pairs} rules with messages");
    let page = room.text("gap.html");
    assert!(
        page.contains("it cuts 0.45 mm into piece 2 before its start")
            && page.contains("the deepest entry into piece 2")
    );
    assert!(["piece 2", "its own part"].iter().all(|into| {
        page.contains(&format!("<td data-name=\"Piece\">piece 1</td>\n<td data-name=\"Into\">{into}</td>"))
    }));
    // Eight in their lists, six in the rows of the pieces, two deepest in parts.
    let places = page.split("class=\"jump\"").skip(1).filter(|place| !between(place, "", ">").contains("data-time"));
    assert_eq!(places.filter(|place| between(place, "", ">").contains("data-part=\"0\"")).count(), 16);
}

#[test]
fn the_top_of_a_page_counts_its_messages() {
    let room = Room::with("gap.cut", GAP);
    room.write("long.cut", LONG.as_bytes());
    room.says("compile long.cut -t html", DONE);
    let page = room.text("long.html");
    assert!(
        page.contains("<p class=\"tally\">no warnings</p>") && page.contains("Nothing must be done before you cut")
    );
    room.says("compile gap.cut -t html", DONE);
    let page = room.text("gap.html");
    assert!(page.contains("<a href=\"#messages\">4 warnings</a>") && page.contains("look at the warnings of parts"));
    room.says("compile gap.cut -t html --force --set verify.max_overcut_neighbour_mm=0.1", FAULTY);
    let page = room.text("gap.html");
    assert!(page.contains("<a href=\"#messages\">2 errors, 2 warnings</a>"), "{}", between(&page, "tally", "</p>"));
}

#[test]
fn the_page_says_how_notches_are_cut() {
    let room = Room::with("gap.cut", GAP);
    for (options, expected) in [("", "1 v; cut as drawn"), (" --set notch.style=skip", "1 v; no notch is cut")] {
        room.says(&format!("compile gap.cut -t html --force{options}"), DONE);
        let page = room.text("gap.html");
        assert_eq!(between(&page, "Notches and holes</th>\n<td>", "</td>"), expected);
        assert_eq!(column(&table(&page, "pieces")[..2], 2), [1.0, 0.0]);
    }
}
