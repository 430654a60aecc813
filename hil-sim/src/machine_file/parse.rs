//! Text → file structs. The tag is read first and then the one layout it names, strictly, so that no error loses the
//! name of its field.

use serde::Deserialize;
use serde::de::DeserializeOwned;

use super::frankel::FrankelFile;
use super::koivo::KoivoFile;
use super::pins::PinsFile;
use crate::toml_text::{self, Fault};

/// The file in one of its layouts.
pub(super) enum Parsed {
    Pins(PinsFile),
    Frankel(FrankelFile),
    Koivo(KoivoFile),
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

const TAGS: [toml_text::Tag; 4] = [
    ("kind", "`\"pins\"` or `\"distances\"`"),
    ("labels", "`\"frankel\"` or `\"koivo\"`"),
    ("boom_cylinder", "`\"below\"` or `\"above\"`"),
    ("hydraulics.compensation", "`\"pre\"` or `\"post\"`"),
];

fn strictly<T: DeserializeOwned>(text: &str) -> Result<T, Fault> {
    toml_text::strictly(text, &TAGS)
}

pub(super) fn parse(text: &str) -> Result<Parsed, Fault> {
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
