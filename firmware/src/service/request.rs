//! What the service tool asks for.

use crate::can::signal::Unusable;
use crate::can::table::received::SERVICE;

/// A service task.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Task {
    /// Nothing.
    None,
    /// Mount the bucket of this number of the record.
    MountBucket,
    /// Dead band and full speed of both directions of a spool.
    ValveSearch,
    /// The sensor's codes at both ends of a cylinder's stroke.
    EndStops,
    /// The tip touches the point now; number 0 forgets the touches before, each other number is a touch.
    Touch,
    /// The bucket from the touches.
    MeasureUp,
    /// Drive a spool with a limited current.
    Jog,
    /// Write what was found into the store.
    Keep,
}

impl Task {
    const ALL: [Self; 8] = [
        Self::None,
        Self::MountBucket,
        Self::ValveSearch,
        Self::EndStops,
        Self::Touch,
        Self::MeasureUp,
        Self::Jog,
        Self::Keep,
    ];

    /// As on the bus.
    pub const fn code(self) -> u32 {
        self as u32
    }
}

/// A service command.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ServiceRequest {
    /// What.
    pub task: Task,
    /// On which spool, 0…3.
    pub spool: u8,
    /// Which bucket or touch.
    pub number: u8,
    /// Current of a jog, A, extending positive; of other tasks 0.
    pub current_a: f32,
}

impl ServiceRequest {
    /// The same task: only a jog's current may differ.
    pub(crate) fn is(&self, other: &Self) -> bool {
        self.task == other.task && self.spool == other.spool && self.number == other.number
    }

    pub(crate) fn of(payload: u64) -> Result<Self, Unusable> {
        let [task, spool, _, current, _, _] = SERVICE.decode(payload);
        let [task_code, spool_code, number, _, _, _] = SERVICE.unpack(payload);
        task?;
        let task = Task::ALL.into_iter().find(|task| task.code() == task_code).ok_or(Unusable::OutOfRange)?;
        let on_spool = matches!(task, Task::ValveSearch | Task::EndStops | Task::Jog);
        if on_spool {
            spool?;
        }
        Ok(Self {
            task,
            spool: if on_spool { spool_code as u8 } else { 0 },
            number: number as u8,
            current_a: if task == Task::Jog { current? } else { 0.0 },
        })
    }
}
