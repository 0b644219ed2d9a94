//! The manual, a page a topic, in markdown: `cutc manual PAGE` prints one.
//!
//! The tests run the code blocks: commands, and scripts for many machines.

/// A page.
#[derive(Debug, Clone, Copy)]
pub struct Page {
    /// Name by which it is asked for: that of its file.
    pub name: &'static str,
    /// Subject, in a sentence.
    pub about: &'static str,
    /// Its text in markdown.
    pub text: &'static str,
}

/// A word of the trade.
#[derive(Debug)]
pub struct Entry {
    /// The word.
    pub term: &'static str,
    /// Definition, without line breaks.
    pub text: String,
}

/// The page that explains words: a paragraph each, which begins with the word in bold and a colon.
const GLOSSARY: &str = include_str!("glossary.md");

/// The words that the glossary explains, in its order.
pub fn glossary() -> impl Iterator<Item = Entry> {
    GLOSSARY.split("\n\n").filter_map(|paragraph| {
        let (term, text) = paragraph.strip_prefix("**")?.split_once("**: ")?;
        Some(Entry { term, text: text.trim_end().replace('\n', " ") })
    })
}

/// Every page, in the order of reading.
pub const PAGES: &[Page] = &[
    Page {
        name: "inputs",
        about: "What is read: dialects, codes of cut files, lines of plots",
        text: include_str!("inputs.md"),
    },
    Page {
        name: "targets",
        about: "What is written: setpoints, counts, HAL, G-code, cut files, JSON, pictures, the page that plays",
        text: include_str!("targets.md"),
    },
    Page {
        name: "first-cut",
        about: "Machines with G-code: zero, the blade's angle, tries without a knife, overrides, pause, abort",
        text: include_str!("first-cut.md"),
    },
    Page {
        name: "trial",
        about: "Questions about a machine with G-code, and how to read the trial that they end with",
        text: include_str!("trial.md"),
    },
    Page {
        name: "cutting",
        about: "How it cuts: corners, order, overlaps, common lines, notches, curves, the turn of the blade",
        text: include_str!("cutting.md"),
    },
    Page {
        name: "sewing",
        about: "The pattern-sewing machine: stitches, speeds, feed pulses, stitch files",
        text: include_str!("sewing.md"),
    },
    Page {
        name: "tracking",
        about: "Cloth that moves: a carriage that follows its centre, and markers that do",
        text: include_str!("tracking.md"),
    },
    Page {
        name: "flow",
        about: "Flow cutting: heads in rows over a conveyor, from chains to programs, rules",
        text: include_str!("flow.md"),
    },
    Page {
        name: "spray",
        about: "Heads that follow an edge at a distance; wheels, pens, routers",
        text: include_str!("spray.md"),
    },
    Page {
        name: "verification",
        about: "How a program is verified, and every rule",
        text: include_str!("verification.md"),
    },
    Page {
        name: "profile",
        about: "The machine profile: every key with its default, range and meaning",
        text: include_str!("profile.md"),
    },
    Page { name: "diagnostics", about: "What is said of a file: every code", text: include_str!("diagnostics.md") },
    Page {
        name: "many-files",
        about: "Folders of files at once, only what was changed, several machines side by side",
        text: include_str!("many-files.md"),
    },
    Page {
        name: "hot-folder",
        about: "Files that come into a folder are compiled there and then",
        text: include_str!("hot-folder.md"),
    },
    Page {
        name: "figures",
        about: "What was measured, with the commands that repeat it",
        text: include_str!("figures.md"),
    },
    Page {
        name: "extending",
        about: "Adding a dialect, a target or a machine: rows of tables",
        text: include_str!("extending.md"),
    },
    Page { name: "glossary", about: "Words of the trade", text: GLOSSARY },
];
