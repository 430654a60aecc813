//! TOML text → structs, strictly: every message names the field by its path, and the line where there is one.

use std::fmt;

use serde::de::DeserializeOwned;

/// A fault in a text: what, and on which line (from 1) where that is known.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Fault {
    pub(crate) line: Option<usize>,
    pub(crate) what: String,
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(line) = self.line {
            write!(f, "line {line}: ")?;
        }
        f.write_str(&self.what)
    }
}

/// A field that names one of a few things, and what it may name.
pub(crate) type Tag = (&'static str, &'static str);

/// Parses a text into a struct, whose own `deny_unknown_fields` make it strict. `tags` say what serde cannot of a tag that
/// is missing or of the wrong type.
pub(crate) fn strictly<T: DeserializeOwned>(text: &str, tags: &[Tag]) -> Result<T, Fault> {
    let text = text.trim_start_matches('\u{feff}');
    let deserializer = toml::Deserializer::parse(text).map_err(|e| fault(text, "", &e, tags))?;
    serde_path_to_error::deserialize(deserializer).map_err(|e| {
        let path = e.path().to_string();
        fault(text, if path == "." { "" } else { &path }, e.inner(), tags)
    })
}

fn fault(text: &str, path: &str, error: &toml::de::Error, tags: &[Tag]) -> Fault {
    let message = error.message();
    let missing = message.starts_with("missing field");
    let start = error.span().map(|span| span.start.min(text.len()));
    // A line number for what stands in the text; for what is missing at top level there is no line.
    let line = start.filter(|_| !(path.is_empty() && missing)).map(|at| line_number(text, at));
    let allowed = |field: &str| tags.iter().find(|(tag, _)| *tag == field).map(|(_, allowed)| *allowed);
    let what = match (path, missing) {
        ("", true) => {
            let field = message.split('`').nth(1).unwrap_or_default();
            let or_what = allowed(field).map(|allowed| format!(", and must be {allowed}")).unwrap_or_default();
            format!("{message}: it is required, at the top of the file{or_what}")
        }
        ("", false) => {
            let here = line.and_then(|n| text.lines().nth(n - 1)).map(str::trim).unwrap_or_default();
            format!("{message}: {here}")
        }
        (table, true) => format!("`[{table}]`: {message}: every field of a table is required"),
        (field, false) => match allowed(field) {
            // A tag of the wrong type: serde speaks of its own types.
            Some(allowed) if !message.contains("expected") => format!("`{field}` must be {allowed}"),
            _ => format!("`{field}`: {message}"),
        },
    };
    Fault { line, what }
}

fn line_number(text: &str, at: usize) -> usize {
    text.as_bytes()[..at].iter().filter(|&&byte| byte == b'\n').count() + 1
}
