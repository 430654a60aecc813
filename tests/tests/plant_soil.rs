//! The ground: what a blade takes, and what a bucket brings up.

use cross_tests::plant::*;
use hil_sim::machine_file::MachineFile;
use hil_sim::plant::hydraulic::{HydraulicModel, Soil};

#[test]
fn a_metre_of_blade_at_forty_centimetres_takes_what_is_published_for_sand_loam_and_clay() {
    for (name, soil, published_n) in
        [("sand", Soil::SAND, 4.8e3), ("loam", Soil::LOAM, 11.9e3), ("clay", Soil::CLAY, 29.8e3)]
    {
        let rake = 60.0 / 180.0 * std::f64::consts::PI;
        let force = soil.force(0.4, soil.factors(rake));
        println!("{name}: {:.1} kN at a rake of 60°, published {:.1} kN", force * 1e-3, published_n * 1e-3);
        // The published soils are not given: the size is what is compared.
        assert!((force / published_n - 1.0).abs() < 0.3, "{name}: {force} N");
    }
}

#[test]
fn drawing_the_bucket_through_loam_is_resisted_cuts_the_ground_and_fills_the_bucket() {
    let file = MachineFile::load("zx200").unwrap();
    let bare = model("zx200");
    let dig = bare.clone().digging(&file, Soil::LOAM).unwrap();
    let start = on_ground("zx200", &bare, [0.25, 0.55]);
    let drawn = |model: &HydraulicModel| {
        let mut plant = at(model, start);
        run(&mut plant, model, [0.0, -0.5, 0.0, 0.0], 700);
        let mut resisted: f64 = 0.0;
        for _ in 0..2500 {
            run(&mut plant, model, lever(ARM, 0.6), 1);
            let [reach, height] = plant.soil_force_n();
            let force = libm::hypot(reach, height);
            resisted = if force > resisted { force } else { resisted };
        }
        (plant, resisted)
    };
    let (free, nothing) = drawn(&bare);
    let (digging, force) = drawn(&dig);
    let lowest = digging.ground().unwrap().profile().map(|[_, z]| z).fold(f64::MAX, f64::min) + file.boom_pin_height_m;
    println!(
        "{:.1} kN at most, {:.0} kg in the bucket, ground cut to {:.2} m; arm {:.0} mm behind the free one",
        force * 1e-3,
        digging.load_kg(),
        lowest,
        (free.positions()[ARM] - digging.positions()[ARM]) * 1e3
    );
    assert_eq!(nothing, 0.0);
    assert!((5e3..200e3).contains(&force) && digging.load_kg() > 100.0 && lowest < -0.1);
    assert!(digging.positions()[ARM] < free.positions()[ARM]);
}

#[test]
fn a_bucket_tipped_over_loses_its_soil() {
    let file = MachineFile::load("zx200").unwrap();
    let bare = model("zx200");
    let dig = bare.clone().digging(&file, Soil::SAND).unwrap();
    let mut plant = at(&dig, on_ground("zx200", &bare, [0.25, 0.55]));
    run(&mut plant, &dig, [0.0, -0.5, 0.0, 0.0], 700);
    run(&mut plant, &dig, lever(ARM, 0.6), 2500);
    run(&mut plant, &dig, [0.0, 0.8, 0.0, 0.8], 3000);
    let full = plant.load_kg();
    run(&mut plant, &dig, lever(BUCKET, -1.0), 4000);
    println!("{full:.0} kg curled, {:.1} kg tipped", plant.load_kg());
    assert!(full > 100.0 && plant.load_kg() < 0.01 * full);
}
