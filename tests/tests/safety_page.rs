//! `docs/safety.md` is what the requirements and the tests' names say, and no requirement is without a test that exists.

use std::collections::BTreeSet;

use cross_tests::rig::workspace;
use hil_sim::faults::KINDS;
use hil_sim::safety_page::{REQUIREMENTS, Requirement, Test, all, files, of_source, page};

#[test]
fn every_requirement_has_tests_that_exist_and_the_page_is_up_to_date() {
    for (name, text) in files(&workspace()).unwrap_or_else(|error| panic!("{error}")) {
        let found = std::fs::read_to_string(workspace().join(name)).unwrap_or_default();
        assert!(found == text, "{name} is out of date: run cargo hil safety");
    }
}

#[test]
fn requirements_have_numbers_of_their_own_and_the_page_speaks_of_no_other() {
    let page = page(REQUIREMENTS, &all(&workspace()).unwrap()).unwrap();
    let ids: BTreeSet<&str> = REQUIREMENTS.iter().map(|requirement| requirement.id).collect();
    assert_eq!(ids.len(), REQUIREMENTS.len());
    let spoken_of: BTreeSet<&str> = page.match_indices("SR-").map(|(at, _)| &page[at..at + 5]).collect();
    assert_eq!(spoken_of, ids);
}

#[test]
fn what_the_campaign_does_not_promise_to_see_stands_on_the_page_with_its_reason() {
    let page = page(REQUIREMENTS, &all(&workspace()).unwrap()).unwrap();
    let unseen: Vec<_> = KINDS.iter().filter(|kind| kind.bound_ms.is_none()).collect();
    assert!(!unseen.is_empty());
    for kind in unseen {
        let reason = kind.reason.unwrap_or_else(|| panic!("{} has neither bound nor reason", kind.name));
        assert!(page.contains(&format!("| `{}` | {reason} |", kind.name)), "{}", kind.name);
    }
}

fn test(file: &str, name: &str, emulated: bool) -> Test {
    Test { file: file.to_owned(), name: name.to_owned(), emulated }
}

#[test]
fn a_test_is_a_function_under_its_attribute_and_nothing_else() {
    let text = "
#[test]
fn one() {}
fn helper() {}
// #[test]
fn commented() {}
proptest! {
    #[test]
    // Why.
    fn two(x in 0..1) {}
}
#[test]
#[ignore = \"needs the emulator: run cargo xtask test\"]
fn three() {}
#[ignore]
#[test]
fn four() {}
#[test]
const NOT_A_FUNCTION: u8 = 0;
fn five() {}
";
    let expected = [
        test("a.rs", "one", false),
        test("a.rs", "two", false),
        test("a.rs", "three", true),
        test("a.rs", "four", true),
    ];
    assert_eq!(of_source("a.rs", text), expected);
}

#[test]
fn a_requirement_without_a_test_or_with_a_missing_or_ambiguous_one_is_named() {
    let tests = [
        test("tests/tests/a.rs", "known", false),
        test("tests/tests/a.rs", "twice", false),
        test("tests/tests/b.rs", "twice", false),
    ];
    let requirement = |tests| Requirement { id: "SR-99", text: "It holds.", tests };
    let of = |names| page(&[requirement(names)], &tests);
    assert_eq!(of(&[]), Err("SR-99 has no test".to_owned()));
    assert_eq!(of(&["known", "gone"]), Err("SR-99: there is no test `gone`".to_owned()));
    let twice = "SR-99: `twice` stands in tests/tests/a.rs and tests/tests/b.rs: name the file";
    assert_eq!(of(&["twice"]), Err(twice.to_owned()));
    assert!(of(&["b::twice"]).unwrap().contains("| SR-99 | It holds. | tests/tests/b.rs:<br>`twice` |"));
}
