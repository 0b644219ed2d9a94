//! Dialogue about a machine: twelve questions, then a profile and a trial program for it.

use std::ffi::OsString;
use std::io::BufRead;
use std::path::{Path, PathBuf};

use super::questions::{QUESTIONS, Question};
use crate::cli::draft::write_new;
use crate::cli::finished::{Console, DONE, FAULTY, Finished, Run, failure};
use crate::machine::{Extent, Faults, MachineProfile, SHIPPED, Shipped, TRIAL, load};

/// File of the profile if none is named.
const PROFILE: &str = "machine.toml";

/// Asks about a machine, and writes its profile, the drawing of a trial and the trial's program.
///
/// # Errors
///
/// A file is there already, or the answers end before the questions do: then nothing is written. Or a file cannot be written.
pub(super) fn run(
    out: Option<&PathBuf>,
    answers: &mut dyn BufRead,
    console: &mut Console,
    cutc: Run,
) -> anyhow::Result<Finished> {
    let profile = out.cloned().unwrap_or_else(|| PathBuf::from(PROFILE));
    let drawing = profile.with_file_name(format!("{}-trial.cut", stem(&profile)));
    let program = drawing.with_extension("ngc");
    if let Some(there) = [&profile, &drawing, &program].into_iter().find(|path| path.exists()) {
        let message = format!("`{}` is there already", there.display());
        return Err(failure(message, "name another file with -o: no profile is overwritten"));
    }
    let mut dialogue = Dialogue { answers, console, asked: 0 };
    let shipped = dialogue.controller()?;
    let mut sets = Vec::new();
    for question in QUESTIONS {
        sets.extend(dialogue.about(question, shipped, &sets)?);
    }
    let text = shipped.beginning_with(&sets, Extent::Needed).map_err(|faults| refused(&faults))?;
    let limited = is_limited(&known(shipped, &sets)?);
    write_new(&profile, &text)?;
    write_new(&drawing, TRIAL)?;
    let command = command(&profile, &drawing, limited);
    let shown: Vec<String> = command.iter().map(|word| word.to_string_lossy().into_owned()).collect();
    let finished = cutc(&command, console);
    let files = format!("wrote `{}`\nwrote `{}`\n", profile.display(), drawing.display());
    let next = match finished.code {
        DONE => "`cutc manual trial` says how to cut it on paper and how to read what it shows\n",
        FAULTY => "the trial cannot be cut with these values: change them in the profile, and compile it again\n",
        _ => "",
    };
    let stderr = format!("{files}\n{}\n\n{}{next}", shown.join(" "), finished.stderr);
    Ok(Finished { stderr, ..finished })
}

/// The command that compiles the trial.
fn command(profile: &Path, drawing: &Path, limited: bool) -> Vec<OsString> {
    let mut words: Vec<OsString> = ["cutc", "compile"].map(OsString::from).to_vec();
    words.extend([drawing.into(), "-p".into(), named(profile).into(), "-o".into()]);
    words.push(drawing.with_extension("ngc").into());
    if limited {
        // The corner of the drawing comes to that of the table.
        words.extend(["--set", "sheet.origin=corner"].map(OsString::from));
    }
    words
}

/// Path of a profile as an argument: a name alone would be that of one that ships.
fn named(profile: &Path) -> PathBuf {
    if profile.components().count() == 1 { Path::new(".").join(profile) } else { profile.to_owned() }
}

/// Name of a file without folder and extension.
fn stem(path: &Path) -> String {
    path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned())
}

fn known(shipped: &Shipped, sets: &[String]) -> anyhow::Result<MachineProfile> {
    load(Some(&shipped.source()), sets).map_err(|faults| refused(&faults))
}

/// True if the table has ends.
fn is_limited(profile: &MachineProfile) -> bool {
    ["table.x_mm", "table.y_mm"].iter().any(|key| profile.value(key).is_some_and(|value| value.is_array()))
}

fn refused(faults: &Faults) -> anyhow::Error {
    failure(told(faults), "begin again: `cutc profile init --ask`")
}

/// Messages of faults with their hints.
fn told(faults: &Faults) -> String {
    let all = faults.arguments.iter().chain(faults.file.iter());
    let lines = all.flat_map(|fault| std::iter::once(fault.message.clone()).chain(fault.hints.iter().cloned()));
    lines.collect::<Vec<_>>().join("\n  ")
}

/// Questions and answers on a terminal or in a file.
struct Dialogue<'a, 'c> {
    answers: &'a mut dyn BufRead,
    console: &'a mut Console<'c>,
    /// Number of questions asked.
    asked: usize,
}

impl Dialogue<'_, '_> {
    /// The shipped profile of the machine's controller.
    fn controller(&mut self) -> anyhow::Result<&'static Shipped> {
        let width = SHIPPED.iter().map(|shipped| shipped.name.len()).max().unwrap_or_default();
        let list: Vec<String> =
            SHIPPED.iter().map(|shipped| format!("{:width$}  {}", shipped.name, shipped.about)).collect();
        let head = "An empty answer takes the value in brackets. Numbers are mm, degrees, ms and per second, unless a unit\n\
                    stands behind them: `45 m/min`, `0.25 in`, `2 rev/s`.\n";
        self.say(head)?;
        self.ask("Which controller does the machine have?", &list.join("\n  "))?;
        loop {
            let answer = self.answer(SHIPPED[0].name)?;
            if let Some(shipped) = Shipped::find(&answer) {
                return Ok(shipped);
            }
            self.say(&format!("  no profile has the name `{answer}`: give one of the names above\n"))?;
        }
    }

    /// Arguments by the answer to a question; none if the value of the profile holds.
    fn about(&mut self, question: &Question, shipped: &Shipped, sets: &[String]) -> anyhow::Result<Vec<String>> {
        let before = known(shipped, sets)?;
        let shown = question.answer(&before);
        self.ask(question.asks, &question.how.replace('\n', "\n  "))?;
        loop {
            let answer = self.answer(&shown)?;
            if answer == shown {
                return Ok(Vec::new());
            }
            let Some(arguments) = question.arguments(&answer) else {
                let count = question.keys.len();
                let values = if count == 1 {
                    "one value, without commas".to_owned()
                } else {
                    format!("{count} values with commas between them")
                };
                self.say(&format!("  give {values}, as in `{shown}`\n"))?;
                continue;
            };
            match load(Some(&shipped.source()), &[sets, &arguments[..]].concat()) {
                Ok(_) => return Ok(arguments),
                Err(faults) => self.say(&format!("  {}\n", told(&faults)))?,
            }
        }
    }

    fn ask(&mut self, question: &str, how: &str) -> anyhow::Result<()> {
        self.asked += 1;
        let (number, all) = (self.asked, QUESTIONS.len() + 1);
        self.say(&format!("\n{number}/{all}  {question}\n  {how}\n"))
    }

    /// The next answer, or what is shown if it is empty.
    fn answer(&mut self, shown: &str) -> anyhow::Result<String> {
        self.say(&format!("  [{shown}] "))?;
        let mut line = String::new();
        if self.answers.read_line(&mut line)? == 0 {
            return Err(failure("the answers end before the questions do", "nothing was written; begin again"));
        }
        let answer = line.trim();
        Ok(if answer.is_empty() { shown } else { answer }.to_owned())
    }

    fn say(&mut self, text: &str) -> anyhow::Result<()> {
        self.console.err.write_all(text.as_bytes())?;
        Ok(self.console.err.flush()?)
    }
}
