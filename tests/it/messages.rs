//! What is said about files with many findings: little, the worst first; and all of it to programs.

use std::fmt::Write as _;

use crate::support::room::{DONE, FAULTY, Room};

/// Squares of 100 mm in a row, each 0.3 mm into the next, with a label each.
fn overlapping(count: u32) -> String {
    let mut blocks = "H1*G71*".to_owned();
    for i in 0..count {
        let (left, right) = (i * 997, i * 997 + 1000);
        let _ = write!(
            blocks,
            "N{}*X{}Y500M31*FRONT {i}*M15*X{left}Y0*M14*X{right}Y0*X{right}Y1000*X{left}Y1000*X{left}Y0*M15*",
            i + 1,
            left + 500
        );
    }
    blocks + "M0*"
}

#[test]
fn warnings_of_a_code_are_summed_up_and_each_is_told_to_who_asks() {
    let room = Room::with("row.cut", &overlapping(68));
    let (_, said) = room.expect("check row.cut", DONE);
    assert_eq!(said.matches("warning[marker/overlapping-pieces]").count(), 1, "{said}");
    assert!(said.contains("67 findings on 67 pieces, the worst: the outlines of"), "{said}");
    assert!(said.contains("67 warnings (`--all` tells each): 67 marker/overlapping-pieces"), "{said}");
    assert!(said.contains("overlap by 0.30 mm") && said.lines().count() < 8, "{said}");
    assert!(said.contains("--> row.cut: piece 2 \"FRONT 1\" at 100.0, "), "{said}");
    let (_, all) = room.expect("check --all row.cut", DONE);
    assert_eq!(all.matches("warning[marker/overlapping-pieces]").count(), 67, "{all}");
    assert_eq!(room.expect("check -q row.cut", DONE).1, "");
    let (json, beside) = room.expect("check row.cut --format json", DONE);
    let value: serde_json::Value = serde_json::from_str(&json).expect("JSON");
    let first = &value[0]["warnings"][0];
    assert_eq!(value[0]["warnings"].as_array().map(Vec::len), Some(67));
    assert_eq!((first["piece"].as_u64(), first["label"].as_str()), (Some(2), Some("FRONT 1")));
    assert!((first["by_mm"].as_f64().expect("a depth") - 0.3).abs() < 1e-9, "{first}");
    assert_eq!(value[0]["tally"][0]["count"], 67);
    assert!(beside.lines().count() < 5, "{beside}");
}

#[test]
fn what_touches_but_for_rounding_does_not_overlap() {
    let touching = overlapping(3).replace("X997", "X1000").replace("X1997", "X2000").replace("X1994", "X2000");
    let room = Room::with("row.cut", &touching);
    assert!(!room.expect("check row.cut", DONE).1.contains("overlapping"));
}

#[test]
fn a_marker_off_the_table_is_told_how_to_move() {
    let room = Room::with("row.cut", &overlapping(1));
    let (_, said) = room.expect("check row.cut --set table.x_mm=[5,300]", FAULTY);
    assert!(said.contains("error[marker/off-table]") && said.contains("move the marker by X +12.4 mm"), "{said}");
    let (_, said) = room.expect("check row.cut --set table.x_mm=[5,100]", FAULTY);
    assert!(said.contains("does not fit") && said.contains("5.0 mm more"), "{said}");
    let (_, said) = room.expect("check row.cut --set table.x_mm=[0.5,300]", DONE);
    assert!(said.contains("warning[marker/over-the-edge]"), "{said}");
    let (_, said) = Room::with("corner.cut", "N1*X0Y0*M14*X400Y0*X400Y300*X0Y300*X0Y0*M15*M0*")
        .expect("compile corner.cut --set table.x_mm=[0,3000] --set table.y_mm=[0,1500]", DONE);
    assert!(said.contains("warning[marker/over-the-edge]") && said.contains("sheet.origin = \"corner\""), "{said}");
    let (_, said) = room.expect("check row.cut --set table.strict=true", 2);
    assert!(said.contains("there is no key `table.strict`") && said.contains("leave it out"), "{said}");
}
