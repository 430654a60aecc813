//! A text scan of the loop's crates: what they promise not to contain. It strips comments, string literals and `#[cfg(test)]`
//! items, then looks for whole words; a scan this simple over-reports rather than under-reports.

use std::fs;
use std::path::{Path, PathBuf};

/// Calls that differ between host and ECU, or cost thousands of instructions there.
const FORBIDDEN_CALLS: [&str; 38] = [
    "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "sin_cos", "sinf", "cosf", "tanf", "asinf", "acosf", "atanf",
    "atan2f", "sincos", "sincosf", "sinh", "cosh", "tanh", "mul_add", "fma", "fmaf", "powf", "powi", "hypot", "hypotf",
    "exp", "ln", "log2", "log10", "cbrt", "min", "max", "fmin", "fmax", "fminf", "fmaxf",
];

/// Files that may hold the edge's angle of a vector.
const WITH_ATAN2: [&str; 2] = ["kinematics-core/src/real.rs", "kinematics-core/src/rotor.rs"];
const ATAN2: [&str; 2] = ["atan2", "atan2f"];
/// The file that may hold the hardware square root.
const WITH_UNSAFE: &str = "kinematics-core/src/sqrt.rs";

/// A broken promise: file, line (from 1), word.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Broken {
    /// From the repository's root.
    pub file: String,
    /// Counted from one.
    pub line: usize,
    /// What stands there.
    pub word: String,
}

/// The source with comments and the contents of string and character literals blanked, line numbers kept.
pub fn without_comments(source: &str) -> String {
    let mut out = String::with_capacity(source.len());
    let mut rest = source;
    while let Some(first) = rest.chars().next() {
        let skipped = if rest.starts_with("//") {
            rest.find('\n').unwrap_or(rest.len())
        } else if rest.starts_with("/*") {
            block_comment(rest)
        } else if first == '"' {
            literal(rest, '"')
        } else if rest.starts_with("'\\'") || rest.starts_with("'\"'") {
            // The two character literals that would open a string or never close.
            literal(rest, '\'')
        } else {
            0
        };
        if skipped == 0 {
            out.push(first);
            rest = &rest[first.len_utf8()..];
        } else {
            out.extend(rest[..skipped].chars().filter(|c| *c == '\n'));
            out.push(' ');
            rest = &rest[skipped..];
        }
    }
    out
}

/// Length of the block comment `text` begins with; they nest.
fn block_comment(text: &str) -> usize {
    let mut depth = 0;
    let mut at = 0;
    while at < text.len() {
        let rest = &text[at..];
        if rest.starts_with("/*") {
            (depth, at) = (depth + 1, at + 2);
        } else if rest.starts_with("*/") {
            (depth, at) = (depth - 1, at + 2);
            if depth == 0 {
                return at;
            }
        } else {
            at += rest.chars().next().map_or(1, char::len_utf8);
        }
    }
    text.len()
}

/// Length of the literal `text` begins with, escapes honoured.
fn literal(text: &str, quote: char) -> usize {
    let mut escaped = false;
    for (at, c) in text.char_indices().skip(1) {
        match c {
            _ if escaped => escaped = false,
            '\\' => escaped = true,
            _ if c == quote => return at + c.len_utf8(),
            _ => {}
        }
    }
    text.len()
}

/// Blanks every item behind `#[cfg(test)]` up to its closing brace or semicolon: tests run on the host alone.
pub fn without_tests(code: &str) -> String {
    const MARK: &str = "#[cfg(test)]";
    let mut out = String::new();
    let mut rest = code;
    while let Some(start) = rest.find(MARK) {
        out.push_str(&rest[..start]);
        let item = &rest[start..];
        let mut depth = 0;
        let end = item.char_indices().find_map(|(at, c)| match c {
            '{' => {
                depth += 1;
                None
            }
            '}' => {
                depth -= 1;
                (depth == 0).then_some(at + 1)
            }
            ';' if depth == 0 => Some(at + 1),
            _ => None,
        });
        let end = end.unwrap_or(item.len());
        out.extend(item[..end].chars().filter(|c| *c == '\n'));
        rest = &item[end..];
    }
    out + rest
}

/// The words of a line, each with whether it stands as a function: called, or named by a path (`f32::max`), not defined.
fn words(line: &str) -> Vec<(&str, bool)> {
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    let mut words = Vec::new();
    let mut at = 0;
    while let Some(start) = line[at..].find(is_word).map(|n| at + n) {
        let end = line[start..].find(|c| !is_word(c)).map_or(line.len(), |n| start + n);
        let (before, after) = (line[..start].trim_end(), line[end..].trim_start());
        let named = before.ends_with("::") || after.starts_with('(') || after.starts_with("::<");
        words.push((&line[start..end], named && !before.ends_with("fn")));
        at = end;
    }
    words
}

/// Whether `min`/`max` in this line is the integers' `core::cmp::min(a, b)`, which floats do not compile with.
fn is_of_integers(line: &str, word: &str) -> bool {
    line.contains(&format!("cmp::{word}(")) && !line.contains(&format!(".{word}("))
}

/// What `source`, standing in `file`, breaks.
pub fn broken(file: &str, source: &str) -> Vec<Broken> {
    let code = without_tests(&without_comments(source));
    let mut found = Vec::new();
    for (index, line) in code.lines().enumerate() {
        for (word, called) in words(line) {
            let bad = match word {
                "unsafe" => file != WITH_UNSAFE,
                _ if ATAN2.contains(&word) => called && !WITH_ATAN2.contains(&file),
                "min" | "max" => called && !is_of_integers(line, word),
                _ => called && FORBIDDEN_CALLS.contains(&word),
            };
            if bad {
                found.push(Broken { file: file.to_owned(), line: index + 1, word: word.to_owned() });
            }
        }
    }
    found
}

/// The repository's root.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// All Rust files of the loop: kinematics-core/src and firmware/src.
///
/// # Panics
/// When a folder cannot be read.
pub fn loop_sources() -> Vec<(String, String)> {
    let mut files = Vec::new();
    for folder in ["kinematics-core/src", "firmware/src"] {
        collect(folder, &mut files);
    }
    files
}

fn collect(folder: &str, files: &mut Vec<(String, String)>) {
    let entries = fs::read_dir(root().join(folder)).unwrap_or_else(|e| panic!("{folder}: {e}"));
    for entry in entries {
        let entry = entry.unwrap_or_else(|e| panic!("{folder}: {e}"));
        let path = format!("{folder}/{}", entry.file_name().to_string_lossy());
        if entry.path().is_dir() {
            collect(&path, files);
        } else if path.ends_with(".rs") {
            let text = fs::read_to_string(entry.path()).unwrap_or_else(|e| panic!("{path}: {e}"));
            files.push((path, text));
        }
    }
}
