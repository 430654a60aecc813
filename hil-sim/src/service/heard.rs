//! The controller's answers, read off the bus.

use firmware::can::CanFrame;
use firmware::can::id::Identifier;
use firmware::can::message::Message;
use firmware::can::protect;
use firmware::can::signal::{Kind, Signal};
use firmware::can::table::service::{ANSWER, FOUND_ENDS, FOUND_VALVE};

/// The last answer of each kind.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Heard {
    /// Name of the task.
    pub task: &'static str,
    /// Name of its phase.
    pub phase: &'static str,
    /// Name of the reason.
    pub reason: &'static str,
    /// 0…100 %.
    pub progress: f32,
    /// The mounted bucket, 15 for none.
    pub bucket: u32,
    /// Of a valve search.
    pub valves: Option<FoundValves>,
    /// Of an end-stop search: min and max code.
    pub ends: Option<[u32; 2]>,
    /// Of a measure-up.
    pub tip: Option<FoundTip>,
}

/// Extend, retract.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FoundValves {
    /// Shares of full-scale current.
    pub dead_band: [f32; 2],
    /// m/s or rad/s.
    pub full_speed: [f32; 2],
}

/// The bucket's tip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FoundTip {
    /// m
    pub length_m: f32,
    /// Sine of its direction in the bucket's frame.
    pub offset_sin: f32,
}

impl Heard {
    /// Takes a frame in.
    pub(super) fn hear(&mut self, frame: &CanFrame) {
        let id = Identifier::of(frame.extended_id());
        let Some(payload) = frame.payload() else { return };
        if id.pgn == ANSWER.header.pgn && protect::open(id, payload).is_some() {
            let [task, phase, reason, _, bucket, progress, ..] = &ANSWER.signals;
            let name = |signal: &Signal| named(signal, payload);
            (self.task, self.phase, self.reason) = (name(task), name(phase), name(reason));
            self.bucket = bucket.code_in(payload);
            self.progress = progress.value(progress.code_in(payload)).unwrap_or_default();
        } else if id.pgn == FOUND_VALVE.header.pgn {
            self.valves = values(&FOUND_VALVE, payload).map(|[extend, extend_speed, retract, retract_speed]| {
                FoundValves { dead_band: [0.01 * extend, 0.01 * retract], full_speed: [extend_speed, retract_speed] }
            });
        } else if id.pgn == FOUND_ENDS.header.pgn {
            let [min, max, length, offset] = FOUND_ENDS.signals.each_ref().map(|signal| signal.code_in(payload));
            self.ends = (min != 0xffff).then_some([min, max]);
            let [_, _, of_length, of_offset] = &FOUND_ENDS.signals;
            self.tip = match (of_length.value(length), of_offset.value(offset)) {
                (Ok(length_m), Ok(offset_sin)) => Some(FoundTip { length_m, offset_sin }),
                _ => None,
            };
        }
    }
}

fn values<const N: usize>(message: &Message<N>, payload: u64) -> Option<[f32; N]> {
    let mut values = [0.0; N];
    for (value, read) in values.iter_mut().zip(message.decode(payload)) {
        *value = read.ok()?;
    }
    Some(values)
}

fn named(signal: &Signal, payload: u64) -> &'static str {
    let Kind::States(states) = signal.kind else { return "" };
    let code = signal.code_in(payload);
    states.iter().find(|(state, _)| *state == code).map_or("", |(_, name)| name)
}
