//! Files whose tests take under a second.

#[path = "../../../tests/clearance.rs"]
mod clearance;
#[path = "../../../tests/cylinder_path.rs"]
mod cylinder_path;
#[path = "../../../tests/errata_frankel.rs"]
mod errata_frankel;
#[path = "../../../tests/errata_hareesha.rs"]
mod errata_hareesha;
#[path = "../../../tests/errata_koivo.rs"]
mod errata_koivo;
#[path = "../../../tests/errata_koivo_rates.rs"]
mod errata_koivo_rates;
#[path = "../../../tests/errata_park.rs"]
mod errata_park;
#[path = "../../../tests/fence.rs"]
mod fence;
#[path = "../../../tests/fence_bounds.rs"]
mod fence_bounds;
#[path = "../../../tests/forces.rs"]
mod forces;
#[path = "../../../tests/fuzz.rs"]
mod fuzz;
#[path = "../../../tests/golden.rs"]
mod golden;
#[path = "../../../tests/obstacle_routes.rs"]
mod obstacle_routes;
#[path = "../../../tests/obstacle_step.rs"]
mod obstacle_step;
#[path = "../../../tests/oracle.rs"]
mod oracle;
#[path = "../../../tests/park.rs"]
mod park;
#[path = "../../../tests/properties.rs"]
mod properties;
#[path = "../../../tests/published_dig.rs"]
mod published_dig;
#[path = "../../../tests/rates_fallback.rs"]
mod rates_fallback;
#[path = "../../../tests/rates_properties.rs"]
mod rates_properties;
#[path = "../../../tests/redundancy.rs"]
mod redundancy;
#[path = "../../../tests/rotor.rs"]
mod rotor;
#[path = "../../../tests/singular_values.rs"]
mod singular_values;
#[path = "../../../tests/tip_path.rs"]
mod tip_path;
#[path = "../../../tests/validation.rs"]
mod validation;
