//! The rules of the code's layout, read from its text: who imports whom, what is named where, tables beside folders.

mod circles;
mod functions;

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use cutc::back::TARGETS;
use cutc::front::DIALECTS;
use cutc::pass::marker::MARKER_PASSES;
use cutc::pass::toolpath::TOOLPATH_PASSES;

/// Which modules each module may import. Stages never import stages: they meet in `ir`. `verify` shares nothing with
/// what it judges. `ir` and `machine` share the word for how the blade follows a curve.
const IMPORTS: &[(&str, &[&str])] = &[
    ("source", &[]),
    ("units", &[]),
    ("geom", &["units"]),
    ("diagnostic", &["source", "units"]),
    ("machine", &["units", "diagnostic", "source"]),
    ("ir", &["source", "units", "geom", "diagnostic", "machine"]),
    ("analysis", &["units", "geom", "ir", "machine"]),
    ("front", FOUNDATION),
    ("recognise", ASKING),
    ("pass", ASKING),
    ("plan", ASKING),
    // Pages know nothing of what they show.
    ("picture", &[]),
    ("back", &["source", "diagnostic", "units", "geom", "ir", "machine", "analysis", "picture"]),
    // A checker measures for itself what it checks.
    ("verify", FOUNDATION),
    ("pipeline", ALL_BUT_CLI),
    // Another machine: it reads what the cutter reads, and leaves out the notches that passes find.
    (
        "sew",
        &[
            "source",
            "diagnostic",
            "units",
            "geom",
            "ir",
            "machine",
            "analysis",
            "front",
            "recognise",
            "pass",
            "picture",
        ],
    ),
    // A head in the place of the knife: it is moved by the cutter's planner or its own.
    ("spray", &["source", "diagnostic", "units", "geom", "ir", "machine", "plan", "verify"]),
    ("track", &["source", "diagnostic", "units", "ir", "machine"]),
    // Another machine: it cuts what the cutter cuts.
    ("flow", &["source", "diagnostic", "units", "geom", "ir", "machine", "pass", "plan", "verify", "picture"]),
    // Rows of functions, by which commands know machines.
    (
        "machines",
        &[
            "source",
            "diagnostic",
            "units",
            "ir",
            "machine",
            "front",
            "back",
            "plan",
            "pipeline",
            "verify",
            "sew",
            "flow",
            "spray",
            "track",
        ],
    ),
    ("manual", &[]),
    // The tables of the stages, but not what they do.
    (
        "cli",
        &[
            "machines",
            "pipeline",
            "front",
            "back",
            "pass",
            "source",
            "machine",
            "diagnostic",
            "ir",
            "units",
            "picture",
            "manual",
            "sew",
            "spray",
            "track",
            "flow",
        ],
    ),
    ("main", &["cli"]),
];

const FOUNDATION: &[&str] = &["source", "diagnostic", "units", "geom", "ir", "machine"];

/// Those who may ask of the cloth.
const ASKING: &[&str] = &["source", "diagnostic", "units", "geom", "ir", "machine", "analysis"];

const ALL_BUT_CLI: &[&str] = &[
    "source",
    "diagnostic",
    "units",
    "geom",
    "ir",
    "machine",
    "analysis",
    "front",
    "recognise",
    "pass",
    "plan",
    "back",
    "verify",
    "spray",
];

/// What is named in some modules only.
const NAMED_ONLY_IN: &[(&str, &[&str])] = &[
    ("nalgebra::", &["geom", "plan", "spray"]),
    ("nom::", &["front"]),
    ("clap::", &["cli"]),
    ("anyhow::", &["cli", "main"]),
    // What gives the same on any number of threads may be shared out; what writes, reads and plans goes in order.
    ("rayon::", &["analysis", "cli", "flow", "geom", "pass", "pipeline", "verify"]),
    // Stages are pure: files, clocks and the environment are for those who call them.
    ("tempfile::", &["cli", "pipeline"]),
    ("std::thread", &["cli", "pipeline", "main"]),
    ("std::fs", &["cli", "pipeline", "main"]),
    ("std::env", &["cli", "pipeline", "main"]),
    ("std::time", &["cli", "pipeline", "main"]),
    ("println!", &["main"]),
    ("eprintln!", &["main"]),
    ("print!", &["main"]),
    ("eprint!", &["main"]),
    ("dbg!", &[]),
    ("process::exit", &["main"]),
    ("super::super", &[]),
];

/// Dialects without a grammar, and why.
const NO_GRAMMAR: &[(&str, &str)] = &[
    ("pattern", "its groups are those of dxf"),
    ("svg", "XML and its paths are read by libraries, and a scan of numbers"),
];

/// Source files in the folder of a table that are no entry of it, and why.
const BESIDE_A_TABLE: &[(&str, &str)] = &[
    ("dialect", "says what a dialect is"),
    ("decimals", "tells decimal points that stand for changed digits, for the dialects of cut files and plots"),
    ("ends", "finds the ends of runs by place, and blades that pass beside the cuts that they must meet there"),
    ("formats", "is the table of formats that are no dialect of ours"),
    ("foreign", "names the formats that are no dialect of ours"),
    ("frame", "makes the one toolpath that no pass edits"),
    ("long", "says where pieces longer than a window are split, for the pass that lays windows"),
    ("split", "parts outlines at the borders of windows, for the passes that lay these and make cuts"),
    ("lap", "says how far C turns along a run, for the passes that keep it in its range"),
    ("continuation", "tells where a line goes on straight beyond a short cut, for the pass that plunges"),
    ("marks", "reads registration marks, which are given beside a source"),
    ("near", "tells which stretches of a run are near lines, for the pass that slows down there"),
    ("saved", "tells what another order would save: runs two of the passes on a copy"),
    ("junctions", "tells which chords come by a junction, for the pass that keeps the tip near its line there"),
    ("nibble", "parts runs into plunges for the pass that nibbles"),
    ("pass", "says what a pass is"),
    ("bow", "tells how far an edge bows away from a blade that plunges beside a slit, for `root`"),
    ("root", "tells how far a slit goes past its root, for the pass that lays overlaps"),
    ("runs", "finds the runs of a toolpath, which most passes edit alone"),
    ("scene", "holds what passes look at beside a toolpath"),
    ("search", "shares out searches over all pieces, for several passes"),
    ("sides", "joins strokes of an outline that were rounded apart, for the pass that welds"),
    ("far", "finds points that a wrong digit has moved, for the pass that warns"),
    ("severed", "finds slits that meet, for the pass that warns"),
    ("stray", "finds short strokes on no edge, for the pass that warns"),
    ("sewn", "recognises files of sewing machines"),
    ("spare", "leaves out plunges of a nibbled curve that cut nothing new"),
    ("start", "finds where a run begins on a curve beside which the plunged blade would lie"),
    ("stretch", "parts runs for the passes that lift the knife amid one"),
    ("target", "says what a target is"),
    ("tight_report", "says what the pass `tight` does"),
    ("trace", "makes the toolpaths that the passes edit"),
    ("visit", "says in which ways the cuts of a piece may be made, for the passes that order pieces and cuts"),
    ("worst", "keeps the worst of what a pass says of many places alike"),
];

/// The longest a file may be, tests included.
const MOST_LINES: usize = 600;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// A source file below `src`.
struct File {
    path: PathBuf,
    /// Its top-level module: `ir` for `src/ir/list.rs`, `source` for `src/source.rs`.
    module: String,
    text: String,
    /// The text without comments, blank where they were.
    code: String,
}

fn sources(folder: &str) -> Vec<File> {
    let mut files = Vec::new();
    let mut folders = vec![root().join(folder)];
    while let Some(folder) = folders.pop() {
        for path in names(&folder).iter().map(|name| folder.join(name)) {
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                files.push(file(&path));
            }
        }
    }
    assert!(!files.is_empty(), "{folder} holds source files");
    files
}

fn file(path: &Path) -> File {
    let text = fs::read_to_string(path).expect("a readable source file");
    let path = path.strip_prefix(root()).expect("a path below the root").to_owned();
    let module = path.iter().nth(1).expect("a name below the folder").to_string_lossy();
    let module = module.strip_suffix(".rs").unwrap_or(&module).to_owned();
    let code: Vec<&str> = text.lines().map(|line| line.split("//").next().unwrap_or_default()).collect();
    File { module, code: code.join("\n"), text, path }
}

/// Names in a folder, sorted; none when it does not exist.
fn names(folder: &Path) -> BTreeSet<String> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    entries.map(|entry| entry.file_name().to_string_lossy().into_owned()).collect()
}

fn report(faults: &[String]) {
    assert!(faults.is_empty(), "\n{}\n", faults.join("\n"));
}

/// A code without what is for tests alone.
fn without_tests(code: &str) -> String {
    let (mut kept, mut is_test, mut end) = (String::new(), false, None::<String>);
    for line in code.lines() {
        let text = line.trim();
        if let Some(last) = &end {
            if line == last {
                end = None;
            }
        } else if is_test && !text.starts_with("#[") {
            is_test = false;
            end = text.ends_with('{').then(|| format!("{}}}", &line[..line.len() - line.trim_start().len()]));
        } else if text == "#[cfg(test)]" {
            is_test = true;
        } else if !is_test {
            kept += line;
            kept.push('\n');
        }
    }
    kept
}

#[test]
fn what_is_for_tests_alone_is_left_out() {
    let code = "a\n#[cfg(test)]\nmod tests;\nb\n#[cfg(test)]\n#[x]\nmod c {\n    d {\n    }\n}\ne\n";
    assert_eq!(without_tests(code), "a\nb\ne\n");
}

/// What follows each place where `word` stands as a word of its own.
fn after<'a>(code: &'a str, word: &'a str) -> impl Iterator<Item = &'a str> {
    let is_name = |c: char| c.is_alphanumeric() || c == '_';
    let places = code.match_indices(word).filter(move |&(at, _)| !code[..at].ends_with(is_name));
    places.map(move |(at, _)| &code[at + word.len()..])
}

/// The modules that a code names behind `crate::`: one name, or those at the top of a list in braces.
fn imports(code: &str) -> BTreeSet<String> {
    let name = |text: &str| -> String { text.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect() };
    let mut found = BTreeSet::new();
    for rest in after(code, "crate::").chain(after(code, "cutc::")) {
        let Some(list) = rest.strip_prefix('{') else {
            found.insert(name(rest));
            continue;
        };
        let (mut depth, mut starts) = (1, true);
        for (at, c) in list.char_indices() {
            match c {
                '{' => depth += 1,
                '}' => depth -= 1,
                _ if starts && depth == 1 && !c.is_whitespace() => _ = found.insert(name(&list[at..])),
                _ => {}
            }
            starts = c == ',' || (starts && c.is_whitespace());
            if depth == 0 {
                break;
            }
        }
    }
    found
}

#[test]
fn imports_are_found_however_they_are_written() {
    let code = "use crate::{a, b::{c, d},\n  e::f};\ncrate::g::h(); pub(in crate::i) x; mycrate::j; cutc::k::run()";
    assert_eq!(imports(code).into_iter().collect::<Vec<_>>(), ["a", "b", "e", "g", "i", "k"]);
}

#[test]
fn a_module_imports_only_what_the_architecture_allows() {
    let mut faults = Vec::new();
    for file in sources("src").iter().filter(|file| file.module != "lib") {
        let Some((_, allowed)) = IMPORTS.iter().find(|row| row.0 == file.module) else {
            faults.push(format!("{}: the module has no row in IMPORTS", file.path.display()));
            continue;
        };
        for import in imports(&file.code) {
            if import != file.module && !allowed.contains(&import.as_str()) {
                faults.push(format!("{}: `{}` must not import `{import}`", file.path.display(), file.module));
            }
        }
    }
    report(&faults);
}

/// Modules of `sew` that its verifier may name: forms, but no stage that makes them.
const SEWN_FORMS: &[&str] = &["pattern", "stitches", "verify"];

#[test]
fn the_verifier_of_sewing_knows_its_forms_and_nothing_of_who_makes_them() {
    let mut faults = Vec::new();
    for file in sources("src/sew/verify") {
        for rest in after(&file.code, "sew::") {
            let named: String = rest.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
            if !SEWN_FORMS.contains(&named.as_str()) {
                faults.push(format!("{}: names `sew::{named}`", file.path.display()));
            }
        }
        // Stages of the cutter, which sewing reads with: its verifier must read for itself.
        for stage in ["analysis", "front", "recognise", "pass", "plan", "back", "pipeline"] {
            if imports(&file.code).contains(stage) {
                faults.push(format!("{}: must not import `{stage}`", file.path.display()));
            }
        }
        if file.path.ends_with("mod.rs") && after(&file.code, "use super::").next().is_some() {
            faults.push(format!("{}: names what lies beside the verifier", file.path.display()));
        }
    }
    report(&faults);
}

/// Types that all machines share, each with the file that declares it.
const SHARED: &[(&str, &str)] = &[
    ("Target", "src/ir/target.rs"),
    ("Rule", "src/ir/verdict/mod.rs"),
    ("Finding", "src/ir/verdict/mod.rs"),
    ("Verdict", "src/ir/verdict/mod.rs"),
    ("Worst", "src/ir/verdict/worst.rs"),
];

#[test]
fn a_machine_declares_no_target_rule_or_verdict_of_its_own() {
    let mut faults = Vec::new();
    // Readers and passes judge nothing: the rules of a style sheet are none of the verifier.
    let files =
        sources("src").into_iter().filter(|file| !["front", "recognise", "pass"].contains(&file.module.as_str()));
    for file in files {
        for (name, home) in SHARED {
            let declares = ["struct ", "enum "].into_iter().any(|word| {
                let declared = after(&file.code, word).map(|rest| rest.split(|c: char| !c.is_alphanumeric()).next());
                declared.flatten().any(|declared| declared == *name)
            });
            if declares != (file.path == Path::new(home)) {
                faults.push(format!("{}: `{name}` is declared in {home}, and there alone", file.path.display()));
            }
        }
    }
    report(&faults);
}

#[test]
fn packages_printing_and_side_effects_stay_where_they_belong() {
    let mut faults = Vec::new();
    for file in sources("src") {
        for (word, modules) in NAMED_ONLY_IN {
            if !modules.contains(&file.module.as_str()) && after(&file.code, word).next().is_some() {
                faults.push(format!("{}: `{word}` belongs to {modules:?} only", file.path.display()));
            }
        }
    }
    report(&faults);
}

#[test]
fn no_file_is_too_long_to_read_at_a_sitting() {
    let files = sources("src").into_iter().chain(sources("tests"));
    let long = files.map(|file| (file.text.lines().count(), file.path)).filter(|(lines, _)| *lines > MOST_LINES);
    report(
        &long
            .map(|(lines, path)| format!("{}: {lines} lines, more than {MOST_LINES}", path.display()))
            .collect::<Vec<_>>(),
    );
}

/// Compares a table with the files and folders beside its `mod.rs`.
fn compare(folder: &str, table: &[&str], faults: &mut Vec<String>) {
    let modules: BTreeSet<String> =
        names(&root().join(folder)).iter().map(|name| name.strip_suffix(".rs").unwrap_or(name).to_owned()).collect();
    for name in table {
        if !modules.contains(&name.replace('-', "_")) {
            faults.push(format!("`{name}` has no source file or folder of its name in {folder}"));
        }
    }
    for module in modules.iter().filter(|module| *module != "mod") {
        let listed = table.iter().any(|name| name.replace('-', "_") == *module);
        if !listed && !BESIDE_A_TABLE.iter().any(|row| row.0 == module) {
            faults.push(format!("{folder}/{module} is no entry of the table in {folder}/mod.rs"));
        }
    }
}

#[test]
fn tables_and_folders_agree() {
    let mut faults = Vec::new();
    let dialects: Vec<&str> = DIALECTS.iter().map(|dialect| dialect.name).collect();
    compare("src/front", &dialects, &mut faults);
    compare("src/back", &TARGETS.iter().map(|target| target.name).collect::<Vec<_>>(), &mut faults);
    compare("src/pass/marker", &MARKER_PASSES.iter().map(|pass| pass.name).collect::<Vec<_>>(), &mut faults);
    compare("src/pass/toolpath", &TOOLPATH_PASSES.iter().map(|pass| pass.name).collect::<Vec<_>>(), &mut faults);
    for name in dialects {
        if names(&root().join("fixtures").join(name)).is_empty() {
            faults.push(format!("the dialect `{name}` needs fixtures in fixtures/{name}/"));
        }
        let excused = NO_GRAMMAR.iter().any(|row| row.0 == name);
        if root().join(format!("grammar/{name}.bnf")).is_file() == excused {
            faults.push(format!("the dialect `{name}` needs either grammar/{name}.bnf or a reason in NO_GRAMMAR"));
        }
    }
    report(&faults);
}

#[test]
fn the_top_level_holds_nothing_else() {
    let ignored = fs::read_to_string(root().join(".gitignore")).unwrap_or_default();
    let belongs = |name: &str| {
        ["Cargo.toml", "Cargo.lock", "src", "grammar", "fixtures", "tests", "README.md"].contains(&name)
            || name.starts_with('.')
            || name.starts_with("LICENSE-")
            || ignored.lines().any(|line| line.strip_prefix('/') == Some(name))
            || ignored.lines().any(|line| line.strip_prefix('*').is_some_and(|end| name.ends_with(end)))
    };
    let strange = names(root()).into_iter().filter(|name| !belongs(name));
    report(&strange.map(|name| format!("`{name}` does not belong to the top level")).collect::<Vec<_>>());
}
