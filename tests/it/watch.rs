//! A hot folder: what is finished there is compiled, whatever happens meanwhile.

use std::collections::BTreeMap;
use std::fs::{self, OpenOptions};
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use fastrand::Rng;
use tempfile::TempDir;

/// The longest that anything in these tests is waited for.
const PATIENCE: Duration = Duration::from_secs(120);
/// Exit code of who was asked to end by SIGTERM.
const TERMINATED: i32 = 143;

/// A square of so many tenths of a millimetre.
fn square(side: usize) -> String {
    format!("H1*G71*N1*X0Y0*M14*X{side}*Y{side}*X0*Y0*M15*M0*")
}

/// A file that is none of the dialects.
const JUNK: &str = "no cutter file at all\n";

struct HotFolder {
    room: TempDir,
}

impl HotFolder {
    fn new() -> Self {
        let room = tempfile::tempdir().expect("a directory");
        fs::create_dir(room.path().join("in")).expect("writable");
        Self { room }
    }

    fn at(&self, name: &str) -> PathBuf {
        self.room.path().join(name)
    }

    fn put(&self, name: &str, text: &str) {
        let path = self.at("in").join(name);
        fs::create_dir_all(path.parent().expect("a folder")).expect("writable");
        fs::write(path, text).expect("writable");
    }

    fn watch(&self, options: &str) -> Running {
        self.watch_as("in", options)
    }

    /// Watches the folder under another name.
    fn watch_as(&self, name: &str, options: &str) -> Running {
        let log = |name| OpenOptions::new().create(true).append(true).open(self.at(name)).expect("writable");
        let mut command = Command::new(env!("CARGO_BIN_EXE_cutc"));
        command.args(["watch", name, "-o", "out"]).args(options.split_whitespace()).current_dir(self.room.path());
        let running = command.stdout(log("told")).stderr(log("said")).stdin(Stdio::null()).spawn();
        Running(running.expect("the program starts"))
    }

    fn text(&self, name: &str) -> String {
        fs::read_to_string(self.at(name)).unwrap_or_default()
    }

    fn wait_for(&self, what: &str, holds: impl Fn(&Self) -> bool) {
        let begun = Instant::now();
        while !holds(self) {
            let files = files(&self.at("out"));
            let names: Vec<_> = files.keys().collect();
            assert!(begun.elapsed() < PATIENCE, "{what}: {names:?}\n{}{}", self.text("told"), self.text("said"));
            thread::sleep(Duration::from_millis(20));
        }
    }

    fn has(&self, name: &str) -> bool {
        self.at("out").join(name).is_file()
    }
}

/// A watch; it ends with its test.
struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        // It has ended where the test holds.
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// Sends a signal.
fn signal(child: &Child, name: &str) {
    let sent = Command::new("kill").args(["-s", name, &child.id().to_string()]).status();
    assert!(sent.expect("kill starts").success());
}

/// Asks a watch to end, and expects that it does.
fn end(mut watch: Running) {
    signal(&watch.0, "TERM");
    assert_eq!(watch.0.wait().expect("it ends").code(), Some(TERMINATED));
}

/// All files below a folder: their paths and bytes.
fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut found = BTreeMap::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(next) = folders.pop() {
        for entry in fs::read_dir(next).into_iter().flatten().flatten() {
            let path = entry.path();
            if path.is_dir() {
                folders.push(path);
            } else if let Ok(bytes) = fs::read(&path) {
                found.insert(path.strip_prefix(folder).expect("below it").display().to_string(), bytes);
            }
        }
    }
    found
}

#[test]
fn a_file_that_comes_in_is_compiled_and_a_bad_one_gets_a_report() {
    let hot = HotFolder::new();
    hot.put("early.cut", &square(500));
    let watch = hot.watch("-t gcode");
    hot.wait_for("what was there before is compiled", |hot| hot.has("early.ngc"));
    hot.put("sub/late.cut", &square(600));
    hot.put("bad.cut", JUNK);
    hot.put("notes.pdf", JUNK);
    hot.wait_for("folders keep their structure", |hot| hot.has("sub/late.ngc") && hot.has("sub/late.ngc.meta.json"));
    hot.wait_for("a bad one gets a report", |hot| hot.has("bad.cut.report.txt"));
    hot.wait_for("what is no cutter file is said", |hot| hot.text("said").contains("notes.pdf: left alone"));
    assert!(hot.text("out/bad.cut.report.txt").contains("source/unknown-format"));
    // Mended, it has its program and no report; broken, the other way round.
    hot.put("bad.cut", &square(700));
    hot.put("early.cut", JUNK);
    hot.wait_for("a mended one has its program", |hot| hot.has("bad.ngc") && !hot.has("bad.cut.report.txt"));
    hot.wait_for("a broken one has a report", |hot| hot.has("early.cut.report.txt") && !hot.has("early.ngc"));
    fs::remove_file(hot.at("in/early.cut")).expect("removable");
    hot.wait_for("a report goes with its file", |hot| !hot.has("early.cut.report.txt"));
    end(watch);
    let told = hot.text("told");
    assert!(told.contains("in/sub/late.cut: 1 piece, 0.2 m"), "{told}");
    assert!(told.contains("in/bad.cut: FAILED source/unknown-format"), "{told}");
}

#[test]
fn the_overview_of_the_pages_is_kept_up_to_date() {
    let folder = HotFolder::new();
    folder.put("a.cut", &square(4000));
    folder.put("bad.cut", JUNK);
    let says = |folder: &HotFolder, words: &[&str]| {
        let page = folder.text("out/index.html");
        words.iter().all(|words| page.contains(words))
    };
    let watch = folder.watch("-t html");
    folder.wait_for("two rows", |f| says(f, &["<h1>2 files</h1>", "1 failed", "href=\"./a.html\"", "in/bad.cut"]));
    folder.put("b.cut", &square(5000));
    folder.wait_for("a row that comes", |f| says(f, &["<h1>3 files</h1>", "href=\"./b.html\""]));
    fs::remove_file(folder.at("in/bad.cut")).expect("it is there");
    folder.wait_for("a row that goes", |f| says(f, &["<h1>2 files</h1>", "all done"]));
    end(watch);
    fs::write(folder.at("out/index.html"), "mine").expect("writable");
    folder.put("c.cut", &square(3000));
    let watch = folder.watch("-t html");
    folder.wait_for("a refusal", |f| f.text("said").contains("`out/index.html` is no overview of pages"));
    folder.wait_for("a page all the same", |f| f.has("c.html"));
    assert_eq!(folder.text("out/index.html"), "mine");
    end(watch);
}

#[test]
fn the_options_of_the_folder_hold_and_may_be_changed() {
    let hot = HotFolder::new();
    hot.put("a.cut", &square(500));
    hot.put("cutc.toml", "target = [\"gcode\", \"svg\"]\n");
    let watch = hot.watch("");
    hot.wait_for("both targets are written", |hot| hot.has("a.ngc") && hot.has("a.svg"));
    hot.put("cutc.toml", "target = \"nonsense\"\n");
    hot.wait_for("wrong options are refused", |hot| hot.text("said").contains("until the options are mended"));
    hot.put("b.cut", &square(600));
    hot.put("cutc.toml", "target = \"csv\"\nno-verify = true\n");
    hot.wait_for("all files are made anew", |hot| hot.has("a.csv") && hot.has("b.csv"));
    assert!(!hot.has("b.ngc"));
    assert!(hot.text("out/a.csv.meta.json").contains(r#""verified": "no""#));
    end(watch);
}

#[test]
fn two_files_for_one_program_do_not_take_turns() {
    let hot = HotFolder::new();
    hot.put("m.cut", &square(500));
    hot.put("m.plt", "IN;SP1;PU0,0;PD4000,0,4000,4000,0,4000,0,0;PU;SP0;");
    let watch = hot.watch("");
    hot.wait_for("one has the program", |hot| hot.has("m.csv"));
    hot.wait_for("the other a report", |hot| hot.has("m.plt.report.txt"));
    assert!(hot.text("out/m.plt.report.txt").contains("made from `m.cut`"));
    end(watch);
    assert!(hot.text("out/m.csv.meta.json").contains(r#""source": "m.cut""#));
}

#[test]
fn the_overview_takes_up_other_targets_while_a_file_still_waits() {
    let hot = HotFolder::new();
    hot.put("m.cut", &square(500));
    hot.put("m.plt", "IN;SP1;PU0,0;PD4000,0,4000,4000,0,4000,0,0;PU;SP0;");
    hot.put("cutc.toml", "target = \"csv\"\n");
    let watch = hot.watch("");
    hot.wait_for("both are dealt with", |hot| hot.has("m.csv") && hot.has("m.plt.report.txt"));
    hot.put("cutc.toml", "target = [\"csv\", \"html\"]\n");
    hot.wait_for("two rows", |hot| hot.text("out/index.html").contains("<h1>2 files</h1>"));
    end(watch);
}

/// Checks what a watch does that is given its folder by a name.
fn check_name(name: &str) {
    let hot = HotFolder::new();
    let root = hot.room.path().file_name().expect("a name").to_string_lossy().into_owned();
    std::os::unix::fs::symlink("nowhere", hot.at("in/link.cut")).expect("writable");
    hot.put("early.cut", &square(500));
    hot.put("cutc.toml", "target = \"gcode\"\n");
    let watch = hot.watch_as(&name.replace("ROOM", &root), "");
    hot.wait_for("what was there is found", |hot| hot.has("early.ngc"));
    hot.put("sub/late.cut", &square(600));
    hot.put("bad.cut", JUNK);
    hot.wait_for("what comes is heard", |hot| hot.has("sub/late.ngc") && hot.has("bad.cut.report.txt"));
    // It is looked through meanwhile.
    thread::sleep(Duration::from_secs(3));
    end(watch);
    let names: Vec<String> = files(&hot.at("out")).into_keys().collect();
    let expected = [
        "bad.cut.report.txt",
        "cutc.jsonl",
        "early.ngc",
        "early.ngc.meta.json",
        "sub/late.ngc",
        "sub/late.ngc.meta.json",
    ];
    assert_eq!(names, expected, "{name}: {}", hot.text("said"));
    assert!(!hot.text("said").contains("left alone"), "{}", hot.text("said"));
}

#[test]
fn the_folder_may_have_any_name_and_links_to_nothing_in_it() {
    // Side by side: most of the time is waiting.
    thread::scope(|threads| {
        for name in ["./in", "in/", "../ROOM/in"] {
            threads.spawn(move || check_name(name));
        }
    });
    let hot = HotFolder::new();
    let mut within = Command::new(env!("CARGO_BIN_EXE_cutc"));
    let refused = within.args(["watch", "in", "-o", "in/"]).current_dir(hot.room.path()).output().expect("it starts");
    assert_eq!(refused.status.code(), Some(2));
}

#[test]
fn a_file_that_is_replaced_by_one_of_its_size_and_time_is_compiled_anew() {
    let hot = HotFolder::new();
    hot.put("a.cut", &square(500));
    let watch = hot.watch("");
    hot.wait_for("it has its program", |hot| hot.has("a.csv"));
    let before = hot.text("out/a.csv");
    let (old, new) = (hot.at("in/a.cut"), hot.at("in/.a.part"));
    fs::write(&new, square(600)).expect("writable");
    let time = old.metadata().and_then(|known| known.modified()).expect("known");
    fs::File::options().write(true).open(&new).and_then(|file| file.set_modified(time)).expect("writable");
    fs::rename(new, old).expect("movable");
    hot.wait_for("it has another program", |hot| hot.has("a.csv") && hot.text("out/a.csv") != before);
    end(watch);
}

#[test]
fn who_waits_for_another_watch_ends_at_once() {
    let hot = HotFolder::new();
    hot.put("a.cut", &square(500));
    let first = hot.watch("");
    hot.wait_for("the first works", |hot| hot.has("a.csv"));
    let second = hot.watch("");
    hot.wait_for("the second waits", |hot| hot.text("said").contains("waiting for another run"));
    end(second);
    end(first);
}

/// Brings a file into a folder as one of many programs would.
fn bring(folder: &Path, name: &str, text: &str, random: &mut Rng) {
    let path = folder.join(name);
    let pause = |random: &mut Rng| thread::sleep(Duration::from_micros(random.u64(0..2000)));
    match random.u8(0..4) {
        // In one piece.
        0 => fs::write(&path, text).expect("writable"),
        // By rename.
        1 => {
            let aside = folder.join(format!(".{name}.part"));
            fs::write(&aside, text).expect("writable");
            fs::rename(aside, &path).expect("movable");
        }
        // In pieces, opened once or again and again.
        2 => {
            let mut file = fs::File::create(&path).expect("writable");
            for piece in text.as_bytes().chunks(9) {
                file.write_all(piece).expect("writable");
                pause(random);
            }
        }
        _ => {
            fs::write(&path, "").expect("writable");
            for piece in text.as_bytes().chunks(20) {
                let mut file = OpenOptions::new().append(true).open(&path).expect("writable");
                file.write_all(piece).expect("writable");
                drop(file);
                pause(random);
            }
        }
    }
}

/// A number that a longer run may set.
fn many(variable: &str, usually: usize) -> usize {
    std::env::var(variable).ok().and_then(|number| number.parse().ok()).unwrap_or(usually)
}

#[test]
fn a_watch_that_is_killed_again_and_again_loses_nothing_and_leaves_nothing() {
    let (count, kills) = (many("CUTC_WATCH_FILES", 60), many("CUTC_WATCH_KILLS", 12));
    let hot = HotFolder::new();
    let folder = hot.at("in");
    let feeder = thread::spawn(move || {
        let mut random = Rng::with_seed(21);
        let mut last = BTreeMap::new();
        // Some come once, some are replaced, by good ones or bad ones.
        for i in (0..count).chain((0..count).step_by(3)).chain((0..count).step_by(4)) {
            let (name, side) = (format!("f{i}.cut"), 300 + 10 * random.usize(0..300));
            let text = if random.u8(0..5) == 0 { format!("{JUNK}{side}") } else { square(side) };
            bring(&folder, &name, &text, &mut random);
            last.insert(name, text);
        }
        last
    });
    let mut random = Rng::with_seed(12);
    for _ in 0..kills {
        let mut watch = hot.watch("--quiet");
        thread::sleep(Duration::from_millis(random.u64(0..400)));
        signal(&watch.0, "KILL");
        watch.0.wait().expect("it ends");
    }
    let last = feeder.join().expect("all files came");
    let watch = hot.watch("--quiet");
    let is_good = |text: &str| text.starts_with("H1");
    hot.wait_for("every file has its program or its report", |hot| {
        last.iter().all(|(name, text)| {
            let (program, stem) = (is_good(text), name.trim_end_matches(".cut"));
            hot.has(&format!("{stem}.csv")) == program && hot.has(&format!("{name}.report.txt")) != program
        })
    });
    // The programs are those of the files as they are now.
    let reference = hot.at("reference");
    let mut compile = Command::new(env!("CARGO_BIN_EXE_cutc"));
    compile.args(["compile", "in", "-q", "-o"]).arg(&reference).current_dir(hot.room.path());
    compile.output().expect("the program starts");
    let programs = |folder: &Path| {
        let mut files = files(folder);
        files.retain(|name, _| {
            !name.ends_with(".report.txt")
                && Path::new(name).extension().is_none_or(|end| end != "stale")
                && name != "cutc.jsonl"
        });
        files
    };
    let expected = programs(&reference);
    assert!(expected.len() > count);
    hot.wait_for("every program is that of its file", |hot| programs(&hot.at("out")) == expected);
    end(watch);
    let left: Vec<_> = files(&hot.at("out")).into_keys().filter(|name| name.contains(".cutc-")).collect();
    assert!(left.is_empty(), "{left:?}");
    let lines = hot.text("out/cutc.jsonl");
    assert_eq!(lines.lines().count(), count, "{lines}");
}
