//! No function is too long to be understood as one.

use super::{report, sources, without_tests};

/// The most lines of code in a function, its signature included.
const MOST_LINES: usize = 60;

/// The name and the lines of each function of formatted code: it ends with the first brace as far left as it begins.
fn functions(code: &str) -> Vec<(String, usize)> {
    let lines: Vec<&str> = code.lines().filter(|line| !line.trim().is_empty()).collect();
    let mut found = Vec::new();
    for (at, line) in lines.iter().enumerate() {
        let Some((before, rest)) = line.split_once("fn ") else { continue };
        let is_prefix = |word: &str| word == "const" || word.starts_with("pub");
        if line.ends_with(';') || !before.split_whitespace().all(is_prefix) {
            continue;
        }
        let name = rest.split(|c: char| !c.is_alphanumeric() && c != '_').next().unwrap_or_default();
        let indent = line.len() - line.trim_start().len();
        let end = format!("{}}}", &line[..indent]);
        let length = if line.ends_with('}') { Some(0) } else { lines[at..].iter().position(|other| *other == end) };
        found.extend(length.map(|length| (name.to_owned(), length + 1)));
    }
    found
}

#[test]
fn lines_of_functions_are_counted_without_blanks_and_comments() {
    let code = "pub(crate) fn a() {\n    b();\n\n    \n}\nfn c() {}\nimpl X {\n    const fn d() {\n    }\n}\n";
    let expected = [("a", 3), ("c", 1), ("d", 2)].map(|(name, lines)| (name.to_owned(), lines));
    assert_eq!(functions(code), expected);
}

#[test]
fn no_function_is_too_long_to_be_understood_as_one() {
    let mut faults = Vec::new();
    for file in sources("src") {
        let path = file.path.display();
        let functions = functions(&without_tests(&file.code)).into_iter().filter(|(_, lines)| *lines > MOST_LINES);
        faults.extend(
            functions.map(|(name, lines)| format!("{path} {name}: {lines} lines of code, more than {MOST_LINES}")),
        );
    }
    report(&faults);
}
