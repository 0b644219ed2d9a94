//! The scan of the source bytes agrees with the reader, and sees what a marker lacks.

use std::fs;
use std::path::Path;

use cutc::diagnostic::Diagnostics;
use cutc::geom::Vector;
use cutc::ir::{Finding, Marker};
use cutc::machine::profile::CodeUse;
use cutc::machine::{Job, MachineProfile};
use cutc::pipeline::{self, Judged};
use cutc::source::Source;
use cutc::verify::{Census, Works, source_audit};

use crate::verifier::case;

/// Single bytes that are damaged, and the largest file that is.
const DAMAGES: usize = 10_000;
const SMALL: usize = 4096;

/// Every cut file, with its marker as read.
fn sources() -> Vec<(Source, Marker)> {
    sources_of(&["iso", "markers"], "iso")
}

/// Every file of some folders, which are of one dialect, with its marker as read.
fn sources_of(folders: &[&str], dialect: &str) -> Vec<(Source, Marker)> {
    let mut paths = Vec::new();
    for folder in folders {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures").join(folder);
        paths.extend(fs::read_dir(root).expect("readable").map(|entry| entry.expect("readable").path()));
    }
    paths.sort();
    let read = |path: &std::path::PathBuf| {
        let name = path.file_name().expect("a file").to_string_lossy();
        let source = Source::new(name, fs::read(path).expect("readable")).expect("fixtures are small");
        let mut diagnostics = Diagnostics::default();
        let input = pipeline::read(&source, None, &Job::default(), &mut diagnostics).expect("it is read");
        assert_eq!(input.dialect.name, dialect, "{}", source.name());
        let marker = cutc::pipeline::marker_of(input.dialect, &source, &Job::default(), &mut diagnostics);
        (source, marker)
    };
    paths.iter().map(read).collect()
}

fn audit(source: &Source, marker: &Marker) -> Vec<Finding> {
    source_audit("iso", source.bytes(), &Census::of(marker), &MachineProfile::default()).expect("cut files have a scan")
}

#[test]
fn the_scan_finds_what_the_reader_finds_in_every_cut_file() {
    let mut differing = Vec::new();
    for (source, marker) in sources() {
        let broken: Vec<Finding> = audit(&source, &marker).into_iter().filter(|finding| !finding.holds()).collect();
        if !broken.is_empty() {
            differing.push(format!("{}: {broken:?}", source.name()));
        }
    }
    assert!(differing.is_empty(), "{differing:#?}");
}

#[test]
fn the_passes_lose_nothing_of_any_cut_file_or_plot() {
    for (source, read) in sources().into_iter().chain(sources_of(&["hpgl"], "hpgl")) {
        let mut diagnostics = Diagnostics::default();
        let input = pipeline::read(&source, None, &Job::default(), &mut diagnostics).expect("it is read");
        if !diagnostics.has_errors() {
            let finding = Works::of(&read).kept(&input.marker, &Job::default().profile);
            assert!(finding.holds(), "{}: {finding:?}", source.name());
        }
    }
}

#[test]
fn what_a_pass_loses_is_seen_but_for_slits_that_stand_twice_and_pieces_not_chosen() {
    let job = Job::default();
    let read = case::marker("drills-and-slits", &job);
    let works = Works::of(&read);
    let lost = |change: &dyn Fn(&mut Marker)| {
        let mut marker = read.clone();
        change(&mut marker);
        works.kept(&marker, &Job::default().profile).worst
    };
    let with_slits = read.pieces.iter().position(|piece| !piece.notches.is_empty()).expect("it has slits");
    let with_holes = read.pieces.iter().position(|piece| !piece.drills.is_empty()).expect("it has holes");
    assert_eq!(lost(&|_| {}), 0.0);
    assert_eq!(lost(&|marker| assert!(marker.pieces[with_slits].notches.pop().is_some())), 1.0);
    assert_eq!(lost(&|marker| assert!(marker.pieces[with_holes].drills.pop().is_some())), 1.0);
    assert_eq!(lost(&|marker| assert!(marker.list.cursor(&mut marker.pieces[0].contours[0].range).remove())), 1.0);
    assert_eq!(lost(&|marker| assert!(marker.pieces.pop().is_some())), 0.0);
    // A twin, drawn the other way round in another block.
    let mut twice = read.clone();
    let mut twin = twice.pieces[with_slits].notches[0];
    (twin.root, twin.tip, twin.span.block) = (twin.tip, twin.root, 9999);
    twice.pieces[with_slits].notches.push(twin);
    assert!(Works::of(&twice).kept(&read, &Job::default().profile).holds());
}

#[test]
fn half_of_an_outline_that_is_drawn_twice_is_missed() {
    let name = "notch-stroke-on-an-outline-drawn-twice.plt";
    let plots = sources_of(&["hpgl"], "hpgl");
    let (source, read) = plots.iter().find(|(source, _)| source.name() == name).expect("a fixture");
    let (job, mut said) = (Job::default(), Diagnostics::default());
    let mut marker = pipeline::read(source, None, &job, &mut said).expect("it is read").marker;
    let works = Works::of(read);
    assert!(works.kept(&marker, &job.profile).holds());
    let outline = marker.pieces[0].contours.iter_mut().find(|contour| contour.closed).expect("an outline");
    // A chord in the place of two sides.
    let mut cursor = marker.list.cursor(&mut outline.range);
    assert!(cursor.advance());
    assert!(cursor.remove());
    assert!(!works.kept(&marker, &job.profile).holds());
}

/// A job that ignores some codes.
fn ignoring(names: &[&str]) -> Job {
    let mut job = Job::default();
    job.profile.codes = names.iter().map(|name| ((*name).to_owned(), CodeUse::Ignore)).collect();
    job
}

/// What the scan and the comparison behind the passes find wrong with a cut file; `None` when it has errors.
fn faults(bytes: &[u8], job: &Job) -> Option<Vec<Finding>> {
    let source = Source::new("a.cut", bytes.to_vec()).expect("small");
    let mut diagnostics = Diagnostics::default();
    let judged = pipeline::read_to_judge(&source, None, job, &mut diagnostics);
    let Judged { reading, .. } = judged.filter(|_| !diagnostics.has_errors())?;
    let mut findings = source_audit("iso", bytes, &reading.census, &job.profile)?;
    findings.push(reading.kept);
    findings.retain(|finding| !finding.holds());
    Some(findings)
}

#[test]
fn what_a_file_cuts_to_and_fro_or_twice_is_cut_once_and_nothing_is_lost() {
    const SQUARE: &str = "X0Y0*M14*X1000Y0*X1000Y1000*X0Y1000*X0Y0*M15*";
    let there = "X500Y0*M14*X500Y50*M15*";
    let back = "X500Y50*M14*X500Y0*M15*";
    let and_back = "X500Y0*M14*X500Y50*X500Y0*M15*";
    let named = "X500Y0*M14*M19*X500Y50*M15*";
    let bar = "X470Y50*M14*X530Y50*M15*";
    let bar_and_back = "X470Y50*M14*X530Y50*X470Y50*M15*";
    let slits: [&[&str]; 11] = [
        &[and_back],
        &[there, there],
        &[there, back],
        &[and_back, and_back],
        &[named, there],
        &[there, named],
        &[named, and_back],
        &[there, bar],
        &[and_back, bar_and_back],
        &[named, bar, bar],
        &[there, bar_and_back, bar],
    ];
    for slits in slits {
        for piece in ["N1*", ""] {
            for blocks in [[SQUARE, &slits.concat()], [&slits.concat(), SQUARE]] {
                let file = format!("H1*G71*M15*{piece}{}M0*", blocks.concat());
                assert_eq!(faults(file.as_bytes(), &Job::default()), Some(Vec::new()), "{file}");
            }
        }
    }
}

#[test]
fn the_scan_obeys_the_codes_that_the_reader_obeys() {
    let body = "X0Y0*M14*X1000Y0*X1000Y1000*X0Y0*M15*";
    let lettered = body.replace("M14", "B").replace("M15", "A");
    let both = format!("H1*G71*M15*N1*{body}X2000Y0*B*X3000Y0*X3000Y900*X2000Y0*A*M31*4500Y500*FRONT 1*A1000*M0*");
    let rest = format!("H1*G71*N1*{lettered}X800Y100*R*M43*X700Y100*M0*");
    let arcs = "H1*G71*N1*X0Y0*M14*G02*X1000Y0I500*X0Y0R500*G00*X0Y900*X0Y0*M15*M0*";
    let mirrored = format!("H1*G71*N1*X300Y300M31*FRONT*HTRUOF*X400Y300M31*{body}M0*");
    // A number behind an unknown code may be the code's own.
    assert!(faults(both.replace("A1000*", "A1000Y1000*").as_bytes(), &Job::default()).is_none());
    for file in [both.as_str(), &rest, arcs, &mirrored] {
        assert!(faults(file.as_bytes(), &Job::default()).is_some(), "{file}");
        for codes in
            [&[][..], &["B"], &["A"], &["M14"], &["M15"], &["M14", "M15"], &["A", "B"], &["R"], &["G2"], &["M31"]]
        {
            assert!(
                faults(file.as_bytes(), &ignoring(codes)).is_none_or(|found| found.is_empty()),
                "{codes:?}: {file}"
            );
        }
    }
}

#[test]
fn a_damaged_byte_that_leaves_no_error_leaves_no_difference_either() {
    let sources = sources();
    let small: Vec<&[u8]> = sources.iter().map(|(source, _)| source.bytes()).filter(|b| b.len() < SMALL).collect();
    let codes = [&[][..], &["M14"], &["B"], &["M15"], &["M19"], &["M31"], &["R", "M43"], &["G2"], &["M0"]];
    let mut random = fastrand::Rng::with_seed(7);
    let mut judged = 0;
    for i in 0..DAMAGES {
        let bytes = small[i % small.len()];
        let mut damaged = bytes.to_vec();
        let at = random.usize(..bytes.len());
        // Letters, digits and asterisks, as files have them, damage more than other bytes: those are mostly refused.
        damaged[at] = if random.bool() { random.u8(..) } else { bytes[random.usize(..bytes.len())] };
        let job = ignoring(codes[random.usize(..codes.len())]);
        if let Some(found) = faults(&damaged, &job) {
            judged += 1;
            assert_eq!(found, [], "{:?}: {}", job.profile.codes.keys(), damaged.escape_ascii());
        }
    }
    assert!(judged > DAMAGES / 5, "only {judged} were read without errors");
}

#[test]
fn an_overcut_is_no_loss_where_the_outline_starts_amid_an_edge() {
    for (start, is_overcut) in [(100, true), (103, true), (140, true), (180, false)] {
        let places = "X3100Y100*X3100Y2100*X100Y2100*X100Y100*X100Y70*";
        let file = format!("H1*G71*N1*X100Y{start}*M14*{places}M15*N2*X3300Y100*M14*X5300Y100*X5300Y900*M15*M0*");
        assert_eq!(faults(file.as_bytes(), &ignoring(&[])), Some(Vec::new()), "{start}");
        let mut said = Diagnostics::default();
        let source = Source::new("a.cut", file.into_bytes()).expect("small");
        pipeline::read(&source, None, &Job::default(), &mut said);
        assert_eq!(said.iter().any(|found| found.code.name == "marker/overrun"), is_overcut, "{start}");
    }
}

#[test]
fn a_marker_that_lacks_something_of_the_file_is_refused() {
    type Loss = fn(&mut Marker) -> bool;
    let losses: &[(&str, Loss)] = &[
        ("source/bounds", |marker| {
            // The points farthest to the left, a unit further.
            let least = marker.extent().min.x;
            let unit = marker.unit;
            let Marker { list, pieces, .. } = marker;
            let shifted = |p: &mut cutc::geom::Point| {
                if p.x == least {
                    p.x -= unit;
                }
            };
            for contour in pieces.iter_mut().flat_map(|piece| &mut piece.contours) {
                let mut cursor = list.cursor(&mut contour.range);
                loop {
                    shifted(cursor.from_mut());
                    shifted(cursor.to_mut());
                    if !cursor.advance() {
                        break;
                    }
                }
            }
            true
        }),
        ("source/length", |marker| {
            let Marker { list, pieces, .. } = marker;
            let Some(contour) = pieces.iter_mut().find_map(|piece| piece.contours.first_mut()) else { return false };
            let mut cursor = list.cursor(&mut contour.range);
            *cursor.from_mut() += Vector::new(0.3, 0.1);
            true
        }),
        ("source/points", |marker| {
            let Marker { list, pieces, .. } = marker;
            let Some(contour) = pieces.iter_mut().find_map(|piece| piece.contours.first_mut()) else { return false };
            list.cursor(&mut contour.range).remove()
        }),
        ("source/points", |marker| {
            let piece = marker.pieces.iter_mut().find(|piece| !piece.notches.is_empty());
            piece.is_some_and(|piece| piece.notches.pop().is_some())
        }),
        ("source/drills", |marker| {
            let piece = marker.pieces.iter_mut().find(|piece| !piece.drills.is_empty());
            piece.is_some_and(|piece| piece.drills.pop().is_some())
        }),
    ];
    for (rule, lose) in losses {
        let mut refused = 0;
        for name in case::names() {
            let source = case::source(name);
            let mut marker = case::marker(name, &Job::default());
            if lose(&mut marker) {
                let broken = audit(&source, &marker).into_iter().any(|f| f.rule.name == *rule && !f.holds());
                assert!(broken, "{rule} of {name}");
                refused += 1;
            }
        }
        assert!(refused >= 2, "{rule}");
    }
}
