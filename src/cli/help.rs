//! Long help: examples, dialects, targets, and a reference to the explanation of the profile.

use std::fmt::Write as _;

use crate::back::TARGETS;
use crate::front::DIALECTS;

/// Examples of commands.
pub(super) const EXAMPLES: &str = "  cutc compile marker.cut                     writes marker.csv, prints a summary
  cutc compile marker.cut -p machine.toml     for the machine that machine.toml describes
  cutc compile marker.cut --set knife.width_mm=7.2 -o out/
                                              with one key changed, into a directory
  cutc compile marker.cut -o marker.svg       a picture: the extension chooses the target
  cutc compile - -o - < marker.cut | less     from standard input to standard output
  cutc verify marker.csv --source marker.cut  judges a program, after an edit by hand too
  cutc verify out --source in                 all programs of a folder, each by its source
  cutc check *.cut                            says all that is wrong, writes nothing
  cutc info marker.cut --labels               what is in a file, and what its labels say
  cutc info marker.cut --format json          the same for a script
  cutc info in --rate 45/h --plies 40 --format csv
                                              a row a file: time, area, use of the cloth, costs
  cutc compile marker.cut --pieces 3,7-12     some pieces only; --skip and --resume-from likewise
  cutc compile marker.cut --dry-run           the same motion, knife up; --frame: once around the box
  cutc compile print.cut --map marks.csv      where the registration marks of a print were found
  cutc sew pocket.csv -t queue,svg            a pattern for a sewing machine: stitches, speeds
  cutc track log.csv -t centre                the line that moving cloth took: compile --centre follows it
  cutc flow marker.cut -o flow/ --speed 50    on a conveyor that moves: programs of several heads
  cutc explain iso/open-slit                  what a message means and what to do
  cutc manual many-files                      folders of files at once, several machines
  cutc profile init -o machine.toml           every key of a machine with its default
  cutc profile list                           ready profiles of controllers, for -p NAME
  cutc profile show -p machine.toml           the values in effect
";

/// Text below the list of commands.
pub(super) fn overview() -> String {
    format!("Examples:\n{EXAMPLES}\n{}", reference())
}

/// Dialects, targets, a reference to the profile, and exit codes.
pub(super) fn reference() -> String {
    let mut out = String::new();
    let dialects: Vec<_> = DIALECTS.iter().map(|dialect| (dialect.name, dialect.about)).collect();
    list(&mut out, "Dialects that are read (recognised by content; --from names one instead):", &dialects);
    let targets: Vec<_> = TARGETS.iter().map(|target| (target.name, target.about)).collect();
    list(&mut out, "Targets that are written (-t, or the extension of -o; else the first):", &targets);
    out.push_str(
        "The machine: without -p the defaults are a real cutter's, with a worn 6.6 mm knife.
`cutc profile init` prints every key of a profile with its meaning, range and default.

Exit codes: 0 done, 1 the data has errors or the program fails its verification,
2 wrong usage, or a file that cannot be read or written; 130, 143, 129 stopped
by Ctrl-C, SIGTERM, SIGHUP.",
    );
    out
}

fn list(out: &mut String, title: &str, rows: &[(&str, &str)]) {
    let width = rows.iter().map(|(name, _)| name.len()).max().unwrap_or(0);
    // Writing into a `String` cannot fail.
    let _ = writeln!(out, "{title}");
    for (name, about) in rows {
        let _ = writeln!(out, "  {name:width$}  {about}");
    }
    out.push('\n');
}
