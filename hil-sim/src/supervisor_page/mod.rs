//! `docs/supervisor.svg` and `docs/faults.md`, made from the firmware's table of transitions and its faults.

mod drawing;
mod faults;

pub use drawing::drawing;
pub use faults::{NOT_SEEN, page};

/// Where the files stand, from the repository's root, and what they must hold.
pub fn files() -> [(&'static str, String); 2] {
    [("docs/supervisor.svg", drawing()), ("docs/faults.md", page())]
}
