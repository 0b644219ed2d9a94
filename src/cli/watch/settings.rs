//! The options of a hot folder: those of the command line, and those that `cutc.toml` in the folder adds.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use clap::Parser;

use super::arguments::Arguments;
use super::settling::Stamp;
use crate::back::{TARGETS, Target};
use crate::cli::compile::one_map;
use crate::cli::destination::targets_of_many;
use crate::cli::files;
use crate::cli::finished::{Finished, failure};
use crate::cli::options;
use crate::machine::Job;

/// The file with the options of a folder.
pub(super) const NAME: &str = "cutc.toml";
/// Options with a file name, which is relative to the folder of the options.
const FILES: [&str; 2] = ["profile", "centre"];

/// Stamps of some files; `None` if a file does not exist.
pub(super) type Stamps = Vec<Option<Stamp>>;

/// Options that cannot change while the folder is watched.
const OF_THE_RUN: [&str; 2] = ["out", "jobs"];

/// Options of a hot folder.
pub(super) struct Settings {
    pub(super) arguments: Arguments,
    pub(super) targets: Vec<&'static Target>,
    pub(super) job: Job,
    /// Files that contain them.
    read: Vec<PathBuf>,
    /// Stamps of these files before they were read.
    stamps: Stamps,
}

/// The words of a command line, for clap.
#[derive(Debug, Parser)]
#[command(name = "cutc watch", no_binary_name = true, disable_help_flag = true)]
struct Words {
    #[command(flatten)]
    arguments: Arguments,
}

impl Settings {
    /// Reads the options. `typed` are the words of the command line after `watch`.
    pub(super) fn read(folder: &Path, typed: &[OsString]) -> anyhow::Result<Result<Self, Finished>> {
        let file = folder.join(NAME);
        let stamp = Stamp::at(&file);
        let mut words = if stamp.is_some() { words(&file, folder)? } else { Vec::new() };
        let added = !words.is_empty();
        words.extend(typed.iter().cloned());
        let Words { arguments } = Words::try_parse_from(words).map_err(|misuse| {
            let message = misuse.to_string();
            let message = message.trim_start_matches("error: ").split("\n\n").next().unwrap_or_default().to_owned();
            let from = if added { format!("`{}` and the command line: ", file.display()) } else { String::new() };
            failure(format!("{from}{message}"), "its keys are the long options of `cutc watch`, each given once")
        })?;
        let [profile, centre, map] = arguments.making.beside();
        if map.is_some() {
            return Err(one_map());
        }
        let targets = targets_of_many(arguments.making.place(), TARGETS, arguments.making.targets())?;
        arguments.making.check_remarks(&targets)?;
        let named: Vec<PathBuf> = [profile, centre].into_iter().flatten().map(Path::to_owned).collect();
        let stamps = std::iter::once(stamp).chain(named.iter().map(|path| Stamp::at(path))).collect();
        let read = std::iter::once(file).chain(named).collect();
        Ok(arguments.making.job()?.map(|job| Self { arguments, targets, job, read, stamps }))
    }

    /// True if a file is one of those that contain the options.
    pub(super) fn says(&self, path: &Path) -> bool {
        self.read.iter().any(|read| read == path)
    }

    /// Stamps of the files before they were read.
    pub(super) fn stamps(&self) -> &Stamps {
        &self.stamps
    }

    /// Present stamps of the files.
    pub(super) fn look(&self) -> Stamps {
        self.read.iter().map(|path| Stamp::at(path)).collect()
    }
}

/// Options in a file, as words of a command line.
fn words(file: &Path, folder: &Path) -> anyhow::Result<Vec<OsString>> {
    let source = files::read(file)?;
    let wrong = |what: String| {
        let hint =
            "write options as in `target = [\"gcode\", \"svg\"]`, `profile = \"machine.toml\"`, `cut-all = true`";
        failure(format!("`{}`: {what}", file.display()), hint)
    };
    let text = std::str::from_utf8(source.bytes()).map_err(|error| wrong(error.to_string()))?;
    let table: toml::Table = text.parse().map_err(|error: toml::de::Error| wrong(error.to_string()))?;
    let mut words = Vec::new();
    for (key, value) in table {
        if OF_THE_RUN.contains(&key.as_str()) {
            return Err(wrong(format!("`{key}` is an option of the whole run: give it on the command line")));
        }
        let values = match value {
            toml::Value::Array(values) => values,
            value => vec![value],
        };
        for value in values {
            let value = match value {
                toml::Value::Boolean(true) => {
                    words.push(format!("--{key}").into());
                    continue;
                }
                toml::Value::Boolean(false) => continue,
                toml::Value::String(path) if FILES.contains(&key.as_str()) => beside(folder, &key, &path),
                toml::Value::String(text) => text.into(),
                toml::Value::Integer(number) => number.to_string().into(),
                toml::Value::Float(_) | toml::Value::Datetime(_) | toml::Value::Array(_) | toml::Value::Table(_) => {
                    return Err(wrong(format!("`{key}` is neither text, nor a whole number, nor true or false")));
                }
            };
            let mut word = OsString::from(format!("--{key}="));
            word.push(value);
            words.push(word);
        }
    }
    Ok(words)
}

/// File of an option as it is relative to the folder; a profile may be one that ships.
fn beside(folder: &Path, key: &str, path: &str) -> OsString {
    let file = folder.join(path);
    let ships = key == "profile" && !file.is_file() && options::shipped(Path::new(path)).is_some();
    if ships { path.into() } else { file.into_os_string() }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    /// Reads the options of a folder with this file, beside a command line.
    fn read(text: &str, typed: &[&str]) -> Result<Settings, String> {
        let room = tempfile::tempdir().expect("a directory");
        fs::write(room.path().join(NAME), text).expect("writable");
        fs::write(room.path().join("machine.toml"), "knife.width_mm = 7.2\n").expect("writable");
        let typed: Vec<OsString> = typed.iter().map(OsString::from).collect();
        let settings = Settings::read(room.path(), &typed).map_err(|error| error.to_string())?;
        settings.map_err(|refused| refused.stderr)
    }

    #[test]
    fn options_of_the_folder_and_of_the_command_line_act_together() {
        let settings = read(
            "target = [\"gcode\", \"svg\"]\nprofile = \"machine.toml\"\nset = [\"time.period_ms=2\"]",
            &["in", "-o", "out"],
        )
        .expect("options");
        let names: Vec<_> = settings.targets.iter().map(|target| target.name).collect();
        assert_eq!(names, ["gcode", "svg"]);
        assert_eq!((settings.job.profile.knife.width_mm, settings.job.profile.time.period_ms), (7.2, 2.0));
        let settings = read("profile = \"fluidnc\"", &["in", "-o", "out"]).expect("a profile that ships");
        assert_eq!(settings.job.origin.name(), "fluidnc");
        let settings = read("no-verify = false", &["in", "-o", "out", "--set", "knife.width_mm=5"]).expect("options");
        assert_eq!((settings.targets[0].name, settings.job.profile.knife.width_mm), ("csv", 5.0));
    }

    #[test]
    fn options_that_are_none_are_refused() {
        let refused = |text: &str| read(text, &["in", "-o", "out", "-p", "p.toml"]).err().expect("refused");
        assert!(refused("knife = 1").contains("--knife"), "{}", refused("knife = 1"));
        assert!(refused("target = \"nc\"").contains("gcode"), "{}", refused("target = \"nc\""));
        assert!(refused("profile = \"machine.toml\"").contains("multiple times"));
        assert!(refused("set = [1.5]").contains("`set` is neither"));
        assert!(refused("= 1").contains("cutc.toml"));
        assert!(refused("jobs = 2").contains("`jobs` is an option of the whole run"));
    }
}
