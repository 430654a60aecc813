//! A record as JSON, as a table of fields, and against another.

use firmware::store::copy::{FORMAT_VERSION, HEADER_BYTES, decode};
use firmware::store::{Name, Sealed, StoredRecord};
use serde_json::{Value, json};

/// The whole record with its header, every field by name.
pub fn json(sealed: &Sealed) -> Value {
    let bytes = sealed.as_bytes();
    // A sealed record has been decoded or validated before.
    let record = decode(bytes).map(|decoded| fields(&decoded.record)).unwrap_or(Value::Null);
    json!({
        "format_version": FORMAT_VERSION,
        "data_bytes": bytes.len() - HEADER_BYTES,
        "approved": sealed.is_approved(),
        "record": record,
    })
}

fn name(name: &Name) -> Value {
    name.text().into()
}

fn fields(record: &StoredRecord) -> Value {
    let buckets: Vec<Value> = record
        .buckets
        .iter()
        .flatten()
        .map(|bucket| {
            json!({
                "name": name(&bucket.name),
                "bucket_m": bucket.bucket_m,
                "coupler_pin": bucket.coupler_pin,
                "coupler_m": bucket.coupler_m,
            })
        })
        .collect();
    json!({ "machine": name(&record.machine), "parameters": record.parameters, "buckets": buckets, "mounted": record.mounted })
}

/// Every field as `path` and value, in the record's order.
fn flat(path: &str, value: &Value, out: &mut Vec<(String, String)>) {
    match value {
        Value::Object(map) => map.iter().for_each(|(key, value)| {
            let path = if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
            flat(&path, value, out);
        }),
        Value::Array(list) => {
            list.iter().enumerate().for_each(|(index, value)| flat(&format!("{path}[{index}]"), value, out));
        }
        value => out.push((path.to_owned(), value.to_string())),
    }
}

fn flattened(sealed: &Sealed) -> Vec<(String, String)> {
    let mut out = Vec::new();
    flat("", &json(sealed), &mut out);
    out
}

/// One field a line.
pub fn table(sealed: &Sealed) -> String {
    flattened(sealed).iter().map(|(path, value)| format!("  {path:<52} {value}\n")).collect()
}

/// A field that two records do not share.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
pub struct Difference {
    /// Its path.
    pub field: String,
    /// In the first record; `None` when it has no such field.
    pub first: Option<String>,
    /// In the second.
    pub second: Option<String>,
}

/// The fields in which two records differ.
pub fn differences(first: &Sealed, second: &Sealed) -> Vec<Difference> {
    let (first, second) = (flattened(first), flattened(second));
    let find = |list: &[(String, String)], field: &str| {
        list.iter().find(|(path, _)| path == field).map(|(_, value)| value.clone())
    };
    let missing = second.iter().filter(|(path, _)| find(&first, path).is_none());
    let mut all: Vec<Difference> = first
        .iter()
        .chain(missing)
        .map(|(path, _)| Difference { field: path.clone(), first: find(&first, path), second: find(&second, path) })
        .collect();
    all.retain(|difference| difference.first != difference.second);
    all
}
