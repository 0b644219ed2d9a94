//! Promises of the target `gcode`: few arcs and lines in the band, controller tables obeyed, damage refused under its rule.

use std::collections::BTreeMap;
use std::io::{BufReader, Cursor};
use std::path::Path;

use cutc::back::{TARGETS, Target};
use cutc::diagnostic::{Diagnostic, Diagnostics};
use cutc::machine::{Follow, Job, MachineProfile, Shipped, load};
use cutc::pipeline::{self, Compiled, Order, Verdict};
use cutc::source::Source;
use cutc::units::S_PER_MIN;
use cutc::verify::{self, Ground};

fn fixture(name: &str) -> Source {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures").join(name);
    let bytes = std::fs::read(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    Source::new(name, bytes).expect("fixtures are small")
}

/// The job of a profile that ships, or of a machine table.
fn machine(name: &str) -> Job {
    let source = Shipped::find(name).map_or_else(|| fixture(&format!("machines/{name}.toml")), Shipped::source);
    let profile = load(Some(&source), &[]);
    Job { profile: profile.unwrap_or_else(|faults| panic!("{name}: {faults:?}")), ..Job::default() }
}

fn target() -> &'static Target {
    TARGETS.iter().find(|target| target.name == "gcode").expect("a target")
}

/// The program of a source, which must be sound.
fn compile(source: &Source, job: &Job) -> (String, Compiled) {
    let mut out = Cursor::new(Vec::new());
    let mut diagnostics = Diagnostics::default();
    let order = Order { from: None, target: target(), verify: true };
    let compiled = pipeline::compile(source, job, order, &mut out, &mut diagnostics).expect("memory takes it");
    let compiled = compiled.unwrap_or_else(|| panic!("{}: {diagnostics:?}", source.name()));
    (String::from_utf8(out.into_inner()).expect("ASCII"), compiled)
}

fn judge(program: &str, source: &Source, job: &Job) -> Verdict {
    let mut diagnostics = Diagnostics::default();
    let input = pipeline::read(source, None, job, &mut diagnostics).expect("it is read");
    verify::positions(&mut BufReader::new(program.as_bytes()), None, &Ground::new(&input.marker, &job.profile), job)
}

/// The markers that are damaged, each with a machine of its own.
fn cases() -> Vec<(&'static str, Job)> {
    let with = |change: fn(&mut Job)| {
        let mut job = Job::default();
        job.profile.park = Some([5.0, 5.0, 0.0]);
        change(&mut job);
        job
    };
    vec![
        ("markers/drills-and-slits.cut", with(|job| job.profile.drill.offset_mm = [12.0, -5.0])),
        ("markers/metric-four-pieces.cut", with(|job| job.profile.knife.yaw_deg = 1.5)),
        ("markers/inch-four-pieces.cut", with(|job| job.profile.knife.back_mm = Some(2.2))),
        ("markers/tight-curves-and-short-runs.cut", with(|job| job.profile.gcode.line_numbers = true)),
        ("markers/circles.cut", with(|job| (job.profile.c.offset_deg, job.profile.c.reverse) = (30.0, true))),
        ("iso/speeds-and-events.cut", with(|job| job.profile.gcode.wrapped = true)),
        (
            "markers/metric-six-pieces.cut",
            with(|job| {
                (job.profile.knife.edges, job.profile.knife.back_mm) = (2, Some(2.2));
                (job.profile.slow.before_corner_mm, job.profile.slow.before_corner_percent) = (Some(10.0), 40.0);
            }),
        ),
    ]
}

/// A damage: what it is, the rule that must see it, or the rules of which one must, and how a line is changed; `None` leaves a line alone.
type Damage = (&'static str, &'static str, fn(&Lines) -> Option<Vec<String>>);

/// The lines of a program.
struct Lines(Vec<String>);

impl Lines {
    /// The lines with a change of one line in the middle of those that hold a word.
    fn with(&self, word: &str, change: impl Fn(&str) -> Vec<String>) -> Option<Vec<String>> {
        self.with_both([word; 2], change)
    }

    /// The same of those that hold two words.
    fn with_both(&self, words: [&str; 2], change: impl Fn(&str) -> Vec<String>) -> Option<Vec<String>> {
        let holds = |i: &usize| words.iter().all(|word| self.0[*i].contains(word));
        let places: Vec<usize> = (0..self.0.len()).filter(holds).collect();
        let place = *places.get(places.len() / 2)?;
        let mut lines = self.0.clone();
        lines.splice(place..=place, change(&self.0[place]));
        Some(lines)
    }

    /// The same, of the number behind a letter.
    fn by(&self, word: &str, letter: &str, by: f64) -> Option<Vec<String>> {
        self.with_both([word, &format!(" {letter}")], |line| {
            let words = line.split(' ').map(|word| match word.strip_prefix(letter) {
                Some(number) => format!("{letter}{:.4}", number.parse::<f64>().expect("a number") + by),
                None => word.to_owned(),
            });
            vec![words.collect::<Vec<_>>().join(" ")]
        })
    }

    fn without(&self, word: &str) -> Option<Vec<String>> {
        self.with(word, |_| Vec::new())
    }
}

const DAMAGES: &[Damage] = &[
    ("a cut that ends aside", "verify/on-path", |lines| aside(lines, "G1 ")),
    ("an arc that ends aside", "verify/format", |lines| lines.by("G3 ", "X", 0.4)),
    ("an arc around another centre", "verify/format", |lines| {
        lines.with("G2 ", |line| vec![line.replace(" I", " I-").replace("--", "")])
    }),
    ("an arc the other way", "verify/on-path", |lines| lines.with("G2 ", |line| vec![line.replace("G2 ", "G3 ")])),
    ("a blade that is turned", "verify/heading", |lines| lines.by("G1 ", "C", 3.0)),
    ("a blade that turns on an arc", "verify/heading", |lines| lines.by("G3 ", "C", 2.0)),
    ("a plunge left out", "verify/complete", |lines| lines.without("M64 P0")),
    ("a lift left out", "verify/format", |lines| lines.without("M65 P0")),
    ("the end of a cut left out", "verify/complete", |lines| {
        let ends = |i: &usize| lines.0[*i].contains("G1 ") && lines.0[i + 1].ends_with("M65 P0");
        let places: Vec<usize> = (0..lines.0.len() - 1).filter(ends).collect();
        let mut cut = lines.0.clone();
        cut.remove(*places.get(places.len() / 2)?);
        Some(cut)
    }),
    ("a stroke cut again", "verify/once", again),
    ("a hole left out", "verify/drills", |lines| lines.without("M64 P1")),
    ("a hole aside", "verify/drill-place", |lines| {
        let at = lines.0.iter().position(|line| line.ends_with("M64 P1"))?;
        let mut moved = lines.0.clone();
        moved[at - 1] = Lines(vec![moved[at - 1].clone()]).by("G0 ", "X", 0.3)?.remove(0);
        Some(moved)
    }),
    ("a hole by another drill", "verify/drills", |lines| {
        Some(lines.0.iter().map(|line| line.replace("M64 P1", "M64 P3").replace("M65 P1", "M65 P3")).collect())
            .filter(|changed| *changed != lines.0)
    }),
    ("an event left out", "verify/events", |lines| {
        lines.0.iter().any(|line| line.ends_with("M0")).then(|| lines.without("M0"))?
    }),
    ("an event told twice", "verify/events", |lines| {
        let at = lines.0.iter().position(|line| line.ends_with("M0"))?;
        let mut twice = lines.0.clone();
        twice.insert(at, lines.0[at].clone());
        Some(twice)
    }),
    ("another place to park", "verify/end", |lines| {
        let at = lines.0.iter().rposition(|line| line.contains("G0 "))?;
        let mut moved = lines.0.clone();
        moved[at] = Lines(vec![moved[at].clone()]).by("G0 ", "X", 1.0)?.remove(0);
        Some(moved)
    }),
    ("the order of two cuts", "verify/order", |lines| {
        let parts = parts(lines);
        (parts.len() > 3).then(|| {
            let (a, b) = (parts[1].clone(), parts[parts.len() - 1].clone());
            let mut swapped = lines.0[..a.start].to_vec();
            for range in [b.clone(), a.end..b.start, a] {
                swapped.extend_from_slice(&lines.0[range]);
            }
            swapped.extend_from_slice(&lines.0[b.end..]);
            swapped
        })
    }),
    ("no end", "verify/format", |lines| lines.without("M2")),
    ("something behind the end", "verify/format", |lines| {
        lines.with("M2", |line| vec![line.to_owned(), "M64 P0".to_owned()])
    }),
    ("the end of a line lost", "verify/format", |lines| {
        let mut cut = lines.0.clone();
        let last = cut.last_mut()?;
        last.push_str("...");
        Some(cut)
    }),
    ("a number that is none", "verify/format", |lines| lines.with("G1 ", |line| vec![line.replace("G1 X", "G1 Xa")])),
    ("an axis that is none", "verify/format", |lines| {
        lines.with_both(["G1 ", " C"], |line| vec![line.replace(" C", " B")])
    }),
    ("a feed left out", "verify/format", |lines| {
        lines.with("G1 ", |line| vec![line.split(" F").next().unwrap_or_default().to_owned()])
    }),
    ("a feed too fast", "verify/feed", |lines| faster(lines, "G1 ")),
    ("a feed too fast on an arc", "verify/feed", |lines| faster(lines, "G3 ")),
    ("full speed where it is slowed", "verify/feed", |lines| {
        let feed = |line: &str| line.split(" F").nth(1).and_then(|feed| feed.parse::<f64>().ok());
        let most = lines.0.iter().filter_map(|line| feed(line)).fold(0.0, f64::max);
        let slow =
            lines.0.iter().find(|line| line.contains("G1 ") && feed(line).is_some_and(|feed| feed < 0.9 * most))?;
        lines.with(slow, |line| vec![format!("{} F{most}", line.split(" F").next().unwrap_or_default())])
    }),
    ("F divided by ten", "verify/crawl", |lines| slowest(lines, "G1 ", 10.0)),
    ("F of an arc divided by ten", "verify/crawl", |lines| slowest(lines, "G3 ", 10.0)),
    ("a turn on the spot that takes a second", "verify/crawl", |lines| {
        let at = lines.0.iter().rposition(|line| line.contains("G1 "))?;
        let mut turned = lines.0.clone();
        let on = Lines(vec![turned[at].clone()]).by("G1 ", "C", 0.01)?.remove(0);
        // Where only C moves, F is in degrees a minute.
        turned.insert(at + 1, format!("{} F0.6", on.split(" F").next().unwrap_or_default()));
        Some(turned)
    }),
    ("a dwell times ten", "verify/dwell", |lines| lines.with("G4 P0.080", |line| vec![line.replace("0.080", "0.800")])),
    ("a rest amid a cut", "verify/dwell", |lines| {
        lines.with("G1 ", |line| vec![line.to_owned(), "G4 P0.5".to_owned()])
    }),
    ("a way behind a rest", "verify/format", |lines| lines.with("G4 P0.080", |line| vec![format!("{line} X5 Y5 C0")])),
    ("a move under a drill", "verify/format", |lines| {
        let at = lines.0.iter().position(|line| line.ends_with("M64 P1"))?;
        let mut moved = lines.0.clone();
        moved.insert(at + 2, lines.0[at - 1].clone());
        Some(moved)
    }),
    ("an arc that hardly turns", "verify/format", |lines| {
        lines.with("G1 ", |line| {
            let arc = line.replace("G1 ", "G3 ").replace(" F", " I0 J1000 F");
            let on = Lines(vec![arc]).by("G3 ", "X", 0.0002).expect("an arc");
            vec![line.to_owned(), on[0].clone()]
        })
    }),
    ("a stroke with the blade turned half round", "verify/heading|verify/complete", |lines| {
        let part = parts(lines).into_iter().max_by_key(std::ops::Range::len)?;
        let mut turned = lines.0.clone();
        for line in &mut turned[part] {
            // An axis that goes round knows no more than a whole turn.
            let stands = line.split(" C").nth(1).and_then(|rest| rest.split(' ').next()?.parse::<f64>().ok());
            let by = if stands.is_some_and(|c| c >= 180.0) { -180.0 } else { 180.0 };
            *line = Lines(vec![line.clone()]).by("C", "C", by).map_or(line.clone(), |mut lines| lines.remove(0));
        }
        Some(turned).filter(|turned| *turned != lines.0)
    }),
    ("inches", "verify/format", |lines| lines.with("G21", |line| vec![line.to_owned(), "G20".to_owned()])),
    ("another speed mode", "verify/format", |lines| lines.with("G94", |line| vec![line.replace("G94", "G93")])),
    ("a relative place", "verify/format", |lines| lines.with("G0 ", |line| vec!["G91".to_owned(), line.to_owned()])),
];

/// A line that asks for half as much again as the feed: on an arc an eccentric tip is slower than its axis.
fn faster(lines: &Lines, word: &str) -> Option<Vec<String>> {
    let feed = 1.5 * S_PER_MIN * MachineProfile::default().knife.feed_mm_s.expect("a feed");
    lines.with(word, |line| vec![format!("{} F{feed}", line.split(" F").next().unwrap_or_default())])
}

/// Of the lines with a word the one with the greatest F, with a part of that.
fn slowest(lines: &Lines, word: &str, by: f64) -> Option<Vec<String>> {
    let with_word = lines.0.iter().enumerate().filter(|(_, line)| line.contains(word));
    let feeds = with_word.filter_map(|(at, line)| Some((at, line.split(" F").nth(1)?.parse::<f64>().ok()?)));
    let (at, _) = feeds.max_by(|a, b| a.1.total_cmp(&b.1))?;
    let mut slower = lines.0.clone();
    slower[at] = slowed(&slower[at], by);
    Some(slower)
}

/// A line with a part of its F, if it has one.
fn slowed(line: &str, by: f64) -> String {
    let Some((way, feed)) = line.split_once(" F") else { return line.to_owned() };
    format!("{way} F{:.4}", feed.parse::<f64>().expect("a number") / by)
}

/// The axes shifted by more than any tolerance, at right angles to nothing in particular.
fn aside(lines: &Lines, word: &str) -> Option<Vec<String>> {
    let once = Lines(lines.by(word, "X", 1.3)?);
    // The same line again: the words that it had are those of the middle one still.
    once.by(word, "Y", 1.7)
}

/// Where the parts of a program are that a comment names.
fn parts(lines: &Lines) -> Vec<std::ops::Range<usize>> {
    let starts: Vec<usize> = (0..lines.0.len()).filter(|&i| lines.0[i].contains("(piece")).collect();
    starts.windows(2).map(|w| w[0]..w[1]).collect()
}

/// The longest part again behind itself.
fn again(lines: &Lines) -> Option<Vec<String>> {
    let part = parts(lines).into_iter().max_by_key(std::ops::Range::len)?;
    let mut twice = lines.0[..part.end].to_vec();
    twice.extend_from_slice(&lines.0[part.start..]);
    Some(twice)
}

#[test]
fn every_damage_is_refused_under_its_rule() {
    let mut seen: BTreeMap<&str, usize> = DAMAGES.iter().map(|(name, ..)| (*name, 0)).collect();
    let mut survived = Vec::new();
    for (name, job) in cases() {
        let source = fixture(name);
        let (program, _) = compile(&source, &job);
        assert!(judge(&program, &source, &job).passes(), "{name}");
        let lines = Lines(program.lines().map(str::to_owned).collect());
        for (damage, rule, run) in DAMAGES {
            let Some(damaged) = run(&lines) else { continue };
            assert!(damaged != lines.0, "{name}: {damage} changes nothing");
            let verdict = judge(&(damaged.join("\n") + "\n"), &source, &job);
            let broken: Vec<_> = verdict.broken().map(|finding| finding.rule.name).collect();
            if !rule.split('|').any(|rule| broken.contains(&rule)) {
                survived.push(format!("{name}: {damage}: not {rule} but {broken:?}, {:?}", verdict.unread));
            }
            *seen.get_mut(damage).expect("it is counted") += 1;
        }
    }
    assert!(survived.is_empty(), "{survived:#?}");
    let unseen: Vec<_> = seen.iter().filter(|(_, count)| **count == 0).collect();
    assert!(unseen.is_empty(), "nothing was damaged by {unseen:?}");
}

#[test]
fn a_knife_that_crawls_or_rests_too_long_is_refused_and_one_a_third_as_bad_is_accepted() {
    for name in ["linuxcnc", "fluidnc", "wavy"] {
        let job = machine(name);
        for file in ["iso/speeds-and-events.cut", "markers/tight-curves-and-short-runs.cut", "motion/wavy751.csv"] {
            let source = fixture(file);
            let (program, _) = compile(&source, &job);
            let judged = |line: &dyn Fn(&str) -> String| {
                let damaged: String = program.lines().map(|text| line(text) + "\n").collect();
                let verdict = judge(&damaged, &source, &job);
                assert!(verdict.unread.is_none(), "{name}: {file}: {:?}", verdict.unread);
                verdict.broken().map(|finding| (finding.rule.name, finding.worst)).collect::<Vec<_>>()
            };
            let dwells = |by: f64| {
                move |line: &str| match line.strip_prefix("G4 P").and_then(|time| time.parse::<f64>().ok()) {
                    Some(time) if (0.02..0.1).contains(&time) => format!("G4 P{:.5}", time + by),
                    _ => line.to_owned(),
                }
            };
            assert_eq!(judged(&|line| slowed(line, 4.0 / 3.0)), [], "{name}: {file}");
            let crawling = judged(&|line| slowed(line, 12.0));
            assert!(matches!(crawling[..], [("verify/crawl", 11.9..13.0)]), "{name}: {file}: {crawling:?}");
            assert_eq!(judged(&dwells(0.000_33)), [], "{name}: {file}");
            let resting = judged(&dwells(0.003));
            let rests = program.contains("G4 P0.0");
            let is_seen =
                if rests { matches!(resting[..], [("verify/dwell", 0.0029..0.0031)]) } else { resting.is_empty() };
            assert!(is_seen, "{name}: {file}: {resting:?}");
        }
    }
}

#[test]
fn a_line_that_cannot_be_read_is_named_with_the_reason() {
    let (source, job) = (fixture("iso/seed-circle.cut"), Job::default());
    let (program, _) = compile(&source, &job);
    let check = |from: &str, to: &str, expected: &str| {
        let verdict = judge(&program.replacen(from, to, 1), &source, &job);
        let unread = verdict.unread.unwrap_or_default();
        assert!(unread.contains(expected), "{from} -> {to}: {unread}");
        assert_eq!(verdict.findings.len(), 1, "nothing is said about the rest");
    };
    check("G94\n", "G93\n", "line 3 is `G93` where `G94` belongs");
    check("G64 P0.05 Q0\n", "", "line 2 is `G94` where `G64 P0.05 Q0` belongs");
    check("M64 P0\n", "M3\n", "line 11 has `M3`, which is no word of the target gcode with this profile");
    check("G4 P", "G4 X", "line 8 is `G4 X0.060` where a rest of 0.06 s belongs");
    check("G4 P0.080", "G4 P0.010", "where a rest of 0.08 s belongs");
    check("\nG2 ", "\n(x) G1 X500 Y500 C0 F60 (y))\nG2 ", "has `(x)`, which is no word");
    check("\nG2 ", "\n/G2 ", "has `/G2`, which is no word");
    check("\nG2 ", "\nN1 N2 G2 ", "has `N2`, which is no word");
    check("\nG2 ", "\n%\nG2 ", "has `%`, which is no word");
    check("\nG2 ", "\ng0 x0 y0 c0\nG2 ", "is a rapid move while the knife is down");
    check("\nG2 ", "\nG2 (MSG, on)\nG2 ", "has `(MSG,`, which is no word");
    check("\nG2 ", "\n( PY, on)\nG2 ", "which is obeyed though it looks like a comment");
    check("\nG2 ", "\nX1 Y1 C0 F60\nG2 ", "which is no line of the target gcode");
    check("\nG2 X", "\nG2 X#1", "which is no word");
    check("\nG2 ", "\nG0 X0 Y0 C0\nG2 ", "is a rapid move while the knife is down");
    check(" I", " P2 I", "has P, which such a move has not");
    check("G0 X", "G0 Xx", "which is no word");
    check(" C", " C1 C", "has two words C");
    check("M2\n", "", "is missing: the program has no end");
    check("M2\n", "M2", "has no end: the file is cut short");
    check("M2\n", "M2\nG0 X0 Y0 C0\n", "comes behind the end of the program");
    check("G94\n", "G94\nG17 G21 G40 G80 G90 G91.1\n", "is the head of a program again");
    check(" I", " I1 J1 F1\n(", "is an arc whose ends lie");
}

#[test]
fn a_program_that_is_spelled_by_hand_is_judged_as_what_it_says() {
    type Spelling = (&'static str, fn(&str) -> String);
    let spellings: [Spelling; 9] = [
        ("lower case", str::to_lowercase),
        ("leading zeros", |line| line.replace("G1 ", "G01 ").replace("G0 ", "G00 ").replace("M2", "M002")),
        ("no blanks", |line| if line.starts_with('(') { line.to_owned() } else { line.replace(' ', "") }),
        ("more blanks", |line| format!(" {}\t", line.replace(' ', " \t "))),
        (
            "comments behind lines",
            |line| if line.contains('(') { line.to_owned() } else { format!("{line} (by hand) ; so") },
        ),
        ("comments and blank lines between", |line| format!("{line}\n\n(by hand)\n ; so\n")),
        ("numbers of lines", |line| format!("N0010{line}")),
        ("signs and zeros of numbers", |line| line.replace(" X", " X+00").replace("+00-", "-00").replace(" F", " F0")),
        ("words in another order", |line| match line.split_once(' ') {
            Some((code @ ("G0" | "G1" | "G2" | "G3"), words)) => format!("{words} {code}"),
            _ => line.to_owned(),
        }),
    ];
    for (name, mut job) in cases() {
        job.profile.gcode.line_numbers = false;
        let source = fixture(name);
        let (program, _) = compile(&source, &job);
        let expected = judge(&program, &source, &job);
        assert!(expected.passes());
        for (spelling, spelled) in spellings {
            let hand: String = program.lines().map(|line| spelled(line) + "\n").collect();
            assert!(hand != program, "{name}: {spelling}");
            assert!(matches!(verify::foreign(&mut hand.as_bytes(), &job.profile), Ok(None)), "{name}: {spelling}");
            let mut verdict = judge(&hand, &source, &job);
            for (finding, as_compiled) in verdict.findings.iter_mut().zip(&expected.findings) {
                if let (Some(place), Some(expected)) = (&mut finding.place, as_compiled.place) {
                    place.line = expected.line;
                }
            }
            assert!(verdict == expected, "{name}: {spelling}: {:?}", verdict.unread);
        }
    }
}

#[test]
fn a_move_between_comments_is_judged_as_the_controller_goes_it() {
    let (source, job) = (fixture("iso/seed-circle.cut"), Job::default());
    let (program, _) = compile(&source, &job);
    let verdict = judge(&program.replacen("\nG2 ", "\n(x) G1 X500 Y500 C0 F60 (y)\nG2 ", 1), &source, &job);
    // From there the next arc is none.
    assert!(verdict.unread.is_some_and(|why| why.contains("is an arc whose ends lie")));
    let last = program.rfind("\nM65 P0").expect("a lift");
    let stray = format!("{}\n(x) G1 X500 Y500 C0 F60 (y){}", &program[..last], &program[last..]);
    let verdict = judge(&stray, &source, &job);
    assert!(verdict.unread.is_none() && !verdict.passes(), "{verdict:?}");
}

#[test]
fn what_stops_a_controller_is_refused() {
    let (source, job) = (fixture("iso/seed-circle.cut"), Job::default());
    let (program, _) = compile(&source, &job);
    let verdict = |line: &str, job: &Job, program: &str| {
        judge(&program.replacen("\nG0 ", &format!("\n{line}\nG0 "), 1), &source, job).unread
    };
    assert_eq!(verdict(&format!("({})", "a".repeat(253)), &job, &program), None);
    let unread = |line: &str| verdict(line, &job, &program).unwrap_or_default();
    assert!(unread(&format!("({})", "a".repeat(254))).contains("is too long"));
    assert!(unread("(a\0b)").contains("holds a NUL"));
    assert!(unread("(a)N1").contains("is no word of the target"));
    let mut wrapped = job.clone();
    wrapped.profile.gcode.wrapped = true;
    let (round, _) = compile(&source, &wrapped);
    assert_eq!(verdict("(a)", &wrapped, &round), None);
    let beyond = verdict("G0 X1 Y1 C450", &wrapped, &round).unwrap_or_default();
    assert!(beyond.contains("C450, which an axis that goes round does not know"), "{beyond}");
}

#[test]
fn a_knife_cannot_rest_in_the_cloth_by_orders_and_moves_that_do_nothing() {
    let (source, job) = (fixture("iso/seed-circle.cut"), machine("linuxcnc"));
    let (program, _) = compile(&source, &job);
    let plunge = "M64 P0\nG4 P0.080\n";
    let place = program.lines().find(|line| line.starts_with("G0 X")).expect("it travels");
    let again = |line: &str, count: usize| format!("{plunge}{}", format!("{line}\n").repeat(count));
    for slowed in [
        again(&format!("G4 P0.0009\n{} F100", place.replace("G0", "G1")), 1000),
        again("M64 P0\nG4 P0.080", 100),
        again("G4 P0.0009", 10),
    ] {
        let verdict = judge(&program.replacen(plunge, &slowed, 1), &source, &job);
        assert!(!verdict.passes(), "{}", &slowed[..60]);
    }
}

#[test]
fn an_axis_that_goes_round_is_told_nothing_where_it_rests_in_the_cloth() {
    let mut job = machine("linuxcnc");
    job.profile.gcode.wrapped = true;
    let source = fixture("markers/metric-four-pieces.cut");
    let (program, _) = compile(&source, &job);
    let lines: Vec<&str> = program.lines().collect();
    let turned = |line: &str| line.split(' ').find_map(|word| word.strip_prefix('C')).map(str::to_owned);
    let is_cut = |line: &str| line.starts_with("G1 ") || line.starts_with("G2 ") || line.starts_with("G3 ");
    let rests = lines.iter().position(|line| is_cut(line) && turned(line).is_none()).expect("a straight cut");
    let told = lines[..rests].iter().rev().find_map(|line| turned(line)).expect("it was turned before");
    // LinuxCNC unwraps by sums of its own: the same place again may be a whole turn to it.
    let mut spun: Vec<String> = lines.iter().map(|&line| line.to_owned()).collect();
    spun[rests] = lines[rests].replace(" F", &format!(" C{} F", told.trim_start_matches('-')));
    let verdict = judge(&(spun.join("\n") + "\n"), &source, &job);
    assert!(verdict.unread.as_ref().is_some_and(|why| why.contains("all round")), "{:?}", verdict.unread);
}

#[test]
fn the_f_of_a_plunge_is_none_of_the_cut_behind_it() {
    let mut job = Job::default();
    job.profile.gcode.knife_down = vec!["G1 Z-2 F60".parse().expect("a step")];
    job.profile.gcode.knife_up = vec!["G0 Z5".parse().expect("a step")];
    let source = fixture("iso/seed-circle.cut");
    let (program, _) = compile(&source, &job);
    let cut = program.lines().find(|line| line.starts_with("G2 ") || line.starts_with("G3 ")).expect("a cut");
    let bare = cut.split(" F").next().expect("words");
    let verdict = judge(&program.replacen(cut, bare, 1), &source, &job);
    assert!(verdict.unread.is_some_and(|why| why.contains("has no F")));
}

#[test]
fn a_drill_is_lifted_by_its_own_lines() {
    let (source, job) = (fixture("markers/drills-and-slits.cut"), Job::default());
    let (program, _) = compile(&source, &job);
    let verdict = judge(&program.replacen("M65 P1", "M65 P3", 1), &source, &job);
    assert!(verdict.unread.is_some_and(|why| why.contains("lifts drill 3 while drill 1 is down")));
}

#[test]
fn g_code_of_others_is_told_apart() {
    let foreign = |text: &str| verify::foreign(&mut text.as_bytes(), &Job::default().profile).expect("readable");
    for text in ["%\nO1000\n", "G21\nG0 X1\n", "(a comment)\nG90\n", "N10 G90\n"] {
        let [what, _] = foreign(text).expect("it is none");
        assert!(what.contains("not `G17 G21 G40 G80 G90 G91.1`"), "{what}");
    }
    assert!(
        foreign("G17 G21 G40 G80 G90 G91.1\nG94\n").is_none() && foreign("N1 G17 G21 G40 G80 G90 G91.1\r\n").is_none()
    );
    let [cut, _] = foreign("N1*G71*M15*X0Y0*").expect("a cut file is no program");
    assert!(!cut.contains("G17"), "{cut}");
}

#[test]
fn ready_tables_of_controllers_give_programs_that_pass() {
    for name in ["linuxcnc", "fluidnc"] {
        let job = machine(name);
        let markers = [
            "markers/metric-six-pieces.cut",
            "markers/inch-four-pieces.cut",
            "markers/tight-curves-and-short-runs.cut",
            "iso/speeds-and-events.cut",
        ];
        for file in markers.into_iter().chain(["motion/contour2m_flat.csv", "motion/wavy751.csv"]) {
            let (program, compiled) = compile(&fixture(file), &job);
            let keys = &job.profile.gcode;
            assert!(keys.arcs || !program.contains("\nG3 "), "{name}: {file}");
            assert_eq!(program.contains("\nG93\n"), name == "fluidnc", "{name}: {file}");
            let untimed = format!("{:?}", compiled.verdict.expect("it was judged").untimed);
            assert!(untimed.contains("\"verify/speed-x\"") && !untimed.contains("\"verify/feed\""));
        }
    }
}

#[test]
fn a_wavy_contour_is_at_most_a_quarter_as_many_moves_as_chords() {
    let (program, compiled) = compile(&fixture("motion/wavy751.csv"), &machine("wavy"));
    let moves =
        program.lines().filter(|line| line.starts_with("G1 ") || line.starts_with("G2 ") || line.starts_with("G3 "));
    let controller = compiled.report.controller.expect("it is estimated");
    assert_eq!(moves.count(), controller.moves);
    assert!(4 * controller.moves <= 500, "{} moves", controller.moves);
    assert!(controller.time_s < 8.5, "{} s", controller.time_s);
}

#[test]
fn a_dry_run_moves_and_tells_events_and_nothing_else() {
    let job = Job { mode: cutc::machine::Mode::Dry, ..Job::default() };
    let (program, _) = compile(&fixture("iso/speeds-and-events.cut"), &job);
    assert!(!program.contains("M64") && program.contains("G1 ") && program.contains("\nM0\n"));
}

#[test]
fn cuts_that_are_refused_for_one_reason_are_one_message() {
    let mut job = Job::default();
    job.profile.knife.follow = Follow::Chord;
    let check = |file: &str, expected: &str| {
        let mut diagnostics = Diagnostics::default();
        let order = Order { from: None, target: target(), verify: true };
        let compiled = pipeline::compile(&fixture(file), &job, order, &mut Cursor::new(Vec::new()), &mut diagnostics);
        assert!(compiled.expect("memory takes it").is_none(), "{file}");
        let of_target = |said: &&Diagnostic| said.code.name == "target/refused";
        let said: Vec<_> = diagnostics.iter().filter(of_target).map(|said| said.message.as_str()).collect();
        let chords = "the target gcode lays the blade along the tangent of curves only, not as a chord of them";
        assert_eq!(said, [format!("{chords}{expected}")], "{file}");
    };
    check("iso/seed-circle.cut", "");
    check("markers/metric-six-pieces.cut", ": 21 cuts are like that, the first in block 24");
}

#[test]
fn what_the_lines_of_a_profile_cannot_say_is_refused() {
    let check = |change: fn(&mut Job), file: &str, expected: &str| {
        let mut job = Job::default();
        change(&mut job);
        let mut diagnostics = Diagnostics::default();
        let order = Order { from: None, target: target(), verify: true };
        let compiled = pipeline::compile(&fixture(file), &job, order, &mut Cursor::new(Vec::new()), &mut diagnostics);
        assert!(compiled.expect("memory takes it").is_none(), "{expected}");
        let errors: Vec<_> = diagnostics.iter().filter(|said| said.code.name != "path/overcut").collect();
        assert!(errors[0].code.name == "target/refused" && errors[0].message.starts_with(expected), "{errors:?}");
    };
    let (drills, events) = ("markers/drills-and-slits.cut", "iso/speeds-and-events.cut");
    let down = "`gcode.drill_down` has no step, but the file drills";
    check(|job| job.profile.gcode.drill_down.clear(), drills, down);
    check(|job| job.profile.gcode.drill_up.clear(), drills, "`gcode.drill_up` has no step");
    let alike = "`gcode.drill_down` tells no drills apart, but the file asks for drill 2";
    check(|job| job.profile.gcode.drill_down = vec!["M64 P9".parse().expect("a step")], drills, alike);
    check(|job| job.profile.gcode.stop.clear(), events, "`gcode.stop` has no step, but the file stops");
    check(|job| job.profile.gcode.advance.clear(), events, "`gcode.advance` has no step, but the file advances");
}

#[test]
fn a_small_program_reads_well() {
    let (program, _) = compile(&fixture("iso/seed-circle.cut"), &Job::default());
    insta::assert_snapshot!(program);
}
