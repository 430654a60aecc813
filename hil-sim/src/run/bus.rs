//! Everybody else on the CAN bus: the operator's panel, the slope sensor, the pressure sensors.

use firmware::can::CanFrame;
use firmware::can::address::Addresses;
use firmware::can::command::{Mode, TipVelocity};
use firmware::can::message::{Message, Sender};
use firmware::can::table::received::{
    ARM_COMMAND, ARM_PRESSURES, BOOM_COMMAND, BOOM_PRESSURES, BUCKET_COMMAND, BUCKET_PRESSURES, MODE, PERIOD_MS,
    SERVICE, SLOPE, SWING_COMMAND, TIP_VELOCITY,
};
use firmware::service::ServiceRequest;
use firmware::simulated::FRAMES_IN;
use firmware::{Intent, Request};

/// The service tool speaks in this millisecond of the period.
const SERVICE_PHASE: u16 = 12;

/// Frames of one tick.
pub(crate) type Frames = [Option<CanFrame>; FRAMES_IN];

/// What the others have to say.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Said {
    /// What the operator asks for; `None` when the panel is silent.
    pub(crate) intent: Option<Intent>,
    /// Chassis roll (positive to the right) and pitch (positive nose up), degrees.
    pub(crate) slope_deg: [f64; 2],
    /// Pressures of boom, arm and bucket, \[head, rod\], Pa; `None` on a machine that has no such sensors.
    pub(crate) pressures_pa: Option<[[f64; 2]; 3]>,
}

/// The senders: each message at its period, no two of a kind in one millisecond, so that the bus is never late.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Bus {
    tick: u16,
    counter: u8,
}

impl Bus {
    /// The frames that arrive in this tick; called once a tick.
    pub(crate) fn frames(&mut self, said: &Said) -> Frames {
        let phase = self.tick;
        self.tick = (self.tick + 1) % PERIOD_MS;
        if phase == 0 {
            self.counter = (self.counter + 1) & 0xf;
        }
        let mut frames = [None; FRAMES_IN];
        let [panel, slope, pressures, _] = &mut frames;
        *panel = said.intent.and_then(|intent| self.panel(phase, &intent));
        if phase % 10 == 6 {
            let [roll, pitch] = said.slope_deg.map(|deg| deg as f32);
            *slope = Some(self.sent(&SLOPE, [pitch, roll, 0.0, 0.0, 0.0, 0.0, 0.0]));
        }
        *pressures = said.pressures_pa.and_then(|[boom, arm, bucket]| match phase {
            7 => Some(self.pressures(&BOOM_PRESSURES, boom)),
            8 => Some(self.pressures(&ARM_PRESSURES, arm)),
            9 => Some(self.pressures(&BUCKET_PRESSURES, bucket)),
            _ => None,
        });
        frames
    }

    /// The service tool's frame, in the millisecond it has.
    pub(crate) fn service(&self, request: &ServiceRequest) -> Option<CanFrame> {
        // The phase of this tick's frames was the one before.
        if self.tick != SERVICE_PHASE + 1 {
            return None;
        }
        let values =
            [request.task.code() as f32, f32::from(request.spool), 0.0, request.current_a.clamp(-3.0, 3.0), 0.0, 0.0];
        let [_, _, number, ..] = &SERVICE.signals;
        let payload = number.put(SERVICE.encode(values), request.number.into());
        let source = Addresses::DEFAULT.of(SERVICE.header.sender).unwrap_or_default();
        Some(SERVICE.frame(source, self.counter, payload))
    }

    fn panel(&self, phase: u16, intent: &Intent) -> Option<CanFrame> {
        let [swing, boom, arm, bucket] = intent.levers;
        match phase {
            0 => Some(self.sent(&MODE, [mode(intent.request).code() as f32, 0.0, 0.0])),
            1 => Some(self.valve(&SWING_COMMAND, swing)),
            2 => Some(self.valve(&BOOM_COMMAND, boom)),
            3 => Some(self.valve(&ARM_COMMAND, arm)),
            4 => Some(self.valve(&BUCKET_COMMAND, bucket)),
            5 => {
                let TipVelocity { x_mps, z_mps, pitch_radps } = intent.tip;
                Some(self.sent(&TIP_VELOCITY, [x_mps, z_mps, pitch_radps, 0.0, 0.0]))
            }
            _ => None,
        }
    }

    /// A lever as flow and direction.
    fn valve(&self, message: &Message<4>, lever: i16) -> CanFrame {
        let flow = f32::from(lever).abs() / f32::from(i16::MAX) * 100.0;
        let state = match lever {
            0 => 0.0,
            1.. => 1.0,
            _ => 2.0,
        };
        self.sent(message, [flow.clamp(0.0, 100.0), state, 0.0, 0.0])
    }

    fn pressures(&self, message: &Message<4>, sides_pa: [f64; 2]) -> CanFrame {
        let [head, rod] = sides_pa.map(|pa| pa.clamp(0.0, 60e6) as f32);
        self.sent(message, [head, rod, 0.0, 0.0])
    }

    fn sent<const N: usize>(&self, message: &Message<N>, values: [f32; N]) -> CanFrame {
        // Every sender of the table but "any" has an address.
        let source = Addresses::DEFAULT.of(message.header.sender).unwrap_or_default();
        debug_assert!(message.header.sender != Sender::Any);
        message.frame(source, self.counter, message.encode(values))
    }
}

fn mode(request: Request) -> Mode {
    match request {
        Request::Neutral => Mode::Neutral,
        Request::Dig => Mode::Dig,
        Request::Levers => Mode::Levers,
        Request::Reach => Mode::Reach,
        Request::Move => Mode::Move,
        Request::TipVelocity => Mode::TipVelocity,
        Request::Grade => Mode::Grade,
        Request::Path => Mode::Path,
    }
}
