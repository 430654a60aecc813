//! `docs/errata.md` and the tests of the errata name each other, none left out.

use std::collections::BTreeSet;

const PAGE: &str = include_str!("../../docs/errata.md");
/// The files of tests, every test named after its paper.
const SOURCES: [(&str, &str); 6] = [
    ("koivo_", include_str!("errata_koivo.rs")),
    ("koivo_", include_str!("errata_koivo_rates.rs")),
    ("frankel_", include_str!("errata_frankel.rs")),
    ("frankel_", include_str!("errata_frankel_dig.rs")),
    ("hareesha_", include_str!("errata_hareesha.rs")),
    ("park_", include_str!("errata_park.rs")),
];

/// What stands in backticks and begins like a test of an erratum.
fn named(page: &str) -> BTreeSet<&str> {
    let quoted = page.split('`').skip(1).step_by(2);
    quoted.filter(|word| SOURCES.iter().any(|(paper, _)| word.starts_with(paper))).collect()
}

/// The functions after `#[test]`.
fn tests(source: &str) -> BTreeSet<&str> {
    let after = source.split("#[test]\nfn ").skip(1);
    after.map(|rest| rest.split('(').next().unwrap()).collect()
}

#[test]
fn every_test_the_page_names_exists_and_every_test_is_named() {
    let existing: BTreeSet<&str> = SOURCES.iter().flat_map(|(_, source)| tests(source)).collect();
    assert!(existing.len() > 40, "{existing:?}");
    assert_eq!(named(PAGE), existing);
}

#[test]
fn every_test_bears_the_name_of_its_paper() {
    for (paper, source) in SOURCES {
        let all = tests(source);
        assert_eq!(all.len(), source.matches("#[test]").count(), "{paper}: a test the scan does not see");
        assert!(all.iter().all(|name| name.starts_with(paper)), "{all:?}");
    }
}

#[test]
fn every_row_of_the_tables_ends_with_its_test() {
    let rows =
        PAGE.lines().filter(|line| line.starts_with('|') && !line.starts_with("|---") && !line.contains("| test |"));
    let mut count = 0;
    for row in rows {
        let cells: Vec<&str> = row.trim_matches('|').split(" | ").collect();
        assert_eq!(cells.len(), 5, "{row}");
        assert_eq!(named(cells[4]).len(), 1, "{row}");
        count += 1;
    }
    assert!(count > 35, "{count}");
}

#[test]
fn a_name_that_is_missing_on_either_side_is_seen() {
    assert_eq!(
        named("see `koivo_1_a` and `park_b`, not `frankel` or koivo_c"),
        BTreeSet::from(["koivo_1_a", "park_b"])
    );
    assert_eq!(tests("#[test]\nfn koivo_1_a() {}\nfn koivo_help() {}\n"), BTreeSet::from(["koivo_1_a"]));
}
