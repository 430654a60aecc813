//! The controller's telemetry by a fixed timetable: period and phase of each message stand in [`super::table::sent`].

use super::frame::CanFrame;
use super::message::{Entry, Message, Rate, Sender};
use super::receive::Validity;
use super::table::MESSAGES;
use super::table::{sent, service};
use crate::io::Outputs;
use crate::service::Answer;

/// The frames of one tick: as many as a bxCAN has mailboxes.
pub type Due = [Option<CanFrame>; 3];

/// Adds a frame; the timetable leaves room for it.
pub(crate) fn add(due: &mut Due, frame: CanFrame) {
    if let Some(slot) = due.iter_mut().find(|slot| slot.is_none()) {
        *slot = Some(frame);
    }
}

/// After so long the timetable begins again, ms.
const TIMETABLE_MS: u32 = 1000;

/// Frames of the timetable in its fullest millisecond: one mailbox stays for the network's own messages.
const _: () = assert!(fullest_ms() <= 2);

const fn fullest_ms() -> u32 {
    let mut fullest = 0;
    let mut now = 0;
    while now < TIMETABLE_MS {
        let (mut count, mut i) = (0, 0);
        while i < MESSAGES.len() {
            let Entry { header, .. } = MESSAGES[i];
            if let (Sender::Controller, Rate::Every { ms, phase_ms }) = (header.sender, header.rate) {
                assert!(TIMETABLE_MS.is_multiple_of(ms as u32) && phase_ms < ms, "a period must divide the timetable");
                count += header.is_due(now) as u32;
            }
            i += 1;
        }
        fullest = if count > fullest { count } else { fullest };
        now += 1;
    }
    fullest
}

/// Where in the timetable, and the state message's alive counter.
#[derive(Clone, Copy, Debug)]
pub struct Telemetry {
    now_ms: u32,
    counter: u8,
    /// What the service stage has to say.
    answer: Answer,
    answer_counter: u8,
}

impl Telemetry {
    pub(crate) const fn new() -> Self {
        Self { now_ms: 0, counter: 0, answer: Answer::NONE, answer_counter: 0 }
    }

    /// What the service stage has to say from now on.
    pub(crate) fn set_answer(&mut self, answer: Answer) {
        self.answer = answer;
    }

    /// Adds the frames of this tick.
    pub(crate) fn due(&mut self, source: u8, outputs: &Outputs, validities: [Validity; 11], due: &mut Due) {
        let now = self.now_ms;
        self.now_ms = if now + 1 < TIMETABLE_MS { now + 1 } else { 0 };
        if sent::STATE.header.is_due(now) {
            add(due, sent::STATE.frame(source, self.counter, state(outputs)));
            self.counter = (self.counter + 1) & 0xf;
        }
        // Only what is due is computed.
        send(&sent::LENGTHS, now, source, due, |m| {
            let l = &outputs.lengths;
            of_pose(m, outputs, [l.boom, l.arm, l.bucket])
        });
        let pose = &outputs.pose;
        send(&sent::TIP, now, source, due, |m| of_pose(m, outputs, [pose.x, pose.y, pose.plane.height]));
        send(&sent::SWING_AND_PITCH, now, source, due, |m| {
            let (swing, pitch) = (pose.swing, pose.plane.pitch);
            of_pose(m, outputs, [swing.cos, swing.sin, pitch.cos, pitch.sin])
        });
        send(&sent::BOOM_AND_ARM, now, source, due, |m| {
            let (boom, arm) = (pose.joints.boom, pose.joints.arm);
            of_pose(m, outputs, [boom.cos, boom.sin, arm.cos, arm.sin])
        });
        let [[s0, s1], [b0, b1], [a0, a1], [k0, k1]] = outputs.currents;
        send(&sent::SWING_AND_BOOM_CURRENTS, now, source, due, |m| m.encode([s0, s1, b0, b1]));
        send(&sent::ARM_AND_BUCKET_CURRENTS, now, source, due, |m| m.encode([a0, a1, k0, k1]));
        send(&sent::RECEPTION, now, source, due, |m| m.pack(validities.map(Validity::code)));
        if service::ANSWER.header.is_due(now) {
            add(due, service::ANSWER.frame(source, self.answer_counter, service::ANSWER.pack(self.answer.codes())));
            self.answer_counter = (self.answer_counter + 1) & 0xf;
        }
        let found = self.answer.found;
        send(&service::FOUND_VALVE, now, source, due, |m| {
            found.and_then(|found| found.valve()).map_or(u64::MAX, |values| m.encode(values))
        });
        send(&service::FOUND_ENDS, now, source, due, |_| found.map_or(u64::MAX, |found| found.ends_or_tip()));
    }
}

fn send<const N: usize>(
    message: &Message<N>,
    now_ms: u32,
    source: u8,
    due: &mut Due,
    payload: impl FnOnce(&Message<N>) -> u64,
) {
    if message.header.is_due(now_ms) {
        add(due, message.frame(source, 0, payload(message)));
    }
}

/// An invalid pose is sent as an error, not as the last valid one.
fn of_pose<const N: usize>(message: &Message<N>, outputs: &Outputs, values: [f32; N]) -> u64 {
    if outputs.pose_valid { message.encode(values) } else { message.faulty() }
}

fn state(outputs: &Outputs) -> u64 {
    let fault = outputs.fault.map_or(0, |fault| fault.code());
    let codes = [
        outputs.state.code().into(),
        outputs.cut_off_closed.into(),
        outputs.pose_valid.into(),
        fault.into(),
        outputs.tick,
        // Counter and CRC are put in when the frame is made.
        0,
        0,
    ];
    sent::STATE.pack(codes)
}
