//! Machine files: what is shipped loads, and whatever is wrong with one is named by its field.

use std::fs;
use std::path::PathBuf;

use hil_sim::machine_file::MachineFile;
use kinematics_core::geometry::BoomCylinder;
use kinematics_core::{Machine, PinGeometry, Rotor, Vec2};

const MACHINES: [&str; 4] = ["exact-mini", "frankel", "zx120", "zx200"];

fn text(machine: &str) -> String {
    let file = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(format!("../machines/{machine}.toml"));
    fs::read_to_string(file).unwrap()
}

fn error(text: &str) -> String {
    MachineFile::from_toml(text, "some/machine.toml").expect_err("the file is wrong").to_string()
}

/// One numeric line of a file.
struct Scalar {
    line: usize,
    table: String,
    key: String,
    value: f64,
}

impl Scalar {
    /// Coordinates, offsets, heights and angles may have any sign; everything else is a length.
    fn is_length(&self) -> bool {
        let signed = [
            "base_",
            "rod_",
            "rocker_pivot_",
            "coupler_pin_",
            "boom_pin_",
            "boom_centre_",
            "arm_centre_",
            "bucket_centre_",
            "a1_m",
            "l_ah_m",
            "l_he_m",
        ];
        !signed.iter().any(|prefix| self.key.starts_with(prefix)) && !self.key.ends_with("_deg")
    }
}

fn scalars(text: &str) -> Vec<Scalar> {
    let mut table = String::new();
    let mut scalars = Vec::new();
    for (line, content) in text.lines().enumerate() {
        if let Some(name) = content.strip_prefix('[') {
            table = name.trim_end_matches(']').to_owned();
        } else if let Some((key, value)) = content.split_once(" = ")
            && let Ok(value) = value.parse()
        {
            scalars.push(Scalar { line, table: table.clone(), key: key.to_owned(), value });
        }
    }
    scalars
}

fn with_line(text: &str, line: usize, replacement: Option<&str>) -> String {
    let lines = text.lines().enumerate();
    lines.filter_map(|(i, old)| if i == line { replacement } else { Some(old) }).collect::<Vec<_>>().join("\n")
}

/// The file with the value of one key of one table replaced.
fn with_value(text: &str, table: &str, key: &str, value: &str) -> String {
    let all = scalars(text);
    let scalar = all.iter().find(|s| s.table == table && s.key == key).expect("the key stands in the file");
    with_line(text, scalar.line, Some(&format!("{key} = {value}")))
}

/// Spoils every numeric line of a file in every way; how many lines that were.
fn spoil_every_number(text: &str) -> usize {
    // What only the hydraulic plant needs may be left out; tests/tests/plant_scenario.rs spoils it.
    let optional = ["upper_inertia_kgm2", "bucket_width_m", "bucket_capacity_m3"];
    let mut all = scalars(text);
    all.retain(|scalar| !scalar.table.contains("hydraulics") && !optional.contains(&scalar.key.as_str()));
    for scalar in &all {
        let Scalar { line, table, key, value } = scalar;
        let field = format!("`{table}.{key}`");
        let set = |value: &str| error(&with_line(text, *line, Some(&format!("{key} = {value}"))));

        let deleted = error(&with_line(text, *line, None));
        assert!(deleted.contains(&format!("missing field `{key}`")), "{deleted}");
        assert!(deleted.contains(&format!("`[{table}]`")), "{deleted}");

        let misspelt = error(&with_line(text, *line, Some(&format!("misspelt = {value}"))));
        assert!(misspelt.contains("unknown field `misspelt`"), "{misspelt}");
        assert!(misspelt.contains(&format!("`{key}`")), "{misspelt}");

        for wrong in ["nan", "inf", "-inf", "\"1.0\"", "true", "[1.0]"] {
            let message = set(wrong);
            assert!(message.contains(&field), "{wrong}: {message}");
            assert!(message.contains("expected a finite"), "{wrong}: {message}");
            assert!(message.contains(&format!("some/machine.toml, line {}:", line + 1)), "{wrong}: {message}");
        }
        if scalar.is_length() {
            for wrong in [format!("{}", -value), "0".into(), "0.0".into(), "-1".into()] {
                let message = set(&wrong);
                assert!(message.contains(&field), "{wrong}: {message}");
                assert!(message.contains("above 0"), "{wrong}: {message}");
            }
        }
    }
    all.len()
}

#[test]
fn every_shipped_machine_loads_by_name() {
    for name in MACHINES {
        let machine = MachineFile::load(name).unwrap();
        assert_eq!(machine.name, name);
        assert!(!machine.description.is_empty());
        assert!(Machine::<f32>::new(&machine.geometry).is_ok());
    }
}

#[test]
fn exact_mini_is_the_example_of_the_core() {
    let machine = MachineFile::load("exact-mini").unwrap();
    assert_eq!(machine.geometry, PinGeometry::EXACT_MINI);
    assert!(text("exact-mini").lines().any(|line| line == "base_x_m = 0.135"));
}

#[test]
fn frankel_is_in_inches_with_the_boom_cylinder_above_and_a_swing_cylinder() {
    let machine = MachineFile::load("frankel").unwrap();
    let g = machine.geometry;
    assert_eq!(machine.boom_pin_height_m, 13.0 * 0.0254);
    assert_eq!(g.boom_pin_x_m, 8.5 * 0.0254);
    assert_eq!(g.boom_cylinder, BoomCylinder::Above);
    assert!((g.boom.base.x + 0.0254).abs() < 1e-15 && (g.boom.base.z - 10.5 * 0.0254).abs() < 1e-15);
    assert_eq!(g.swing.unwrap().stroke.max_m, 16.6208 * 0.0254);
}

#[test]
fn every_numeric_line_of_every_machine_is_required_and_checked() {
    let lines: Vec<usize> = MACHINES.iter().map(|machine| spoil_every_number(&text(machine))).collect();
    assert_eq!(lines, [39, 43, 27, 39]);
}

#[test]
fn every_number_of_a_koivo_file_is_required_and_checked() {
    assert_eq!(spoil_every_number(&koivo_exact_mini()), 27);
}

#[test]
fn a_missing_or_unknown_table_is_named() {
    for machine in MACHINES {
        for table in ["links", "boom", "arm", "bucket"] {
            let message = error(&text(machine).replace(&format!("[{table}]"), "[excavator]"));
            assert!(message.contains("unknown field `excavator`"), "{message}");
            assert!(message.contains(&format!("`{table}`")), "{message}");
        }
        let rest = text(machine);
        let rest = rest.split("[dynamics]").next().unwrap();
        let message = error(&format!("{rest}\n[dynamics]\nmass_kg = 1.0\n"));
        assert!(message.contains("dynamics") && message.contains("unknown field `mass_kg`"), "{message}");
        let message = error(&format!("{rest}\n[dynamics]\nboom_mass_kg = 1.0\n"));
        assert!(message.contains("`[dynamics]`") && message.contains("missing field"), "{message}");
        let message = error(&format!("{rest}\n[dynamic]\n"));
        assert!(message.contains("unknown field `dynamic`"), "{message}");
    }
    let message = error(text("zx200").split("[bucket]").next().unwrap());
    assert!(message.contains("missing field `bucket`"), "{message}");
}

#[test]
fn the_tags_say_what_they_allow() {
    let mini = text("exact-mini");
    let frankel = text("frankel");
    let cases = [
        (mini.replace("kind = \"pins\"\n", ""), "missing field `kind`", "`\"pins\"` or `\"distances\"`"),
        (mini.replace("\"pins\"", "\"pin\""), "`kind`", "expected `pins` or `distances`"),
        (mini.replace("\"pins\"", "1"), "`kind`", "`\"pins\"` or `\"distances\"`"),
        (mini.replace("\"below\"", "1"), "`boom_cylinder`", "`\"below\"` or `\"above\"`"),
        (mini.replace("\"below\"", "\"under\""), "`boom_cylinder`", "expected `below` or `above`"),
        (mini.replace("boom_cylinder = \"below\"\n", ""), "missing field `boom_cylinder`", "required"),
        (mini.replace("kind =", "labels = \"koivo\"\nkind ="), "unknown field `labels`", "`boom_cylinder`"),
        (frankel.replace("labels = \"frankel\"\n", ""), "missing field `labels`", "`\"koivo\"`"),
        (frankel.replace("labels = \"frankel\"", "labels = \"x\""), "`labels`", "expected `frankel` or `koivo`"),
        (frankel.replace("labels = \"frankel\"", "labels = \"koivo\""), "unknown field", "expected `min_m` or `max_m`"),
    ];
    for (text, field, allowed) in cases {
        let message = error(&text);
        assert!(message.contains(field) && message.contains(allowed), "{message}");
    }
}

#[test]
fn text_that_is_no_toml_is_shown_with_its_line() {
    let mini = text("exact-mini");
    let line = mini.lines().position(|line| line == "base_x_m = 0.135").unwrap() + 1;
    let message = error(&mini.replace("base_x_m = 0.135", "base_x_m 0.135"));
    assert!(message.contains(&format!("line {line}:")) && message.contains("base_x_m 0.135"), "{message}");
    let message = error(&mini.replace("base_x_m = 0.135", "base_x_m = 0.135\nbase_x_m = 0.5"));
    assert!(message.contains("duplicate key") && message.contains("base_x_m = 0.5"), "{message}");
}

#[test]
fn windows_line_ends_and_a_byte_order_mark_do_no_harm() {
    let text = format!("\u{feff}{}", text("exact-mini").replace('\n', "\r\n"));
    assert_eq!(MachineFile::from_toml(&text, "x").unwrap().geometry, PinGeometry::EXACT_MINI);
}

#[test]
fn strokes_and_linkages_that_cannot_be_are_named_as_in_the_file() {
    let cases = [
        ("exact-mini", "boom", "max_m", "0.905", "`boom.min_m`", "0.905 m, must be below its maximum, 0.905 m"),
        ("exact-mini", "arm", "min_m", "2.0", "`arm.min_m`", "must be below its maximum"),
        ("exact-mini", "boom", "max_m", "1.9", "`boom.max_m`", "does not close at a cylinder length of 1.9 m"),
        ("exact-mini", "bucket", "coupler_m", "0.01", "`bucket.", "does not close"),
        ("zx200", "bucket", "min_m", "1.56", "`bucket.min_m`", "does not close at a cylinder length of 1.56 m"),
        ("zx120", "bucket", "min_m", "1.30", "`bucket.min_m`", "does not close at a cylinder length of 1.3 m"),
        ("exact-mini", "bucket", "coupler_pin_x_m", "0.4", "`bucket.max_m`", "folds (dead point) at"),
        ("zx200", "bucket", "coupler_pin_z_m", "1.285", "`bucket.min_m`", "folds (dead point) at"),
        ("zx200", "arm", "max_m", "3.382", "`arm.max_m`", "in line"),
        ("frankel", "boom", "max_in", "29", "`boom.min_in`", "29 in, must be below its maximum, 29 in"),
        ("frankel", "boom", "max_in", "47", "`boom.max_in`", "does not close at a cylinder length of 47 in"),
        ("frankel", "swing", "min_in", "6", "`swing.min_in`", "does not close at a cylinder length of 6 in"),
        ("frankel", "distances", "r2b_in", "90", "`distances.r2b_in`", "triangle"),
        ("frankel", "distances", "r1c_in", "3", "`distances.r1c_in`", "triangle"),
        ("frankel", "distances", "r3f_in", "50", "`distances.r3f_in`", "below `distances.r3d_in`"),
    ];
    for (machine, table, key, value, field, fault) in cases {
        let message = error(&with_value(&text(machine), table, key, value));
        assert!(message.starts_with("some/machine.toml: "), "{message}");
        assert!(message.contains(field) && message.contains(fault), "{machine} {table}.{key} = {value}: {message}");
    }
}

#[test]
fn pins_on_their_joint_are_named() {
    let both_zero = |text: &str, table, x, z| with_value(&with_value(text, table, x, "0"), table, z, "0");
    let message = error(&both_zero(&text("exact-mini"), "boom", "base_x_m", "base_z_m"));
    assert!(message.contains("`boom.base_x_m`") && message.contains("coincides"), "{message}");
    let message = error(&both_zero(&koivo_exact_mini(), "distances", "l_ah_m", "l_he_m"));
    assert!(message.contains("distances.l_ah_m") && message.contains("coincides"), "{message}");
}

#[test]
fn a_backhoe_of_pins_may_have_a_swing_cylinder_but_only_a_complete_one() {
    let swing = "\n[swing]\nbase_x_m = -0.1524\nbase_y_m = -0.254\nrod_x_m = 0.1397\nrod_y_m = 0.0\n\
                 min_m = 0.1905\nmax_m = 0.42216832\n";
    let complete = format!("{}{swing}", text("exact-mini"));
    assert_eq!(MachineFile::from_toml(&complete, "x").unwrap().geometry.swing.unwrap().stroke.min_m, 0.1905);
    assert_eq!(spoil_every_number(&complete), 39 + 6);
}

/// exact-mini under Koivo's labels, computed from its pins as his figures define them.
fn koivo_exact_mini() -> String {
    let g = PinGeometry::EXACT_MINI;
    let degrees = |v: Vec2<f64>| v.z.atan2(v.x).to_degrees();
    let arm_base = g.arm.base - Vec2::new(g.boom_m, 0.0);
    let pivot = g.bucket.rocker_pivot - Vec2::new(g.arm_m, 0.0);
    let cylinder = g.bucket.base - g.bucket.rocker_pivot;
    let mut text = String::from(
        "name = \"mine\"\ndescription = \"A user's machine\"\nkind = \"distances\"\nlabels = \"koivo\"\n\
         \n[links]\nboom_pin_height_m = 0.75\n\n[distances]\n",
    );
    let distances = [
        ("a1_m", g.boom_pin_x_m),
        ("a2_m", g.boom_m),
        ("a3_m", g.arm_m),
        ("a4_m", g.bucket_m),
        ("l_ab_m", g.boom.rod.norm()),
        ("l_ah_m", -g.boom.base.z),
        ("l_he_m", g.boom.base.x),
        ("beta_deg", degrees(g.boom.rod)),
        ("l_ci_m", arm_base.norm()),
        ("l_fc_m", g.arm.rod.norm()),
        // ∠ACI, from the boom line back to A; ∠FCD, from the arm line.
        ("gamma1_deg", 180.0 - degrees(arm_base)),
        ("gamma2_deg", degrees(g.arm.rod)),
        ("l_jl_m", cylinder.norm()),
        ("l_kl_m", g.bucket.rocker_m),
        // ∠JLD, from D counter-clockwise to J.
        ("nu1_deg", degrees(cylinder) - degrees(Vec2::new(-pivot.x, -pivot.z))),
        ("l_ld_m", pivot.norm()),
        ("l_kg_m", g.bucket.coupler_m),
        ("l_gd_m", g.bucket.coupler_pin.norm()),
        // ∠CDL, from the arm line back to C; ∠GDN, from the bucket line.
        ("nu2_deg", 180.0 - degrees(pivot)),
        ("nu3_deg", degrees(g.bucket.coupler_pin)),
    ];
    for (key, value) in distances {
        text += &format!("{key} = {value:?}\n");
    }
    for (table, stroke) in [("boom", g.boom.stroke), ("arm", g.arm.stroke), ("bucket", g.bucket.stroke)] {
        text += &format!("\n[{table}]\nmin_m = {:?}\nmax_m = {:?}\n", stroke.min_m, stroke.max_m);
    }
    text
}

#[test]
fn koivos_distances_give_the_same_pins() {
    let machine = MachineFile::from_toml(&koivo_exact_mini(), "mine.toml").unwrap();
    assert_eq!((machine.name.as_str(), machine.boom_pin_height_m), ("mine", 0.75));
    let (got, want) = (machine.geometry, PinGeometry::EXACT_MINI);
    let close = |got: Vec2<f64>, want: Vec2<f64>| assert!((got - want).norm() < 1e-12, "{got:?} is not {want:?}");
    close(got.boom.base, want.boom.base);
    close(got.boom.rod, want.boom.rod);
    close(got.arm.base, want.arm.base);
    close(got.arm.rod, want.arm.rod);
    close(got.bucket.base, want.bucket.base);
    close(got.bucket.rocker_pivot, want.bucket.rocker_pivot);
    close(got.bucket.coupler_pin, want.bucket.coupler_pin);
    assert_eq!(got.boom_cylinder, want.boom_cylinder);
    let strokes = |g: PinGeometry| [g.boom.stroke, g.arm.stroke, g.bucket.stroke];
    assert_eq!(strokes(got), strokes(want));
    let lengths = |g: PinGeometry| [g.boom_m, g.arm_m, g.bucket_m, g.bucket.rocker_m, g.bucket.coupler_m];
    assert_eq!(lengths(got), lengths(want));
}

#[test]
fn whole_turns_change_no_angle_of_a_koivo_file() {
    let text = koivo_exact_mini();
    let beta = scalars(&text).into_iter().find(|s| s.key == "beta_deg").unwrap().value;
    let turned = with_value(&text, "distances", "beta_deg", &format!("{:?}", beta + 360.0 * 100.0));
    let rod = MachineFile::from_toml(&turned, "x").unwrap().geometry.boom.rod;
    let angle = Rotor { cos: rod.x, sin: rod.z }.angle();
    assert!((angle.to_degrees() - beta).abs() < 1e-9);
}

#[test]
fn an_unknown_name_lists_the_machines_there_are() {
    for name in ["exact_mini", "", "machines", "EXACT MINI"] {
        let message = MachineFile::load(name).unwrap_err().to_string();
        for machine in MACHINES {
            assert!(message.contains(machine), "{message}");
        }
        assert!(message.contains(&format!("`{name}`")), "{message}");
    }
}

#[test]
fn a_path_is_read_as_it_stands() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("mine.toml");
    fs::write(&file, koivo_exact_mini()).unwrap();
    assert_eq!(MachineFile::load(file.to_str().unwrap()).unwrap().name, "mine");
    for wrong in [folder.path().join("other.toml"), folder.path().to_owned()] {
        let message = MachineFile::load(wrong.to_str().unwrap()).unwrap_err().to_string();
        assert!(message.contains(wrong.to_str().unwrap()), "{message}");
    }
}

#[test]
fn the_documented_example_loads() {
    let docs = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../docs/machine-files.md");
    let docs = fs::read_to_string(docs).unwrap();
    let example = docs.split("```toml\n").nth(1).unwrap().split("```").next().unwrap();
    let geometry = MachineFile::from_toml(example, "docs").unwrap().geometry;
    assert!(geometry.swing.is_some());
    assert_eq!(PinGeometry { swing: None, ..geometry }, PinGeometry::EXACT_MINI);
}

#[test]
fn an_outline_s_fields_replace_the_defaults_one_by_one_and_each_is_checked() {
    let plain = MachineFile::load("zx200").unwrap().outline;
    let with = |fields: &str| format!("{}\n[outline]\n{fields}\n", text("zx200"));
    let stated = MachineFile::from_toml(&with("boom_knee_z_m = 1.5\nbucket_half_width_m = 0.45"), "x").unwrap().outline;
    assert_eq!((stated.boom_knee.z, stated.bucket_half_width_m), (1.5, 0.45));
    assert_eq!((stated.boom_knee.x, stated.arm_radius_m), (plain.boom_knee.x, plain.arm_radius_m));
    for (field, bad) in [("boom_radius_m", "0.0"), ("bucket_half_width_m", "-1.0"), ("bucket_back_x_m", "nan")] {
        let message = error(&with(&format!("{field} = {bad}")));
        assert!(message.contains(field) && message.contains("within"), "{message}");
    }
    let message = error(&with("arm_radius_m = 2000.0"));
    assert!(message.contains("`outline.arm_radius_m` must be within −1000…1000 m"), "{message}");
    assert!(error(&with("knee = 1.0")).contains("knee"));
}
