//! Dask runs the manual's script over two workers, one of which is killed amid its work.

use std::fs::{self, File};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use crate::is_there;
use crate::page::{blocks, expect_same, page, search_path, section, tree};

/// Files to compile, squares in each, and programs that are there when a worker is killed.
const FILES: usize = 40;
const SQUARES: usize = 20;
const BEFORE_THE_KILL: usize = 8;
/// How often is looked whether it is time, and how long at the most.
const LOOK: Duration = Duration::from_millis(2);
const PATIENCE: Duration = Duration::from_secs(60);

/// How a worker ends.
#[derive(Debug, Clone, Copy)]
enum Death {
    /// What it had begun goes on without it, as when the memory of the machine is short.
    Alone,
    /// With all that it had begun, as a machine does that loses its power.
    WithItsChildren,
}

/// Processes that end with the test, with all that they began.
struct Processes(Vec<Child>);

impl Processes {
    /// Starts a part of Dask in a folder, as leader of a group of its own.
    fn start(&mut self, module: &str, arguments: &str, folder: &Path) -> u32 {
        use std::os::unix::process::CommandExt as _;
        let log = File::create(folder.join(format!("{}-{}.log", module, self.0.len()))).expect("writable");
        let mut python = Command::new("python3");
        python.args(["-m", &format!("distributed.cli.{module}")]).args(arguments.split(' ')).current_dir(folder);
        python.env("PATH", search_path(folder)).process_group(0).stdout(Stdio::null()).stderr(log);
        self.0.push(python.spawn().expect("python3 starts"));
        self.0[self.0.len() - 1].id()
    }
}

impl Drop for Processes {
    fn drop(&mut self) {
        for process in &mut self.0 {
            kill(&format!("-{}", process.id()));
            let _ = process.wait();
        }
    }
}

/// Kills a process, or a group by its number below zero; says whether it was there.
fn kill(number: &str) -> bool {
    let line = format!("kill -s KILL -- {number} 2> /dev/null");
    Command::new("sh").args(["-c", &line]).status().expect("sh runs").success()
}

/// Waits until something is there.
fn until<T>(what: &str, folder: &Path, look: impl Fn() -> Option<T>) -> T {
    let end = Instant::now() + PATIENCE;
    loop {
        if let Some(found) = look() {
            return found;
        }
        assert!(Instant::now() < end, "no {what} in {}", folder.display());
        sleep(LOOK);
    }
}

/// Cutter files in two folders, no two alike, and one that is refused.
fn inputs(folder: &Path) {
    for i in 0..FILES {
        let square = |k: usize| {
            let (x, y, side) = (k % 5 * 3000, k / 5 * 3000, 1000 + 10 * i);
            let (right, top) = (x + side, y + side);
            let corners = format!("X{right}Y{y}*X{right}Y{top}*X{x}Y{top}*X{x}Y{y}*");
            format!("N{}*X{x}Y{y}*M14*{corners}M15*", k + 1)
        };
        let squares: String = (0..SQUARES).map(square).collect();
        let of_its_kind = folder.join(["men", "women"][i % 2]);
        fs::create_dir_all(&of_its_kind).expect("writable");
        fs::write(of_its_kind.join(format!("m{i:02}.cut")), format!("G71*{squares}M0*")).expect("writable");
    }
    fs::write(folder.join("junk.cut"), "no cutter file").expect("writable");
}

/// Programs in a folder so far.
fn programs(folder: &Path) -> usize {
    let folders = ["men", "women"].map(|name| fs::read_dir(folder.join(name)));
    let names = folders.into_iter().flatten().flatten().flatten().map(|entry| entry.file_name());
    names.filter(|name| Path::new(name).extension().is_some_and(|end| end == "csv")).count()
}

/// The manual's script in a folder, with the scheduler at an address.
fn script(folder: &Path, address: &[String]) -> Command {
    let mut python = Command::new("python3");
    python.arg("cut.py").args([folder.join("in"), folder.join("out")]).args(address).current_dir(folder);
    python.env("PATH", search_path(folder)).stdout(Stdio::piped()).stderr(Stdio::piped());
    python
}

/// Runs the script in a folder, kills a worker amid it, and expects what a single run makes.
fn check(death: Death, folder: &Path) {
    inputs(&folder.join("in"));
    let text = blocks(section(page("many-files"), "Dask"), "python").concat();
    fs::write(folder.join("cut.py"), text).expect("writable");

    let mut processes = Processes(Vec::new());
    let common = "--no-dashboard --host 127.0.0.1 --scheduler-file scheduler.json";
    processes.start("dask_scheduler", &format!("{common} --port 0"), folder);
    let known = || serde_json::from_slice::<serde_json::Value>(&fs::read(folder.join("scheduler.json")).ok()?).ok();
    let known = until("scheduler", folder, known);
    let address = known["address"].as_str().expect("an address").to_owned();
    let worker = format!("{common} --no-nanny --nthreads 1 --local-directory {}", folder.join("scratch").display());
    let workers = [0, 1].map(|_| processes.start("dask_worker", &worker, folder));

    let running = script(folder, &[address]).spawn().expect("python3 starts");
    until("program", folder, || (programs(&folder.join("out")) >= BEFORE_THE_KILL).then_some(()));
    let killed = match death {
        Death::Alone => kill(&workers[0].to_string()),
        Death::WithItsChildren => kill(&format!("-{}", workers[0])),
    };
    assert!(killed, "the worker was there to be killed");
    let there = programs(&folder.join("out"));
    assert!(there < FILES, "all {there} files were compiled before the worker was killed");
    let ran = running.wait_with_output().expect("it ends");
    let said = String::from_utf8_lossy(&ran.stderr);
    // One file is refused; all others were compiled by the parts.
    assert_eq!(ran.status.code(), Some(1), "{said}");
    assert!(said.contains(&format!("{} files, {FILES} unchanged, 1 failed", FILES + 1)), "{death:?}: {said}");
    let mut single = Command::new(env!("CARGO_BIN_EXE_cutc"));
    single.args(["compile", "in", "-o", "single/", "-q"]).current_dir(folder);
    assert_eq!(single.output().expect("the program starts").status.code(), Some(1));
    expect_same(&folder.join("out"), &folder.join("single"));
}

#[test]
fn a_dask_worker_that_is_killed_loses_nothing() {
    if !is_there("dask", Command::new("python3").args(["-c", "import distributed"])) {
        return;
    }
    let room = tempfile::tempdir().expect("a directory");
    for death in [Death::Alone, Death::WithItsChildren] {
        let folder = room.path().join(format!("{death:?}"));
        fs::create_dir(&folder).expect("writable");
        check(death, &folder);
    }
    // Without a scheduler the script begins workers of its own; what is done stays as it is.
    let folder = room.path().join(format!("{:?}", Death::Alone));
    let before = tree(&folder.join("out"));
    let again = script(&folder, &[]).output().expect("python3 starts");
    assert_eq!(again.status.code(), Some(1), "{}", String::from_utf8_lossy(&again.stderr));
    assert!(before == tree(&folder.join("out")));
}
