//! Between sensing and motion: whether each actuator's sensor can be believed, and whether the actuator does what it was told.
//!
//! Every tick each code is held against the last: a change that no motion explains is a jump. In a *round* of eight ticks one actuator after
//! the other is looked at closely, two ticks each: in the first its speed is measured and the
//! [delay model](DiagnosisParameters) goes on, in the second the one is held against the other, and whether its sensor follows motion that must
//! have happened. Each actuator is judged alone; what is good of one says nothing of another.

mod channel;
mod envelope;
mod parameters;
mod stuck;

use kinematics_core::Cylinder;

use crate::TICK_S;
use crate::constants::Constant;
use crate::fault::Fault;
use crate::io::Speeds;
use crate::sensing::SensorView;
use channel::{Channel, Wrong};
use envelope::{Asked, Model};
use stuck::Free;

pub use parameters::{ActuatorLimits, DiagnosisParameters};

/// Ticks of a round: two for each actuator.
const ROUND_TICKS: u8 = 8;
/// The same, s.
const ROUND_S: f32 = 8.0 * TICK_S;
/// So many rounds outside the envelope, or standing though free, are a fault: 56 ms.
const OUTSIDE_ROUNDS: u8 = 7;
/// So many rounds beyond what does not ring are a fault: 344 ms, half a swing at 1.45 Hz.
const GOING_ON_ROUNDS: u8 = 43;
/// So many rounds without any change of a noisy code are no chance: 96 ms.
const QUIET_ROUNDS: u8 = 12;
/// A jump stays a fault for so many rounds after the last: 104 ms.
const JUMP_ROUNDS: u8 = 13;

const ACTUATORS: [Cylinder; 4] = [Cylinder::Swing, Cylinder::Boom, Cylinder::Arm, Cylinder::Bucket];

/// Of no sensor.
const NO_VIEW: SensorView = SensorView { unit: 1.0, stops: [0, u16::MAX] };

/// Cylinder pressures, Pa, as far as they are valid: boom, arm, bucket, each head then rod.
pub type Pressures = [[Option<f32>; 2]; 3];

/// No pressure is known.
pub const NO_PRESSURES: Pressures = [[None; 2]; 3];

/// The diagnosis stage.
#[derive(Clone, Copy, Debug)]
pub struct Diagnosis {
    channels: [Channel; 4],
    model: Model,
    /// What the valves were last told.
    sent: [f32; 4],
    free: Free,
    /// What the actuator whose turn it is was asked for.
    asked: Asked,
    /// How fast the three actuators whose turn it was last may move: all but the one whose turn is next.
    activities: [f32; 3],
    /// The largest activity of all but the actuator whose turn it is.
    others: f32,
    /// Something is wrong with one of them.
    faulty: bool,
    /// Ticks of this round.
    tick: u8,
    /// Rounds until the span of commands under way ends.
    until_turn: u8,
    /// Codes have come.
    begun: bool,
}

impl Diagnosis {
    /// Of valid parameters, and what a code of each sensor is worth (swing, boom, arm, bucket), m or rad.
    #[inline(never)]
    pub fn new(p: &DiagnosisParameters, views: [SensorView; 4]) -> Self {
        let mut views = views.into_iter();
        let model = Model::new(p);
        Self {
            // As many sensors as actuators.
            channels: p.actuators.map(|limits| Channel::new(&limits, views.next().unwrap_or(NO_VIEW))),
            model,
            sent: [0.0; 4],
            free: Free { supplied_pa: p.supplied_pa, stalled_pa: p.stalled_pa },
            asked: Asked::default(),
            activities: [0.0; 3],
            others: 0.0,
            faulty: false,
            tick: 0,
            until_turn: model.span_rounds,
            begun: false,
        }
    }

    /// Where its constants lie.
    pub(crate) fn constants(&self) -> [Constant; 5] {
        let [swing, boom, arm, bucket] = self.channels.each_ref().map(Channel::constant);
        [Constant::of(&self.model), swing, boom, arm, bucket]
    }

    /// One tick: the sensors' codes and the pressures.
    #[inline]
    pub fn judge(&mut self, codes: &[u16; 4], pressures: &Pressures) {
        if !self.begun {
            self.begun = true;
            self.channels.iter_mut().zip(codes).for_each(|(channel, code)| channel.begin(*code));
        }
        for (channel, code) in self.channels.iter_mut().zip(codes) {
            channel.sample(*code, &mut self.faulty);
        }
        let number = usize::from(self.tick / 2);
        let turned = self.until_turn == 0;
        if let (Some(channel), Some(command)) = (self.channels.get_mut(number), self.sent.get(number)) {
            if self.tick.is_multiple_of(2) {
                self.asked = channel.measure(&self.model, *command, turned);
            } else {
                // The swing, number 0, has none.
                let sides = number.checked_sub(1).and_then(|cylinder| pressures.get(cylinder));
                let named = channel.look((&self.model, self.free), (&self.asked, self.others), sides);
                // In the tick that has less to do: what it is told from changes only with a measurement.
                let activity = channel.activity();
                self.others = self.others(activity);
                if named {
                    self.faulty = self.channels.iter().any(|channel| channel.wrong.is_some());
                }
            }
        }
        self.tick += 1;
        if self.tick == ROUND_TICKS {
            self.tick = 0;
            self.until_turn = if turned { self.model.span_rounds } else { self.until_turn }.saturating_sub(1);
        }
    }

    /// One tick in service, in which actuators move without speeds being asked for: only a code that jumps is a fault, and the watch
    /// over motion begins afresh when service ends.
    #[inline]
    pub fn in_service(&mut self, codes: &[u16; 4]) -> Option<Fault> {
        let begun = core::mem::replace(&mut self.begun, true);
        for (channel, code) in self.channels.iter_mut().zip(codes).filter(|_| begun) {
            channel.sample(*code, &mut self.faulty);
        }
        let jumped = self.fault();
        self.channels.iter_mut().zip(codes).for_each(|(channel, code)| channel.restart(*code));
        (self.sent, self.asked, self.faulty) = ([0.0; 4], Asked::default(), false);
        (self.activities, self.others) = ([0.0; 3], 0.0);
        jumped
    }

    /// The largest of the last three activities, of which this is the last.
    #[inline(always)]
    fn others(&mut self, activity: f32) -> f32 {
        let [_, first, second] = self.activities;
        self.activities = [first, second, activity];
        let mut largest = 0.0;
        for activity in self.activities {
            if activity > largest {
                largest = activity;
            }
        }
        largest
    }

    /// What went to the valves in this tick.
    #[inline]
    pub fn sent(&mut self, speeds: &Speeds) {
        self.sent = speeds.to_array();
    }

    /// What went to the valves in the tick before.
    #[inline]
    pub fn last_sent(&self) -> Speeds {
        Speeds::from_array(self.sent)
    }

    /// The most urgent fault, of the first actuator that has one.
    #[inline(always)]
    pub fn fault(&self) -> Option<Fault> {
        if self.faulty { self.named() } else { None }
    }

    /// Speeds as measured: swing, boom, arm, bucket, m/s or rad/s.
    #[inline]
    pub fn speeds(&self) -> Speeds {
        Speeds::from_array(self.channels.each_ref().map(Channel::speed))
    }

    /// Some actuator moves.
    #[inline]
    pub fn moving(&self) -> bool {
        self.channels.iter().any(|channel| channel.moving)
    }

    #[inline(never)]
    fn named(&self) -> Option<Fault> {
        let faults = self.channels.iter().zip(ACTUATORS).filter_map(|(channel, cylinder)| {
            let fault = match channel.wrong? {
                Wrong::Jump => Fault::Jump(cylinder),
                Wrong::Stuck => Fault::Stuck(cylinder),
                Wrong::Against => Fault::Against(cylinder),
                Wrong::Uncommanded => Fault::Uncommanded(cylinder),
            };
            Some((channel.wrong, fault))
        });
        faults.min_by_key(|(wrong, _)| wrong.map(|wrong| wrong as u8)).map(|(_, fault)| fault)
    }
}
