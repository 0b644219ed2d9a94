//! The page: its scripts and styles, which alone it may run, its texts, its facts and its columns.

use std::io::{self, Write};

use serde_json::Value;
use sha2::{Digest, Sha256};

use super::markup::{escape, inert};
use super::pack::{Columns, base64};

/// Style of all pages.
const STYLE: &str = include_str!("player/style.css");

/// Scripts of the player, in the order in which they stand in the page.
const SCRIPTS: &[&str] = &[
    include_str!("player/data.js"),
    include_str!("player/motion.js"),
    include_str!("player/view.js"),
    include_str!("player/colours.js"),
    include_str!("player/cloth.js"),
    include_str!("player/charts.js"),
    include_str!("player/report.js"),
    include_str!("player/controls.js"),
    include_str!("player/main.js"),
];

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
}

/// The markup of the player: cloth, charts and controls.
pub const fn player() -> &'static str {
    include_str!("player/player.html")
}

impl Page {
    /// Writes the page. Nothing in it runs but the script that is written here, and nothing is loaded.
    pub fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        let script = script();
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

/// All scripts as one that leaves no name behind but `cutc`.
fn script() -> String {
    format!("\"use strict\";\n(() => {{\n{}}})();\n", SCRIPTS.concat())
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
        for text in SCRIPTS.iter().chain([&STYLE]) {
            assert!(!text.contains("</") && !text.contains("<!--"), "{}", &text[..40.min(text.len())]);
        }
    }
}
