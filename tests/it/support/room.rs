//! A room to run the built program in.

use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use tempfile::TempDir;

pub(crate) const DONE: i32 = 0;
pub(crate) const FAULTY: i32 = 1;
pub(crate) const USAGE: i32 = 2;

/// A room to work in, with the seed's circle and a file that nothing can read.
pub(crate) struct Room(TempDir);

impl Room {
    pub(crate) fn new() -> Self {
        let room = Self(tempfile::tempdir().expect("a directory"));
        fs::copy(Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/iso/seed-circle.cut"), room.at("circle.cut"))
            .expect("the seed's circle is a fixture");
        room.write("junk.cut", &(0..2000_u32).map(|i| (i.wrapping_mul(2_654_435_761) >> 13) as u8).collect::<Vec<_>>());
        room
    }

    /// A room that also has a cut file.
    pub(crate) fn with(name: &str, cut: &str) -> Self {
        let room = Self::new();
        room.write(name, cut.as_bytes());
        room
    }

    pub(crate) fn at(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub(crate) fn write(&self, name: &str, bytes: &[u8]) {
        fs::write(self.at(name), bytes).expect("writable");
    }

    pub(crate) fn read(&self, name: &str) -> Vec<u8> {
        fs::read(self.at(name)).unwrap_or_else(|error| panic!("{name}: {error}; there are {:?}", self.names()))
    }

    pub(crate) fn text(&self, name: &str) -> String {
        String::from_utf8(self.read(name)).expect("UTF-8")
    }

    pub(crate) fn has(&self, name: &str) -> bool {
        self.at(name).exists()
    }

    /// The names of all files, sorted.
    pub(crate) fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(self.0.path()).expect("readable");
        let mut names: Vec<_> =
            entries.map(|entry| entry.expect("readable").file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }

    pub(crate) fn command(&self, arguments: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_cutc"));
        command.current_dir(self.0.path()).args(arguments.split_whitespace());
        command
    }

    pub(crate) fn run(&self, arguments: &str) -> Output {
        self.command(arguments).output().expect("the program starts")
    }

    /// Runs and expects an exit code; gives standard output and standard error.
    pub(crate) fn expect(&self, arguments: &str, code: i32) -> (String, String) {
        let output = self.run(arguments);
        let stdout = String::from_utf8_lossy(&output.stdout).into_owned();
        let stderr = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(code), "cutc {arguments}\n{stdout}\n{stderr}");
        (stdout, stderr)
    }

    /// Runs and expects an exit code; gives all that was said.
    pub(crate) fn says(&self, arguments: &str, code: i32) -> String {
        let (stdout, stderr) = self.expect(arguments, code);
        stdout + &stderr
    }

    /// Runs with some bytes on standard input, and expects an exit code; gives standard output and standard error.
    pub(crate) fn expect_of(&self, input: &[u8], arguments: &str, code: i32) -> (String, String) {
        let mut command = self.command(arguments);
        let piped = command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = piped.spawn().expect("the program starts");
        // Who is refused does not read what is piped in.
        let _ = child.stdin.take().expect("a pipe").write_all(input);
        let output = child.wait_with_output().expect("it ends");
        let [stdout, stderr] = [output.stdout, output.stderr].map(|said| String::from_utf8_lossy(&said).into_owned());
        assert_eq!(output.status.code(), Some(code), "cutc {arguments}\n{stdout}\n{stderr}");
        (stdout, stderr)
    }
}
