//! Every public function of kinematics-core stands in an example that runs, so that its documentation shows how it is called.

use std::collections::{BTreeMap, BTreeSet};

use cross_tests::promises::{loop_sources, without_comments, without_tests};

/// The lines inside the fences of the doc comments, their own comments taken off. Fences that do not run (`text`) do not count.
fn examples(source: &str) -> String {
    let (mut inside, mut runs) = (false, false);
    let mut out = String::new();
    for line in source.lines().map(str::trim_start) {
        let Some(text) = line.strip_prefix("///").or_else(|| line.strip_prefix("//!")) else {
            (inside, runs) = (false, false);
            continue;
        };
        if let Some(language) = text.trim().strip_prefix("```") {
            inside = !inside;
            runs = inside && ["", "rust"].contains(&language);
        } else if runs {
            out.push_str(text.split("//").next().unwrap_or_default());
            out.push('\n');
        }
    }
    out
}

/// The word `text` begins with.
fn word(text: &str) -> &str {
    let end = text.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(text.len());
    &text[..end]
}

/// The names of the functions a source makes public: its `pub fn`, and the `fn` of its `pub trait`s.
fn public_functions(source: &str) -> BTreeSet<String> {
    let code = without_tests(&without_comments(source));
    let mut in_trait = false;
    let mut names = BTreeSet::new();
    for line in code.lines() {
        in_trait = (in_trait || line.starts_with("pub trait ")) && !line.starts_with('}');
        let public = line.trim_start().strip_prefix("pub ").or_else(|| in_trait.then(|| line.trim_start()));
        let Some(item) = public else { continue };
        let item = ["const ", "unsafe "].iter().fold(item, |item, q| item.strip_prefix(q).unwrap_or(item));
        if let Some(name) = item.strip_prefix("fn ") {
            names.insert(word(name).to_owned());
        }
    }
    names
}

/// Whether `examples` call `name`, or name it by a path.
fn is_used(name: &str, examples: &str) -> bool {
    examples.match_indices(name).any(|(at, _)| {
        let (before, after) = (&examples[..at], &examples[at + name.len()..]);
        let whole = !before.ends_with(|c: char| c.is_alphanumeric() || c == '_') && word(after).is_empty();
        let defined = before.trim_end().ends_with("fn");
        whole && !defined && (before.ends_with("::") || after.starts_with('(') || after.starts_with("::"))
    })
}

/// `file: name` of what stands in no example. A name that several files define must stand in each one's own.
fn without_example(sources: &[(String, String)]) -> Vec<String> {
    let mut definers: BTreeMap<String, Vec<&str>> = BTreeMap::new();
    for (file, source) in sources {
        for name in public_functions(source) {
            definers.entry(name).or_default().push(file);
        }
    }
    let of = |file: &str| sources.iter().filter(|(name, _)| name == file).map(|(_, source)| examples(source)).collect();
    let all: String = sources.iter().map(|(_, source)| examples(source)).collect();
    let mut missing = Vec::new();
    for (name, files) in definers {
        for &file in &files {
            let own: String = if files.len() > 1 { of(file) } else { all.clone() };
            if !is_used(&name, &own) {
                missing.push(format!("{file}: {name}"));
            }
        }
    }
    missing
}

fn source(file: &str, text: &str) -> (String, String) {
    (file.to_owned(), text.to_owned())
}

#[test]
fn every_public_function_of_the_core_stands_in_an_example() {
    let sources: Vec<_> =
        loop_sources().into_iter().filter(|(file, _)| file.starts_with("kinematics-core/src/")).collect();
    let functions: usize = sources.iter().map(|(_, source)| public_functions(source).len()).sum();
    assert!(functions > 100, "only {functions} public functions were found");
    let missing = without_example(&sources);
    assert!(missing.is_empty(), "these public functions stand in no doc example: {missing:#?}");
}

#[test]
fn a_function_without_an_example_is_named() {
    let text = "/// ```\n/// a(1);\n/// ```\npub fn a() {}\n\npub const fn b() {}\n\npub(crate) fn c() {}\nfn d() {}\n";
    assert_eq!(without_example(&[source("x.rs", text)]), ["x.rs: b"]);
}

#[test]
fn a_trait_s_functions_are_public_and_those_of_its_implementations_and_tests_are_not_asked_for() {
    let text = "pub trait T {\n    fn a(self);\n}\nimpl T for f32 {\n    fn a(self) {}\n    fn b() {}\n}\n\
                #[cfg(test)]\nmod tests {\n    pub fn c() {}\n}\n";
    assert_eq!(without_example(&[source("x.rs", text)]), ["x.rs: a"]);
}

#[test]
fn a_comment_a_longer_name_a_field_or_a_fence_that_does_not_run_is_no_example() {
    let text = "//! a(1)\n//! ```\n//! aa(1); p.a; let a = 2; // a(1)\n//! fn a() {}\n//! ```\n//! ```text\n//! a(1)\n//! ```\npub fn a() {}\n";
    assert_eq!(without_example(&[source("x.rs", text)]), ["x.rs: a"]);
    let by_path = text.replace("aa(1)", "xs.map(T::a)");
    assert_eq!(without_example(&[source("x.rs", &by_path)]), [""; 0]);
}

#[test]
fn a_name_of_two_files_needs_an_example_in_both_and_any_other_in_one() {
    let one = source("one.rs", "/// ```\n/// x.a(); b();\n/// ```\npub fn a() {}\n");
    let two = source("two.rs", "pub fn a() {}\npub fn b() {}\n");
    assert_eq!(without_example(&[one, two]), ["two.rs: a"]);
}
