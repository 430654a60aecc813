//! Draws the figure of labels: `cargo run -p hil-sim --example labels > docs/kinematics.svg`.

use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    print!("{}", hil_sim::labels::svg()?);
    Ok(())
}
