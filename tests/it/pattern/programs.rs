//! What programs write beside the convention: slits as lines, places that are none, sizes side by side, keys in other languages,
//! units that nobody meant, and pieces that are at fault among others that are not.

use cutc::geom::{Extent, Point};
use cutc::ir::Marker;
use cutc::ir::marker::Piece;
use cutc::machine::patterns::PatternUnit;
use cutc::machine::{Job, Numbers, Selection, Start};
use fastrand::Rng;

use super::audit::broken;
use super::spurs::written;
use super::writer::{Drawn, Place, Writer};
use super::{as_read, source};
use crate::support::room::{DONE, FAULTY, Room};

fn rectangle([width, height]: Place) -> Vec<Place> {
    vec![[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]]
}

/// The contours of a marker, place by place.
fn contours(marker: &Marker) -> Vec<Vec<Point>> {
    marker.contours().map(|(_, contour)| marker.points(contour)).collect()
}

/// What a file cuts and what is said of it; the second reading agrees.
fn read(text: &str, job: &Job) -> (Marker, Vec<&'static str>) {
    let source = source(text);
    let (marker, found) = as_read(&source, job);
    if marker.contours().count() > 0 {
        assert_eq!(broken(&source, &marker, job), [""; 0], "{text}");
    }
    (marker, found)
}

/// A ring from its least place on, in the order in which that is less.
fn ring(places: &[Point]) -> Vec<[i64; 2]> {
    let mut ring: Vec<[i64; 2]> =
        places[1..].iter().map(|at| [at.x, at.y].map(|value| (1e6 * value).round() as i64)).collect();
    let least = |ring: &[[i64; 2]]| {
        let starts = (0..ring.len()).map(|k| [&ring[k..], &ring[..k]].concat());
        starts.min().unwrap_or_default()
    };
    let forwards = least(&ring);
    ring.reverse();
    forwards.min(least(&ring))
}

#[test]
fn a_line_that_stands_off_an_outline_is_a_slit_however_the_outline_is_drawn() {
    for seed in 0..80 {
        let mut random = Rng::with_seed(seed);
        let [width, height] = [0; 2].map(|_| f64::from(random.u32(100..500)));
        let at = (width * random.f64()).round().clamp(20.0, width - 20.0);
        let depth = f64::from(random.u32(4..14));
        let spur = [[at, 0.0], [at, depth]];
        let outline = [&[[0.0, 0.0], [at, 0.0]], &rectangle([width, height])[1..]].concat();
        // The same as a way of one polyline.
        let spike = [&outline[..2], &[spur[1], spur[0]], &outline[2..]].concat();
        let mut file = Writer::begin();
        file.block("A").outline(1, &spike, Drawn::Closed).end_block();
        let (wanted, found) = read(&file.end(&["UNITS: METRIC"]), &Job::default());
        assert!(found.is_empty(), "{found:?}");
        let mut parts: Vec<Vec<Place>> = match random.u8(..3) {
            // Broken where the spur stands, or anywhere, or nowhere.
            0 => vec![outline[1..].iter().chain(&outline[..1]).copied().collect(), outline[..2].to_vec()],
            1 => (0..outline.len()).map(|k| vec![outline[k], outline[(k + 1) % outline.len()]]).collect(),
            _ => vec![rectangle([width, height]).into_iter().chain([[0.0, 0.0]]).collect()],
        };
        parts.push(spur.to_vec());
        if random.bool() {
            parts.push(vec![spur[1], spur[0]]); // there and back
        }
        let text = written(&mut random, parts);
        let (marker, found) = read(&text, &Job::default());
        assert!(found.is_empty(), "seed {seed}: {found:?} {text}");
        assert_eq!(ring(&contours(&marker)[0]), ring(&contours(&wanted)[0]), "seed {seed}");
        // A slit that is lost is seen.
        let mut lost = marker;
        let contour = lost.pieces[0].contours[0];
        let kept: Vec<_> = lost.list.vertices(contour.range).filter(|(at, _)| (at.y - depth).abs() > 1e-9).collect();
        let (points, spans): (Vec<_>, Vec<_>) = kept.into_iter().unzip();
        lost.pieces[0].contours[0].range = lost.list.append_line(&points, &spans).expect("a line");
        assert!(!broken(&source(text), &lost, &Job::default()).is_empty(), "seed {seed}");
    }
}

/// Pieces of so many sizes, each a little larger, put where `place` says.
fn sizes(count: usize, texts: &[&str], place: impl Fn(usize) -> Place) -> String {
    let mut file = Writer::begin();
    for k in 0..count {
        let width = 200.0 + 10.0 * k as f64;
        file.block(&format!("A-{k}")).outline(1, &rectangle([width, 150.0]), Drawn::Closed);
        file.text(&format!("SIZE: {k}")).text("PIECE NAME: A").end_block();
    }
    let mut text = file.end(&[]);
    let mut inserts = Writer::default();
    for text in texts {
        inserts.text(text);
    }
    for k in 0..count {
        let [x, y] = place(k);
        inserts.group(0, "INSERT").group(8, 1).group(2, format!("A-{k}")).group(10, x).group(20, y);
    }
    let end = text.rfind("  0\nENDSEC\n  0\nEOF").expect("the end");
    text.insert_str(end, inserts.text_so_far());
    text
}

#[test]
fn sizes_beside_each_other_are_all_cut_and_over_each_other_one_is() {
    let texts = ["UNITS: METRIC", "SAMPLE SIZE: 1"];
    for count in 2..6 {
        let (marker, found) = read(&sizes(count, &texts, |k| [300.0 * k as f64, 0.0]), &Job::default());
        assert_eq!((marker.pieces.len(), found), (count, vec!["dxf/sizes-placed"]));
        let (marker, found) = read(&sizes(count, &texts, |k| [3.0 * k as f64, 40.0]), &Job::default());
        assert_eq!((marker.pieces.len(), found.len()), (1, 0), "{found:?}");
        let (marker, found) = read(&sizes(count, &texts, |_| [0.0; 2]), &Job::default());
        assert_eq!((marker.pieces.len(), found.len()), (1, 0), "{found:?}");
    }
}

#[test]
fn places_that_put_pieces_on_each_other_are_none() {
    for seed in 0..40 {
        let mut random = Rng::with_seed(seed);
        let count = random.usize(2..7);
        let offsets: Vec<Place> = (0..count).map(|_| [0; 2].map(|_| 90.0 * random.f64())).collect();
        let unsized_texts = |text: String| text.replace("SIZE:", "NUMBER:");
        let piled = unsized_texts(sizes(count, &["UNITS: METRIC"], |k| offsets[k]));
        let plain = unsized_texts(sizes(count, &["UNITS: METRIC"], |_| [0.0; 2]));
        let (marker, found) = read(&piled, &Job::default());
        let (row, of_row) = read(&plain, &Job::default());
        assert_eq!(
            (found, of_row),
            (vec!["dxf/no-places", "dxf/no-sizes", "dxf/cutting-sample"], vec!["dxf/no-sizes", "dxf/cutting-sample"]),
            "{seed}"
        );
        assert_eq!(contours(&marker), contours(&row), "seed {seed}");
        let apart =
            unsized_texts(sizes(count, &["UNITS: METRIC"], |k| [400.0 * k as f64 + offsets[k][0], offsets[k][1]]));
        let (marker, found) = read(&apart, &Job::default());
        assert!(found.is_empty(), "seed {seed}: {found:?}");
        let first = Extent::of(&contours(&marker)[0]).min;
        assert!((first - Point::from(offsets[0])).norm() < 1e-9);
        // A row is not taken for places that part the pieces.
        assert!(!broken(&source(apart), &row, &Job::default()).is_empty(), "seed {seed}");
    }
}

#[test]
fn keys_say_the_same_in_every_language() {
    let set = |[size, sample, units, quantity]: [&str; 4]| {
        let mut file = Writer::begin();
        for (name, width) in [("S", 200.0), ("M", 210.0)] {
            file.block(&format!("A-{name}")).outline(1, &rectangle([width, 100.0]), Drawn::Closed);
            file.text(&format!("{size}: {name}")).text(&format!("{quantity}: 1,1")).end_block();
        }
        file.end(&[&format!("{units}: ENGLISH"), &format!("{sample}: M")])
    };
    let (english, found) = read(&set(["SIZE", "SAMPLE SIZE", "UNITS", "QUANTITY"]), &Job::default());
    assert_eq!((english.pieces.len(), found), (2, vec!["dxf/cutting-sample"]));
    for keys in [
        ["Size Name", "Base Size", "Unit", "Qty"],
        ["Größe", "Basisgröße", "Einheit", "Anzahl"],
        ["Taille", "Taille de base", "Unités", "Quantité"],
        ["Taglia", "Taglia base", "Unità", "Quantità"],
        ["Talla", "Talla base", "Unidades", "Cantidad"],
        ["Tamanho", "Tamanho base", "Unidade", "Quantidade"],
        ["Maat", "Basismaat", "Eenheid", "Aantal"],
        ["Rozmiar", "Rozmiar bazowy", "Jednostki", "Ilość"],
        ["Beden", "Baz beden", "BIRIM", "Adet"],
        ["Размер", "Базовый размер", "Единицы", "Количество"],
        ["Розмір", "Базовий розмір", "Одиниці", "Кількість"],
        ["尺码", "基码", "单位", "数量"],
    ] {
        let (marker, found) = read(&set(keys), &Job::default());
        assert_eq!(found, ["dxf/cutting-sample"], "{keys:?}");
        assert_eq!(contours(&marker), contours(&english), "{keys:?}");
    }
}

#[test]
fn a_unit_that_makes_kilometres_is_not_believed() {
    let file = |unit: u32, size: Place| {
        let mut file = Writer::default();
        file.group(0, "SECTION").group(2, "HEADER").group(9, "$INSUNITS").group(70, unit).group(0, "ENDSEC");
        file.group(0, "SECTION").group(2, "ENTITIES").outline(1, &rectangle(size), Drawn::Closed);
        file.group(0, "ENDSEC").group(0, "EOF");
        file.text_so_far().to_owned()
    };
    let (mm, found) = read(&file(4, [500.0, 300.0]), &Job::default());
    assert!(found.is_empty());
    let (doubted, found) = read(&file(6, [500.0, 300.0]), &Job::default());
    assert_eq!((contours(&doubted), found), (contours(&mm), vec!["dxf/unit-doubted"]));
    let (pocket, found) = read(&file(6, [150.0, 160.0]), &Job::default());
    assert_eq!((contours(&pocket)[0].len(), found), (5, vec!["dxf/unit-doubted"]), "a line of 620 m");
    // Inches that nobody wears are cut as they are said, with a doubt; not where the unit is said beside the file.
    let (inches, found) = read(&file(1, [600.0, 200.0]), &Job::default());
    assert_eq!((inches.extent().size().0.round(), found), (15_240.0, vec!["dxf/unit-doubted"]));
    let mut job = Job::default();
    job.profile.dxf.unit = PatternUnit::Inch;
    assert!(read(&file(1, [600.0, 200.0]), &job).1.is_empty());
    // Metres that are meant.
    let (metres, found) = read(&file(6, [0.5, 0.3]), &Job::default());
    let is_same = contours(&metres)[0].iter().zip(&contours(&mm)[0]).all(|(a, b)| (a - b).norm() < 1e-9);
    assert!(is_same && found.is_empty(), "{found:?}");
}

#[test]
fn damage_on_layers_that_are_not_cut_changes_nothing() {
    for seed in 0..60 {
        let mut random = Rng::with_seed(seed);
        let layer = [5, 7, 8, 14, 15, 22][random.usize(..6)];
        let mut file = Writer::begin();
        file.block("A").outline(1, &rectangle([200.0, 100.0]), Drawn::Closed).point(4, [50.0, 0.0], [5.0, 0.0]);
        let whole = file.clone();
        match random.u8(..4) {
            0 => file.line(layer, [[10.0, 10.0], [1e9, 20.0]]),
            1 => file.group(0, "LINE").group(8, layer).group(10, "1O").group(20, 5).group(11, 5).group(21, 5),
            2 => file.group(0, "POLYLINE").group(8, layer).group(66, 1).group(0, "VERTEX").group(8, layer).group(10, 3),
            _ => file.group(0, "ARC").group(8, layer).group(10, 3).group(20, 3),
        };
        let texts = ["UNITS: METRIC"];
        let [whole, damaged] = [whole, file].map(|mut file| {
            file.end_block();
            read(&file.end(&texts), &Job::default())
        });
        assert!(
            whole.1.is_empty() && damaged.1.iter().all(|code| *code == "dxf/damaged-drawing"),
            "{seed}: {:?}",
            damaged.1
        );
        assert!(!damaged.1.is_empty(), "seed {seed}");
        assert_eq!(contours(&damaged.0), contours(&whole.0), "seed {seed}");
    }
}

/// Three pieces, of which the second is at fault in one of several ways, or missing.
fn three(fault: Option<u8>) -> String {
    let mut file = Writer::begin();
    file.block("FRONT").outline(1, &rectangle([200.0, 100.0]), Drawn::Closed).text("PIECE NAME: FRONT").end_block();
    if let Some(fault) = fault {
        file.block("POCKET").text("PIECE NAME: POCKET").text("QUANTITY: 1,1");
        match fault {
            0 => file.polyline(1, &rectangle([90.0, 80.0]), false),
            1 => file.outline(1, &rectangle([90.0, 80.0]), Drawn::Closed).line(6, [[300.0, 0.0], [400.0, 0.0]]),
            2 => file.group(0, "LINE").group(8, 1).group(10, "1O").group(20, 5).group(11, 5).group(21, 5),
            _ => file.group(0, "SPLINE").group(8, 1).group(10, 3).group(20, 5),
        };
        file.end_block();
    }
    file.block("BACK").outline(1, &rectangle([150.0, 90.0]), Drawn::Closed).text("PIECE NAME: BACK").end_block();
    file.end(&["UNITS: METRIC"])
}

#[test]
fn a_piece_at_fault_is_named_and_all_others_can_be_cut_without_it() {
    let (whole, _) = read(&three(None), &Job::default());
    for fault in 0..4 {
        let text = three(Some(fault));
        let room = Room::new();
        room.write("set.dxf", text.as_bytes());
        let said = room.says("compile set.dxf -t csv", FAULTY);
        assert!(said.contains("piece 2 \"PIECE NAME: POCKET\"") && said.contains("`--skip 2,3`"), "{said}");
        let said = room.says("compile set.dxf -t csv --skip 2,3", DONE);
        assert!(said.contains("rules hold"), "{said}");
        assert!(room.says("compile set.dxf -t csv --skip 2", FAULTY).contains("`--skip 3`"));
        let skip = cutc::machine::Numbers::parse("2,3").expect("numbers");
        let job = Job { selection: Selection { skip: Some(skip), ..Selection::default() }, ..Job::default() };
        let (marker, found) = read(&text, &job);
        assert_eq!(found, ["dxf/cutting-sample"], "{fault}");
        assert_eq!(contours(&marker), contours(&whole), "{fault}");
        // Nobody may leave out what nobody asked to be left out.
        assert!(!broken(&source(text), &marker, &Job::default()).is_empty(), "{fault}");
    }
}

/// A job that leaves out what three options say.
fn selecting([pieces, skip]: [Option<&str>; 2], resume_from: Option<&str>) -> Job {
    let [pieces, skip] = [pieces, skip].map(|text| text.map(|text| Numbers::parse(text).expect("numbers")));
    let resume_from = resume_from.map(|text| Start::parse(text).expect("a piece"));
    Job { selection: Selection { pieces, skip, resume_from, bites: None }, ..Job::default() }
}

#[test]
fn a_piece_is_left_out_by_its_own_numbers_alone() {
    let text = three(Some(0));
    let (marker, _) = read(&text, &selecting([None, Some("2,3")], None));
    assert_eq!(marker.pieces.len(), 4);
    // The same file with the pocket closed: nothing is at fault in it.
    let sound = text.replacen(" 70\n0\n", " 70\n1\n", 1);
    assert_ne!(sound, text);
    for text in [text, sound] {
        let refused = |job: &Job, marker: &Marker| !broken(&source(&*text), marker, job).is_empty();
        for selection in [[None, Some("2,3")], [None, Some("1-3")], [Some("1,4"), None], [Some("1-3"), Some("2-3")]] {
            assert!(!refused(&selecting(selection, None), &marker), "{selection:?}");
        }
        for selection in [[None, Some("1")], [None, Some("2")], [None, Some("3,4")], [Some("1,2,4"), None]] {
            assert!(refused(&selecting(selection, None), &marker), "{selection:?}");
        }
        assert!(refused(&selecting([None; 2], Some("4")), &marker));
        let asked = selecting([None, Some("2,3")], None);
        let changes: [fn(&mut Marker); 8] = [
            |marker| marker.drawing.as_mut().expect("an account").pieces_left_out.clear(),
            |marker| _ = marker.pieces.remove(1),
            |marker| (1..4).for_each(|k| marker.pieces[k].number = [3, 1, 2][k - 1]),
            |marker| marker.pieces.swap(0, 1),
            |marker| marker.pieces[1].span = marker.pieces[3].span,
            |marker| marker.pieces.push(Piece { number: 5, ..Piece::default() }),
            |marker| marker.pieces.insert(0, Piece { number: 0, ..Piece::default() }),
            |marker| {
                // A sound one under the number of one that is left out.
                marker.pieces[1].contours = std::mem::take(&mut marker.pieces[0].contours);
                let [front, pocket] = [0, 1].map(|k| marker.pieces[k].span);
                (marker.pieces[0].span, marker.pieces[1].span) = (pocket, front);
            },
        ];
        for (k, change) in changes.into_iter().enumerate() {
            let mut marker = marker.clone();
            change(&mut marker);
            assert!(refused(&asked, &marker), "change {k}");
        }
        // A piece more, of which nothing is cut, moves the numbers on.
        let mut moved = marker.clone();
        moved.pieces.insert(1, Piece { span: moved.pieces[0].span, ..Piece::default() });
        moved.pieces.iter_mut().zip(1..).for_each(|(piece, number)| piece.number = number);
        assert!(refused(&selecting([None, Some("3,4")], None), &moved));
    }
}

#[test]
fn a_piece_that_insertions_place_is_left_out_by_its_own_numbers_alone() {
    let placed = |fault: Option<u8>| {
        let blocks = three(fault);
        let blocks = blocks.split("  0\nENDSEC\n  0\nSECTION\n  2\nENTITIES\n").next().expect("blocks").to_owned();
        let mut inserts = Writer::default();
        inserts.group(0, "ENDSEC").group(0, "SECTION").group(2, "ENTITIES").text("UNITS: METRIC");
        for (k, name) in ["BACK", "POCKET", "FRONT", "POCKET"].into_iter().enumerate() {
            inserts.group(0, "INSERT").group(8, 1).group(2, name).group(10, 300 * k + 10).group(20, 10);
        }
        inserts.group(0, "ENDSEC").group(0, "EOF");
        format!("{blocks}{}", inserts.text_so_far())
    };
    let text = placed(Some(0));
    let (marker, _) = read(&text, &selecting([None, Some("2,4")], None));
    assert_eq!(marker.contours().count(), 2, "{text}");
    for (skip, is_right) in [("2,4", true), ("2-4", true), ("2,3", false), ("2", false), ("1,3", false)] {
        let broken = broken(&source(&*text), &marker, &selecting([None, Some(skip)], None));
        assert_eq!(broken.is_empty(), is_right, "{skip} {broken:?}");
    }
}
