//! The manual, a page a topic, in markdown: `cutc manual PAGE` prints one.
//!
//! What stands there in code blocks is run by the tests: commands, scripts for many machines.

/// A page.
#[derive(Debug, Clone, Copy)]
pub struct Page {
    /// As it is asked for: the name of its file.
    pub name: &'static str,
    /// What it is about, in a sentence.
    pub about: &'static str,
    /// Its text in markdown.
    pub text: &'static str,
}

/// Every page, in the order of reading.
pub const PAGES: &[Page] = &[
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
];
