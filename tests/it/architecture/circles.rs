//! No file imports another that imports it, itself or through others, inside a stage.
//!
//! What counts is where an item is defined: an import through a `pub use` is one of the file behind it, and a `mod.rs` that
//! only passes names on imports nothing. A module that is named in a `use` is imported where something of it is named.

use std::collections::{BTreeMap, BTreeSet};

use super::{report, sources, without_tests};

/// One name that a `use` brings into a module; `*` for all.
#[derive(Debug, PartialEq)]
struct Import {
    path: Vec<String>,
    name: String,
    is_public: bool,
}

/// A file as a module: what it imports by `use`, and the rest of its code.
struct Module {
    imports: Vec<Import>,
    code: String,
}

/// All modules by their paths, such as `ir::list`.
struct Modules(BTreeMap<String, Module>);

fn is_name(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

fn join(module: &str, name: &str) -> String {
    if module.is_empty() { name.to_owned() } else { format!("{module}::{name}") }
}

fn parent(module: &str) -> &str {
    module.rsplit_once("::").map_or("", |(parent, _)| parent)
}

/// The single imports of a tree such as `a::{b, c::d as e}`.
fn flatten(tree: &str, before: &[String], is_public: bool, imports: &mut Vec<Import>) {
    let tree = tree.trim();
    if let Some((stem, list)) = tree.split_once('{') {
        let stem = stem.split("::").map(str::trim).filter(|part| !part.is_empty()).map(str::to_owned);
        let stem: Vec<String> = before.iter().cloned().chain(stem).collect();
        let list = list.trim_end().strip_suffix('}').unwrap_or(list);
        let (mut depth, mut start) = (0, 0);
        for (at, c) in list.char_indices().chain([(list.len(), ',')]) {
            match c {
                '{' => depth += 1,
                '}' => depth -= 1,
                ',' if depth == 0 => {
                    flatten(&list[start..at], &stem, is_public, imports);
                    start = at + 1;
                }
                _ => {}
            }
        }
        return;
    }
    let (path, alias) = tree.split_once(" as ").map_or((tree, None), |(path, alias)| (path, Some(alias.trim())));
    let mut path: Vec<String> =
        before.iter().cloned().chain(path.split("::").map(|part| part.trim().to_owned())).collect();
    if path.last().is_some_and(|last| last == "self") && path.len() > 1 {
        path.pop();
    }
    if let Some(last) = path.last().filter(|last| !last.is_empty()) {
        let name = alias.unwrap_or(last).to_owned();
        imports.push(Import { path, name, is_public });
    }
}

impl Module {
    fn new(code: &str) -> Self {
        let (mut imports, mut rest, mut left) = (Vec::new(), String::new(), code);
        while let Some(at) = left.find("use ") {
            let line = left[..at].rsplit('\n').next().unwrap_or_default().trim();
            let is_statement = line.is_empty() || line.starts_with("pub");
            let end = left[at..].find(';').map_or(left.len(), |end| at + end);
            if is_statement && !line.contains(['{', ';', '=']) {
                flatten(&left[at + 4..end], &[], line.starts_with("pub"), &mut imports);
                rest += &left[..at - line.len().min(at)];
                left = &left[end..];
            } else {
                rest += &left[..at + 4];
                left = &left[at + 4..];
            }
        }
        Self { imports, code: rest + left }
    }

    fn names(&self, word: &str) -> bool {
        super::after(&self.code, word).any(|rest| !rest.starts_with(is_name))
    }

    fn defines(&self, name: &str) -> bool {
        let kinds = ["fn", "struct", "enum", "trait", "type", "const", "static", "union", "macro_rules!"];
        // In `&'static A` nothing is defined.
        let code = self.code.replace("'static ", "'_ ");
        kinds.iter().any(|kind| super::after(&code, &format!("{kind} {name}")).any(|rest| !rest.starts_with(is_name)))
    }

    /// The paths of two names or more in the code.
    fn paths(&self) -> BTreeSet<Vec<String>> {
        let mut found = BTreeSet::new();
        let mut left = self.code.as_str();
        while let Some(start) = left.find(is_name) {
            let is_chained = left[..start].ends_with("::") || left[..start].ends_with('.');
            left = &left[start..];
            let mut path = Vec::new();
            loop {
                let end = left.find(|c| !is_name(c)).unwrap_or(left.len());
                path.push(left[..end].to_owned());
                left = &left[end..];
                match left.strip_prefix("::").filter(|rest| rest.starts_with(is_name)) {
                    Some(rest) => left = rest,
                    None => break,
                }
            }
            if path.len() > 1 && !is_chained {
                found.insert(path);
            }
        }
        found
    }
}

impl Modules {
    /// A path from the root of the crate; `None` when it leads out of it.
    fn absolute(&self, module: &str, path: &[String], depth: usize) -> Option<Vec<String>> {
        let from = |module: &str, rest: &[String]| -> Vec<String> {
            module.split("::").filter(|part| !part.is_empty()).map(str::to_owned).chain(rest.iter().cloned()).collect()
        };
        let (first, rest) = path.split_first()?;
        match first.as_str() {
            "crate" => Some(rest.to_vec()),
            "self" => Some(from(module, rest)),
            "super" if rest.first().is_some_and(|next| next == "super") => self.absolute(parent(module), rest, depth),
            "super" => Some(from(parent(module), rest)),
            child if self.0.contains_key(&join(module, child)) => Some(from(module, path)),
            name if depth > 0 => {
                let import = self.0.get(module)?.imports.iter().find(|import| import.name == name)?;
                let mut stem = self.absolute(module, &import.path, depth - 1)?;
                stem.extend(rest.iter().cloned());
                Some(stem)
            }
            _ => None,
        }
    }

    /// The module in which is defined what a path from the root leads to, through names that are passed on; `None` when it
    /// leads to a module itself.
    fn home(&self, path: &[String], depth: usize) -> Option<String> {
        let mut module = String::new();
        let mut names = path.iter();
        let item = loop {
            let name = names.next()?;
            let next = join(&module, name);
            if !self.0.contains_key(&next) {
                break name;
            }
            module = next;
        };
        let holder = self.0.get(&module)?;
        if depth == 0 || holder.defines(item) {
            return Some(module);
        }
        let passed = holder.imports.iter().find(|import| import.name == *item && import.path != [item.clone()]);
        let through = if let Some(import) = passed {
            self.absolute(&module, &import.path, 3)?
        } else if let Some(all) = holder.imports.iter().find(|import| import.name == "*") {
            let mut path = self.absolute(&module, &all.path, 3)?;
            path.pop();
            path.push(item.clone());
            path
        } else {
            return Some(module);
        };
        self.home(&through, depth - 1)
    }

    /// The modules of the same stage in which something is defined that a module names.
    fn imported_by(&self, name: &str) -> BTreeSet<String> {
        let module = &self.0[name];
        let used = module.imports.iter().filter(|import| !import.is_public || module.names(&import.name));
        let paths = used.map(|import| import.path.clone()).chain(module.paths());
        let homes = paths.filter_map(|path| self.home(&self.absolute(name, &path, 3)?, 5));
        let stage = |module: &str| module.split("::").next().map(str::to_owned);
        homes.filter(|other| other != name && stage(other) == stage(name)).collect()
    }

    /// The circles: the modules of each, sorted.
    fn circles(&self) -> BTreeSet<Vec<String>> {
        let direct: BTreeMap<&String, BTreeSet<String>> =
            self.0.keys().map(|name| (name, self.imported_by(name))).collect();
        let reached = |from: &String| {
            let (mut seen, mut next) = (BTreeSet::new(), vec![from]);
            while let Some(at) = next.pop() {
                next.extend(direct[at].iter().filter(|other| seen.insert((*other).clone())));
            }
            seen
        };
        let all: BTreeMap<&String, BTreeSet<String>> = direct.keys().map(|name| (*name, reached(name))).collect();
        let both_ways =
            |name: &&String| all[*name].iter().filter(|other| all[other].contains(*name)).cloned().collect();
        all.keys().filter(|name| all[**name].contains(**name)).map(both_ways).collect()
    }
}

fn modules(files: &[(&str, &str)]) -> Modules {
    Modules(files.iter().map(|(path, code)| ((*path).to_owned(), Module::new(code))).collect())
}

#[test]
fn imports_lead_to_where_an_item_is_defined() {
    let found = |files: &[(&str, &str)], name: &str| Vec::from_iter(modules(files).imported_by(name));
    let through =
        [("a", "mod b;\nmod c;\npub use b::{B, X as Y};"), ("a::b", "pub struct B;"), ("a::c", "use super::B;\n")];
    assert_eq!(found(&through, "a::c"), ["a::b"]);
    assert!(found(&through, "a").is_empty(), "it only passes a name on");
    let used = [("a", "pub use b::B;\nstruct A(B);"), ("a::b", "use super::A;\npub struct B;")];
    assert_eq!((found(&used, "a"), found(&used, "a::b")), (vec!["a::b".to_owned()], vec!["a".to_owned()]));
    let named = [("a", "fn f() {}"), ("a::b", "use crate::a::{self, c};\nfn g() { a::f(); }"), ("a::c", "fn h() {}")];
    assert_eq!(found(&named, "a::b"), ["a"], "nothing of `c` is named");
    let other = [("a", "use std::fmt;\nuse crate::z::Z;\nfn f() { fmt::Z }"), ("z", "pub struct Z;")];
    assert!(found(&other, "a").is_empty(), "it is another stage");
    let lifetime = [("a", "pub use b::B;\nfn f() -> &'static B {}"), ("a::b", "struct B;"), ("a::c", "use super::B;")];
    assert_eq!(found(&lifetime, "a::c"), ["a::b"]);
    let all = [("a", "pub use table::*;"), ("a::table", "pub const T: u8 = 0;"), ("a::b", "fn f() { super::T }")];
    assert_eq!(found(&all, "a::b"), ["a::table"]);
}

#[test]
fn circles_are_found_at_any_length() {
    let ring = [("a", ""), ("a::x", "use super::y::Y; struct X;"), ("a::y", "use super::z; struct Y(z::Z);")];
    let open = modules(&[&ring[..], &[("a::z", "struct Z;")]].concat());
    assert!(open.circles().is_empty());
    let closed = modules(&[&ring[..], &[("a::z", "struct Z(crate::a::x::X);")]].concat());
    assert_eq!(Vec::from_iter(closed.circles()), [["a::x", "a::y", "a::z"]]);
}

#[test]
fn no_files_of_a_stage_import_each_other() {
    let name = |path: &std::path::Path| {
        let path = path.with_extension("");
        let names: Vec<_> = path.iter().skip(1).map(|name| name.to_string_lossy()).collect();
        names.join("::").trim_end_matches("::mod").to_owned()
    };
    let files = sources("src").into_iter().filter(|file| !["lib", "main"].contains(&file.module.as_str()));
    let modules = Modules(files.map(|f| (name(&f.path), Module::new(&without_tests(&f.code)))).collect());
    let circles: BTreeSet<String> = modules.circles().into_iter().map(|circle| circle.join(" ")).collect();
    let mut faults = Vec::new();
    for circle in &circles {
        faults.push(format!("a circle of imports: {circle}"));
        for file in circle.split(' ') {
            let next =
                modules.imported_by(file).into_iter().filter(|other| circle.split(' ').any(|in_it| in_it == other));
            faults.push(format!("    {file} imports {}", next.collect::<Vec<_>>().join(", ")));
        }
    }
    report(&faults);
}
