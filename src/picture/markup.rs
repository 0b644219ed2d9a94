//! Text of a page: what HTML and JSON in it ask of letters, and elements with text in them.

use std::fmt::Write as _;

/// Text as it may stand in an element of HTML or XML, or in an attribute between double quotes.
pub fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            // XML 1.0 knows no other control characters, not even escaped.
            c if c.is_control() && !matches!(c, '\t' | '\n' | '\r') => escaped.push('\u{fffd}'),
            c => escaped.push(c),
        }
    }
    escaped
}

/// JSON as it may stand in a script element: no text in it can end the element or begin a comment.
pub(super) fn inert(json: &str) -> String {
    json.replace('&', "\\u0026").replace('<', "\\u003c").replace('>', "\\u003e")
}

/// Markup that is written element by element. Texts and values of attributes are escaped; names are the caller's own.
#[derive(Debug, Default)]
pub struct Markup(String);

impl Markup {
    /// Opens an element with attributes.
    pub fn open(&mut self, name: &str, attributes: &[(&str, &str)]) -> &mut Self {
        let _infallible = write!(self.0, "<{name}");
        for (attribute, value) in attributes {
            let _infallible = write!(self.0, " {attribute}=\"{}\"", escape(value));
        }
        self.0.push('>');
        self
    }

    /// Closes an element.
    pub fn close(&mut self, name: &str) -> &mut Self {
        let _infallible = writeln!(self.0, "</{name}>");
        self
    }

    /// Adds text.
    pub fn text(&mut self, text: &str) -> &mut Self {
        self.0.push_str(&escape(text));
        self
    }

    /// Adds text in which names stand between backticks: these become code.
    pub fn prose(&mut self, text: &str) -> &mut Self {
        let parts: Vec<&str> = text.split('`').collect();
        for (i, part) in parts.iter().enumerate() {
            let is_code = i % 2 == 1 && i + 1 < parts.len();
            let part = escape(part);
            if is_code {
                let _infallible = write!(self.0, "<code>{part}</code>");
            } else {
                self.0.push_str(&part);
            }
        }
        self
    }

    /// Adds an element with nothing but text in it.
    pub fn element(&mut self, name: &str, attributes: &[(&str, &str)], text: &str) -> &mut Self {
        self.open(name, attributes).text(text).close(name)
    }

    /// Adds markup as it stands.
    pub fn markup(&mut self, markup: &'static str) -> &mut Self {
        self.0.push_str(markup);
        self
    }

    /// The markup as text.
    pub fn into_text(self) -> String {
        self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_between_backticks_are_code() {
        let mut markup = Markup::default();
        markup.prose("set `a<b` or `c`, `").prose("as `it is");
        assert_eq!(markup.into_text(), "set <code>a&lt;b</code> or <code>c</code>, as it is");
    }

    #[test]
    fn no_text_becomes_markup() {
        let mut markup = Markup::default();
        markup.element("td", &[("title", "a\"b")], "</script><img onerror='x'>\u{1b}");
        assert_eq!(markup.into_text(), "<td title=\"a&quot;b\">&lt;/script&gt;&lt;img onerror='x'&gt;\u{fffd}</td>\n");
        assert_eq!(inert(r#"{"a":"</script><!--&"}"#), r#"{"a":"\u003c/script\u003e\u003c!--\u0026"}"#);
    }
}
