//! The loop's crates keep their promises in their text: no `unsafe` but one, no trigonometry, no host-dependent float function.

use cross_tests::promises::{broken, loop_sources};

fn words(source: &str) -> Vec<String> {
    broken("firmware/src/motion.rs", source).into_iter().map(|b| b.word).collect()
}

#[test]
fn the_loops_crates_keep_their_promises() {
    let sources = loop_sources();
    let read = |file: &str| sources.iter().any(|(name, text)| name == file && !text.is_empty());
    for file in ["kinematics-core/src/sqrt.rs", "kinematics-core/src/triangle.rs", "firmware/src/lib.rs"] {
        assert!(read(file), "{file} was not scanned");
    }
    let found: Vec<_> = sources.iter().flat_map(|(file, text)| broken(file, text)).collect();
    assert!(
        found.is_empty(),
        "not allowed in the loop (for integers write core::cmp::min/max, for floats a comparison or clamp): {found:#?}"
    );
}

#[test]
fn the_square_root_is_where_the_unsafe_stands() {
    let sources = loop_sources();
    let sqrt = sources.iter().find(|(file, _)| file == "kinematics-core/src/sqrt.rs").unwrap();
    assert_eq!(broken("kinematics-core/src/other.rs", &sqrt.1).len(), 1, "the scan must see it");
}

#[test]
fn trigonometry_and_contraction_are_seen() {
    assert_eq!(words("let y = x.sin();"), ["sin"]);
    assert_eq!(words("let y = libm::cosf(x) + f32::tan(x);"), ["cosf", "tan"]);
    assert_eq!(words("let y = a . mul_add (b, c);"), ["mul_add"]);
    assert_eq!(words("let y = x.powf(2.0).hypot(z);"), ["powf", "hypot"]);
    assert_eq!(words("xs.map(f32::acos)"), ["acos"]);
}

#[test]
fn the_angle_of_a_vector_is_allowed_at_its_edge_alone() {
    let source = "libm::atan2f(y, x)";
    assert_eq!(broken("kinematics-core/src/real.rs", source), []);
    assert_eq!(broken("kinematics-core/src/chain.rs", source).len(), 1);
    assert_eq!(broken("kinematics-core/src/real.rs", "libm::atan(y / x)").len(), 1);
}

#[test]
fn float_minimum_and_maximum_are_seen_and_the_integers_own_are_not() {
    assert_eq!(words("let y = x.min(1.0).max(z);"), ["min", "max"]);
    assert_eq!(words("xs.fold(0.0, f32::max)"), ["max"]);
    assert_eq!(words("let n = core::cmp::min(a, b);"), [""; 0]);
    assert_eq!(words("if length > self.max { stroke.min } else { max_m }"), [""; 0]);
}

#[test]
fn names_and_fields_that_only_look_alike_are_not_seen() {
    assert_eq!(
        words("Rotor { cos: v.x, sin: v.z }; let sin = rotor.sin; r.sin < 0.0; r.cos * (a + b); basin(x); min_m(3)"),
        [""; 0]
    );
    assert_eq!(words("fn atan2(y: Self, x: Self) -> Self;"), [""; 0]);
    assert_eq!(words("#![forbid(unsafe_code)]"), [""; 0]);
}

#[test]
fn comments_strings_and_tests_do_not_count_but_what_follows_them_does() {
    assert_eq!(
        words("// x.sin()\n/// unsafe\n/* cos( /* tan( */ unsafe */ let a = \"x.sin() \\\" unsafe\"; y.tan()"),
        ["tan"]
    );
    assert_eq!(words("#[cfg(test)]\nmod tests {\n fn f() { x.sin() }\n}\nfn g() { unsafe { h() } }"), ["unsafe"]);
    assert_eq!(words("let quote = '\"'; unsafe { f() }; let other = '\\''; x.cos()"), ["unsafe", "cos"]);
    let found = broken("firmware/src/a.rs", "/* one\n two */\n\nunsafe {}");
    assert_eq!(found[0].line, 4);
}
