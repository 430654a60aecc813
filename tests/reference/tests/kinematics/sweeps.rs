//! Files with sweeps over whole strokes, random searches and long moves.

#[path = "../../../tests/accuracy.rs"]
mod accuracy;
#[path = "../../../tests/errors.rs"]
mod errors;
#[path = "../../../tests/isotropy.rs"]
mod isotropy;
#[path = "../../../tests/joint_limits.rs"]
mod joint_limits;
#[path = "../../../tests/least_effort.rs"]
mod least_effort;
#[path = "../../../tests/rates.rs"]
mod rates;
#[path = "../../../tests/rates_floor.rs"]
mod rates_floor;
#[path = "../../../tests/rates_jacobians.rs"]
mod rates_jacobians;
#[path = "../../../tests/rates_search.rs"]
mod rates_search;
#[path = "../../../tests/time_scaling.rs"]
mod time_scaling;
