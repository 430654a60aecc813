//! What the controller answers: how far the task is, and why it ended.

use super::found::Found;
use super::request::Task;
use crate::can::table::service::ANSWER;

/// How far a task is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Phase {
    /// Nothing was asked for yet.
    Idle,
    /// Accepted; waits for neutral levers and the enable switch.
    Waiting,
    /// Under way.
    UnderWay,
    /// Done.
    Done,
    /// Not begun.
    Refused,
    /// Ended before it was done; outputs off until the enable switch is off.
    Aborted,
}

impl Phase {
    /// Every phase, in the order of the codes.
    pub const ALL: [Self; 6] = [Self::Idle, Self::Waiting, Self::UnderWay, Self::Done, Self::Refused, Self::Aborted];

    /// Its name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Idle => "idle",
            Self::Waiting => "waiting_for_enable",
            Self::UnderWay => "under_way",
            Self::Done => "done",
            Self::Refused => "refused",
            Self::Aborted => "aborted",
        }
    }
}

/// Why a task was refused or aborted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Reason {
    /// For none.
    None,
    /// The enable switch is on, the cut-off closed, or the machine runs.
    Enabled,
    /// A fault is there; the controller's state says which.
    Fault,
    /// The record has no such bucket, or there is no store.
    NoSuchBucket,
    /// With this bucket the dig, the move, the fence or the target is not possible; the one before stays mounted.
    BucketUnusable,
    /// This spool has no cylinder with end stops.
    NoEndStops,
    /// The parameters give no room to search in.
    NoRoomToSearch,
    /// Nothing was found that could be kept.
    NothingFound,
    /// The store did not take the record, or there is none.
    NotStored,
    /// The command was withdrawn.
    Withdrawn,
    /// The command grew stale.
    Stale,
    /// Another task, spool or number was asked for meanwhile.
    Changed,
    /// The enable switch was switched off.
    EnableReleased,
    /// The levers left neutral.
    NotNeutral,
    /// A jog lasted too long.
    TooLong,
    /// No motion up to the largest current, extending.
    NoMotionExtending,
    /// The same, retracting.
    NoMotionRetracting,
    /// It moved against the current: solenoids or sensor are swapped.
    WrongWay,
    /// The actuator came to the end of its room; begin nearer the middle.
    OutOfRoom,
    /// Two ways of finding the dead band disagree.
    Inconsistent,
    /// It never stood still at an end.
    NeverStill,
    /// Too few codes between the ends.
    StrokeTooShort,
    /// The sensor counts the wrong way.
    SensorReversed,
    /// Too few touches.
    TooFewTouches,
    /// The touches' bucket angles are too alike.
    TouchesTooAlike,
    /// Values were kept that the controller works with from its next start: start it anew first.
    RestartFirst,
}

impl Reason {
    /// Every reason, in the order of the codes.
    pub const ALL: [Self; 26] = [
        Self::None,
        Self::Enabled,
        Self::Fault,
        Self::NoSuchBucket,
        Self::BucketUnusable,
        Self::NoEndStops,
        Self::NoRoomToSearch,
        Self::NothingFound,
        Self::NotStored,
        Self::Withdrawn,
        Self::Stale,
        Self::Changed,
        Self::EnableReleased,
        Self::NotNeutral,
        Self::TooLong,
        Self::NoMotionExtending,
        Self::NoMotionRetracting,
        Self::WrongWay,
        Self::OutOfRoom,
        Self::Inconsistent,
        Self::NeverStill,
        Self::StrokeTooShort,
        Self::SensorReversed,
        Self::TooFewTouches,
        Self::TouchesTooAlike,
        Self::RestartFirst,
    ];

    /// Its name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Enabled => "enabled",
            Self::Fault => "fault",
            Self::NoSuchBucket => "no_such_bucket",
            Self::BucketUnusable => "bucket_unusable",
            Self::NoEndStops => "no_end_stops",
            Self::NoRoomToSearch => "no_room_to_search",
            Self::NothingFound => "nothing_found",
            Self::NotStored => "not_stored",
            Self::Withdrawn => "withdrawn",
            Self::Stale => "stale",
            Self::Changed => "changed",
            Self::EnableReleased => "enable_released",
            Self::NotNeutral => "not_neutral",
            Self::TooLong => "too_long",
            Self::NoMotionExtending => "no_motion_extending",
            Self::NoMotionRetracting => "no_motion_retracting",
            Self::WrongWay => "wrong_way",
            Self::OutOfRoom => "out_of_room",
            Self::Inconsistent => "inconsistent",
            Self::NeverStill => "never_still",
            Self::StrokeTooShort => "stroke_too_short",
            Self::SensorReversed => "sensor_reversed",
            Self::TooFewTouches => "too_few_touches",
            Self::TouchesTooAlike => "touches_too_alike",
            Self::RestartFirst => "restart_first",
        }
    }
}

/// Of the last task.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Answer {
    /// The task.
    pub task: Task,
    /// Its spool, 0…3.
    pub spool: u8,
    /// How far it is.
    pub phase: Phase,
    /// Why it was refused or aborted.
    pub reason: Reason,
    /// 0…1; of touches, a hundredth each.
    pub progress: f32,
    /// What the last calibration found: a proposal, until it is kept.
    pub found: Option<Found>,
    /// The mounted bucket; `None` without a store.
    pub bucket: Option<u8>,
}

impl Answer {
    /// Before the first task.
    pub const NONE: Self = Self {
        task: Task::None,
        spool: 0,
        phase: Phase::Idle,
        reason: Reason::None,
        progress: 0.0,
        found: None,
        bucket: None,
    };

    /// Codes of the message's signals; counter and CRC are put in when the frame is made.
    pub(crate) fn codes(&self) -> [u32; 9] {
        let [_, _, _, _, bucket, progress, ..] = &ANSWER.signals;
        [
            self.task.code(),
            self.phase as u32,
            self.reason as u32,
            self.spool.into(),
            self.bucket.map_or(bucket.not_available(), u32::from),
            progress.code(100.0 * self.progress),
            self.found.map_or(0, |found| found.kind()),
            0,
            0,
        ]
    }
}
