//! Texts of plots hold any words, those of instructions too, and change nothing of what is drawn.

use cutc::diagnostic::Diagnostics;
use cutc::front::by_name;
use cutc::machine::Job;

use super::audit::audit;
use super::{as_read, outlines, source};

/// Words that hold mnemonics, alone or with numbers behind them.
const WORDS: [&str; 14] = [
    "SPORT",
    "PRESS",
    "PRINT",
    "BLACK",
    "RO 90",
    "SC0,100,0,100",
    "PU0,0",
    "PD9000,0,9000,9000",
    "IN",
    "PE7_PU",
    "EA900,900",
    "IP0,0,1,1",
    "SIZE 42-44",
    "PR-400 CI99",
];

/// An instruction with a text, and whether a semicolon may stand in it.
struct Carrier {
    before: &'static str,
    behind: &'static str,
    ends_at_semicolon: bool,
}

const fn carrier(before: &'static str, behind: &'static str) -> Carrier {
    Carrier { before, behind, ends_at_semicolon: false }
}

const CARRIERS: [Carrier; 11] = [
    carrier("LB", "\x03"),
    carrier("BL", "\x03"),
    carrier("BL", "\x03PB;"),
    carrier("WD", "\x03"),
    carrier("MG\"", "\";"),
    carrier("MG \"", "\""),
    Carrier { before: "MG", behind: ";", ends_at_semicolon: true },
    carrier("CO\"", "\""),
    carrier("CO\"a \"\"quoted\"\" ", "\";"),
    carrier("DT#,1;LB", "#DT;"),
    carrier("DT$;WD", "$DT;"),
];

const OUTLINES: [&str; 2] = [
    "PU400,400;PD4400,400,4400,2400,400,2400,400,400;PU;",
    "PU5000,400;PD9000,400;PD9000,2400;PD5000,2400;PD5000,400;PU;",
];

#[test]
fn words_in_texts_change_nothing_of_what_is_drawn() {
    let job = Job::default();
    let plain = outlines(&as_read(&source(format!("IN;SP1;{}{}SP0;", OUTLINES[0], OUTLINES[1])), &job));
    let check = |text: String| {
        let source = source(text.clone());
        let marker = as_read(&source, &job);
        assert_eq!(outlines(&marker), plain, "{}", text.escape_debug());
        assert_eq!(audit(&source, &marker, &job), [], "{}", text.escape_debug());
    };
    for Carrier { before, behind, ends_at_semicolon } in CARRIERS {
        for word in WORDS {
            for word in [word.to_owned(), format!("{word};PD1,1;"), format!("{word}\r\nPA;")] {
                if ends_at_semicolon && word.contains([';', '\n']) {
                    continue;
                }
                let said = format!("{before}{word}{behind}");
                let [one, other] = OUTLINES;
                check(format!("IN;SP1;{said}{one}{other}SP0;"));
                check(format!("IN;SP1;{one}{said}{other}SP0;"));
                check(format!("IN;SP1;{one}{other}{said}SP0;"));
            }
        }
    }
    for word in WORDS {
        let [one, other] = OUTLINES;
        check(format!("BP1,\"{word}\",5,1;SP1;{one}{other}SP0;"));
        check(format!("BP 1, \"{word};PD9,9;\" ,2,0,3,0;SP1;{one}{other}"));
        check(format!("BP1,{word};SP1;{one}{other}"));
    }
    for symbol in ["SMP;", "SM*;", "SMR", "SM;"] {
        let [one, other] = OUTLINES;
        check(format!("IN;SP1;{symbol}{one}{other}SP0;"));
    }
}

#[test]
fn words_in_quotes_that_nothing_asks_for_change_nothing_and_an_outline_there_is_refused() {
    let job = Job::default();
    let [one, other] = OUTLINES;
    let plain = outlines(&as_read(&source(format!("IN;SP1;{one}{other}SP0;")), &job));
    for word in WORDS {
        for said in [format!("MT\"{word}\";"), format!("PS \"{word}\"")] {
            let source = source(format!("IN;SP1;{one}{said}{other}SP0;"));
            let marker = as_read(&source, &job);
            assert_eq!((outlines(&marker), audit(&source, &marker, &job)), (plain.clone(), vec![]), "{said}");
        }
    }
    let lost = source(format!("IN;SP1;{one}MT\"PU0,0;pd9000,0,9000,9000,0,9000,0,0;\";{other}SP0;"));
    let mut found = Diagnostics::default();
    cutc::pipeline::marker_of(by_name("hpgl").expect("a dialect"), &lost, &job, &mut found);
    assert!(found.iter().any(|said| said.code.name == "hpgl/lost-place"));
}

#[test]
fn a_reader_that_runs_a_text_is_caught() {
    let job = Job::default();
    let [one, other] = OUTLINES;
    for said in ["WDPU0,0;PD9000,0,9000,9000;\x03", "BLPD9000,9000\x03", "MG\"PD9000,9000\";", "CO\"PD9000,9000\""] {
        let marker = as_read(&source(format!("IN;SP1;{one}{other}PU0,0;PD9000,9000;PU;")), &job);
        let source = source(format!("IN;SP1;{one}{other}PU0,0;{said}PU;"));
        let refused: Vec<&str> = audit(&source, &marker, &job).iter().map(|finding| finding.rule.name).collect();
        assert!(refused.contains(&"source/points") && refused.contains(&"source/length"), "{said:?}: {refused:?}");
    }
}

#[test]
fn a_text_without_its_terminator_swallows_no_outline() {
    let job = Job::default();
    let plain = outlines(&as_read(&source(format!("IN;SP1;{}{}SP0;", OUTLINES[0], OUTLINES[1])), &job));
    let [one, other] = OUTLINES;
    for before in ["LB", "BL", "WD"] {
        for end in [";", "\r\n", "\n"] {
            let source = source(format!("IN;SP1;{before}BACK{end}{one}LBFRONT\x03{other}SP0;"));
            let mut found = Diagnostics::default();
            let marker = cutc::pipeline::marker_of(by_name("hpgl").expect("a dialect"), &source, &job, &mut found);
            assert_eq!(outlines(&marker), plain, "{before}{end:?}");
            assert_eq!(audit(&source, &marker, &job), [], "{before}{end:?}");
            assert!(found.iter().any(|said| said.code.name == "hpgl/open-label"), "{before}{end:?}");
        }
    }
}

#[test]
fn a_plot_of_texts_alone_is_a_plot() {
    let mut found = Diagnostics::default();
    let text = source("IN;SP1;LBSIZE 42\x03;SP0;");
    let dialect = cutc::front::choose(&text, None, None, &mut found).expect("it is recognised");
    assert_eq!((dialect.name, found.has_errors()), ("hpgl", false));
}
