//! Text → file structs. The tag is read first and then the one layout it names, strictly, so that no error loses the
//! name of its field.

use serde::Deserialize;
use serde::de::DeserializeOwned;

use super::frankel::FrankelFile;
use super::koivo::KoivoFile;
use super::pins::PinsFile;

/// The file in one of its layouts.
pub(super) enum Parsed {
    Pins(PinsFile),
    Frankel(FrankelFile),
    Koivo(KoivoFile),
}

/// A fault in the text: what, and on which line (from 1) where that is known.
#[derive(Debug)]
pub(super) struct Fault {
    pub(super) line: Option<usize>,
    pub(super) what: String,
}

/// Only what tells the layout; everything else is judged by the layout itself.
#[derive(Deserialize)]
struct Tag {
    kind: Kind,
    labels: Option<Labels>,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Kind {
    Pins,
    Distances,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Labels {
    Frankel,
    Koivo,
}

pub(super) fn parse(text: &str) -> Result<Parsed, Fault> {
    let text = text.trim_start_matches('\u{feff}');
    let tag: Tag = strictly(text)?;
    match (tag.kind, tag.labels) {
        // `labels` with pins is an unknown field of that layout.
        (Kind::Pins, _) => strictly(text).map(Parsed::Pins),
        (Kind::Distances, Some(Labels::Frankel)) => strictly(text).map(Parsed::Frankel),
        (Kind::Distances, Some(Labels::Koivo)) => strictly(text).map(Parsed::Koivo),
        (Kind::Distances, None) => Err(Fault {
            line: None,
            what: "missing field `labels`: `kind = \"distances\"` needs `labels = \"frankel\"` or `\"koivo\"`".into(),
        }),
    }
}

fn strictly<T: DeserializeOwned>(text: &str) -> Result<T, Fault> {
    let deserializer = toml::Deserializer::parse(text).map_err(|e| fault(text, "", &e))?;
    serde_path_to_error::deserialize(deserializer).map_err(|e| {
        let path = e.path().to_string();
        fault(text, if path == "." { "" } else { &path }, e.inner())
    })
}

fn fault(text: &str, path: &str, error: &toml::de::Error) -> Fault {
    let start = error.span().map(|span| span.start.min(text.len()));
    // A line number for what stands in the text; for what is missing at top level there is no line.
    let line = start.filter(|_| !(path.is_empty() && missing(error))).map(|at| line_number(text, at));
    let message = error.message();
    let what = match (path, missing(error)) {
        ("", true) => match message {
            "missing field `kind`" => {
                "missing field `kind`: it must be `\"pins\"` or `\"distances\"`, at the top of the file".to_owned()
            }
            _ => format!("{message}: every field of a machine file is required, but for the table `[swing]` of pins"),
        },
        ("", false) => {
            let here = line.and_then(|n| text.lines().nth(n - 1)).map(str::trim).unwrap_or_default();
            format!("{message}: {here}")
        }
        (table, true) => format!("`[{table}]`: {message}: every field of a table is required"),
        // A tag of the wrong type: serde speaks of its own types.
        (field @ ("kind" | "labels" | "boom_cylinder"), false) if !message.contains("expected") => {
            let allowed = match field {
                "kind" => "`\"pins\"` or `\"distances\"`",
                "labels" => "`\"frankel\"` or `\"koivo\"`",
                _ => "`\"below\"` or `\"above\"`",
            };
            format!("`{field}` must be {allowed}")
        }
        (field, false) => format!("`{field}`: {message}"),
    };
    Fault { line, what }
}

fn missing(error: &toml::de::Error) -> bool {
    error.message().starts_with("missing field")
}

fn line_number(text: &str, at: usize) -> usize {
    text.as_bytes()[..at].iter().filter(|&&byte| byte == b'\n').count() + 1
}
