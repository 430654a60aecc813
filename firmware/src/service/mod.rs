//! Service by command: buckets, calibration and jogging one spool, asked for on CAN by an engineer's tool.
//!
//! - [`request`] — what the tool asks for;
//! - [`answer`] — how far it is, and why it ended; [`found`] — what a calibration found, and what that makes of a record;
//! - [`stage`] — the stage: what may begin when, and what ends it;
//! - [`procedure`] — a calibration or a jog under way: positions in, a current out;
//! - [`errand`] — what is done beside the tick, at a lower priority: another bucket, writing the store;
//! - [`keep`] — found values into the store, only with the board disabled.
//!
//! While a task drives, motion and fence are out of it: the current goes to one solenoid of one spool, behind the supervisor's gate,
//! the interlock, the current loop and its watch. Outside a task the stage costs the tick one comparison.

pub mod answer;
pub mod errand;
pub mod found;
pub mod keep;
pub mod limits;
pub mod procedure;
pub mod request;
pub mod stage;

pub use answer::{Answer, Phase, Reason};
pub use errand::{Done, Errand};
pub use found::Found;
pub use limits::JogParameters;
pub use request::{ServiceRequest, Task};
pub use stage::Service;
