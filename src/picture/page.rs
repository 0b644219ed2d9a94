//! The page: its scripts and styles, which alone it may run, its texts, its facts and its columns.

use std::io::{self, Write};

use serde_json::Value;
use sha2::{Digest, Sha256};

use super::markup::{escape, inert};
use super::pack::{Columns, base64};

/// Style of all pages.
const STYLE: &str = include_str!("player/style.css");

/// Script of a page, by the machine that it plays.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Script {
    /// The cutting of a marker; a page without a player has its tables sorted.
    Cutting,
    /// Heads over a conveyor.
    Heads,
    /// A pattern that is sewn.
    Sewing,
}

impl Script {
    /// Markup of the player.
    pub fn markup(self) -> &'static str {
        match self {
            Self::Cutting => include_str!("player/player.html"),
            Self::Heads => include_str!("player/heads.html"),
            Self::Sewing => include_str!("player/sewing.html"),
        }
    }

    /// Files of the script, in the order in which they stand in the page.
    fn files(self) -> &'static [&'static str] {
        match self {
            Self::Cutting => &[
                DATA,
                CANVAS,
                include_str!("player/motion.js"),
                VIEW,
                include_str!("player/colours.js"),
                include_str!("player/cloth.js"),
                include_str!("player/charts.js"),
                include_str!("player/report.js"),
                STAGE,
                include_str!("player/controls.js"),
                include_str!("player/main.js"),
            ],
            Self::Heads => &[DATA, CANVAS, VIEW, STAGE, include_str!("player/heads.js")],
            Self::Sewing => &[DATA, CANVAS, VIEW, STAGE, include_str!("player/sewing.js")],
        }
    }

    /// All files as one script that leaves no name behind but `cutc`.
    fn text(self) -> String {
        format!("\"use strict\";\n(() => {{\n{}}})();\n", self.files().concat())
    }
}

/// Files that several scripts share.
const DATA: &str = include_str!("player/data.js");
const CANVAS: &str = include_str!("player/canvas.js");
const VIEW: &str = include_str!("player/view.js");
const STAGE: &str = include_str!("player/stage.js");

/// A page of one file.
#[derive(Debug)]
pub struct Page {
    /// Title, as text.
    pub title: String,
    /// Markup of the body.
    pub body: String,
    /// Facts that the script reads.
    pub facts: Value,
    /// Numbers that the script reads.
    pub columns: Columns,
    /// Script that plays them.
    pub script: Script,
}

impl Page {
    /// Writes the page. Nothing in it runs but the script that is written here, and nothing is loaded.
    pub fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        let script = self.script.text();
        let policy = format!(
            "default-src 'none'; script-src '{}'; style-src '{}'; base-uri 'none'; form-action 'none'",
            digest(&script),
            digest(STYLE)
        );
        let mut facts = self.facts.clone();
        facts["columns"] = self.columns.names();
        write!(
            out,
            "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta http-equiv=\"Content-Security-Policy\" content=\"{}\">\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
             <meta name=\"color-scheme\" content=\"light dark\">\n\
             <title>{}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n{}\
             <script type=\"application/json\" id=\"facts\">{}</script>\n\
             <script type=\"text/plain\" id=\"columns\">{}</script>\n\
             <script>{script}</script>\n</body>\n</html>\n",
            escape(&policy),
            escape(&self.title),
            self.body,
            inert(&facts.to_string()),
            self.columns.packed(),
        )
    }
}

/// The digest of a text as a policy names it.
fn digest(text: &str) -> String {
    format!("sha256-{}", base64(&Sha256::digest(text.as_bytes())))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scripts_and_styles_cannot_end_their_elements() {
        let scripts = [Script::Cutting, Script::Heads, Script::Sewing].map(Script::text);
        for text in scripts.iter().map(String::as_str).chain([STYLE]) {
            assert!(!text.contains("</") && !text.contains("<!--"));
        }
    }
}
