//! A board of plain values behind embedded-hal's and embedded-can's traits, and a record to store.

use std::cell::Cell;
use std::rc::Rc;
use std::sync::LazyLock;

use embedded_can::nb::Can;
use embedded_can::{ExtendedId, Frame, Id};
use embedded_hal::digital::{ErrorKind, ErrorType, InputPin, OutputPin};
use embedded_hal::pwm::SetDutyCycle;
use firmware::Parameters;
use firmware::board::ads8688::{Ads8688, Device};
use firmware::board::signals::RANGES;
use firmware::board::{Parts, Watchdog};
use firmware::store::{Bucket, MAX_BUCKETS, Name, Sealed, StoredRecord};
use hil_sim::scenario::Scenario;
use sim_chips::ads8688::Ads8688 as Chip;

use crate::rig::scenario;

/// A pin: `None` when it is broken. Clones share the level, as a wire does.
#[derive(Clone, Debug)]
pub struct Wire(pub Rc<Cell<Option<bool>>>);

impl Wire {
    /// At this level.
    pub fn new(level: bool) -> Self {
        Self(Rc::new(Cell::new(Some(level))))
    }
}

impl ErrorType for Wire {
    type Error = ErrorKind;
}

impl InputPin for Wire {
    fn is_high(&mut self) -> Result<bool, ErrorKind> {
        self.0.get().ok_or(ErrorKind::Other)
    }

    fn is_low(&mut self) -> Result<bool, ErrorKind> {
        self.is_high().map(|high| !high)
    }
}

impl OutputPin for Wire {
    fn set_low(&mut self) -> Result<(), ErrorKind> {
        self.0.get().map(|_| self.0.set(Some(false))).ok_or(ErrorKind::Other)
    }

    fn set_high(&mut self) -> Result<(), ErrorKind> {
        self.0.get().map(|_| self.0.set(Some(true))).ok_or(ErrorKind::Other)
    }
}

/// A PWM output of 12 bits; `works` false makes every access fail.
#[derive(Clone, Copy, Debug)]
pub struct Pwm {
    /// 0 to 4095.
    pub duty: u16,
    /// It obeys.
    pub works: bool,
}

impl embedded_hal::pwm::ErrorType for Pwm {
    type Error = embedded_hal::pwm::ErrorKind;
}

impl SetDutyCycle for Pwm {
    fn max_duty_cycle(&self) -> u16 {
        4095
    }

    fn set_duty_cycle(&mut self, duty: u16) -> Result<(), Self::Error> {
        if !self.works {
            return Err(embedded_hal::pwm::ErrorKind::Other);
        }
        self.duty = duty;
        Ok(())
    }
}

/// A frame of up to eight bytes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CanFrame(Id, Vec<u8>);

impl Frame for CanFrame {
    fn new(id: impl Into<Id>, data: &[u8]) -> Option<Self> {
        (data.len() <= 8).then(|| Self(id.into(), data.to_vec()))
    }

    fn new_remote(_: impl Into<Id>, _: usize) -> Option<Self> {
        None
    }

    fn is_extended(&self) -> bool {
        matches!(self.0, Id::Extended(_))
    }

    fn is_remote_frame(&self) -> bool {
        false
    }

    fn id(&self) -> Id {
        self.0
    }

    fn dlc(&self) -> usize {
        self.1.len()
    }

    fn data(&self) -> &[u8] {
        &self.1
    }
}

/// A CAN controller that hears itself.
#[derive(Clone, Debug, Default)]
pub struct Loopback(Vec<CanFrame>);

impl Can for Loopback {
    type Frame = CanFrame;
    type Error = embedded_can::ErrorKind;

    fn transmit(&mut self, frame: &CanFrame) -> nb::Result<Option<CanFrame>, Self::Error> {
        self.0.push(frame.clone());
        Ok(None)
    }

    fn receive(&mut self) -> nb::Result<CanFrame, Self::Error> {
        self.0.pop().ok_or(nb::Error::WouldBlock)
    }
}

/// A CAN controller between two queues.
#[derive(Clone, Debug, Default)]
pub struct Bus {
    /// Frames on their way to the controller.
    pub inbound: std::collections::VecDeque<firmware::can::CanFrame>,
    /// Frames it has sent.
    pub outbound: Vec<firmware::can::CanFrame>,
}

impl Can for Bus {
    type Frame = firmware::can::CanFrame;
    type Error = embedded_can::ErrorKind;

    fn transmit(&mut self, frame: &Self::Frame) -> nb::Result<Option<Self::Frame>, Self::Error> {
        self.outbound.push(*frame);
        Ok(None)
    }

    fn receive(&mut self) -> nb::Result<Self::Frame, Self::Error> {
        self.inbound.pop_front().ok_or(nb::Error::WouldBlock)
    }
}

/// A watchdog that counts.
#[derive(Clone, Copy, Debug, Default)]
pub struct Dog(pub u32);

impl Watchdog for Dog {
    fn feed(&mut self) {
        self.0 += 1;
    }
}

/// The reference ECU's parts, simulated.
pub type SimBoard<C = Loopback> = Parts<Chip, Pwm, Wire, Wire, C, Dog>;

/// A healthy board: converters configured, cut-off open, enable off, emergency stop released.
pub fn board() -> SimBoard {
    board_on(Loopback::default())
}

/// The same on this CAN controller.
pub fn board_on<C>(can: C) -> SimBoard<C> {
    let mut devices = [Device::One, Device::Two].into_iter().zip(RANGES);
    let adcs = std::array::from_fn(|_| {
        let (device, ranges) = devices.next().expect("two converters");
        let mut adc = Ads8688::new(Chip::new(), device, ranges);
        adc.configure().expect("a healthy chip");
        adc
    });
    let cut_off = Wire::new(false);
    SimBoard {
        adcs,
        solenoids: [[Pwm { duty: 0, works: true }; 2]; 4],
        // The relay follows its coil.
        cut_off_read_back: cut_off.clone(),
        cut_off,
        enable: Wire::new(false),
        emergency_stop_released: Wire::new(true),
        can,
        watchdog: Dog::default(),
    }
}

/// A frame to send.
pub fn can_frame(data: &[u8]) -> CanFrame {
    CanFrame::new(ExtendedId::ZERO, data).expect("at most eight bytes")
}

/// A valid record of the dig scenario's machine with its own bucket and a longer one; the following error tells records apart.
pub fn record(following_error_m: f32) -> StoredRecord {
    static DIG: LazyLock<Parameters> = LazyLock::new(|| scenario("dig").parameters);
    let mut parameters = *DIG;
    parameters.motion.following_error_m = following_error_m;
    let geometry = &parameters.geometry;
    let own = Bucket {
        name: Name::new("digging").expect("a name"),
        bucket_m: geometry.bucket_m,
        coupler_pin: geometry.bucket.coupler_pin,
        coupler_m: geometry.bucket.coupler_m,
    };
    let mut buckets = [None; MAX_BUCKETS];
    buckets[0] = Some(own);
    buckets[1] = Some(Bucket { name: Name::new("ditch").expect("a name"), bucket_m: own.bucket_m * 1.1, ..own });
    StoredRecord { machine: Name::new("frankel").expect("a name"), parameters, buckets, mounted: 0 }
}

/// A record of this scenario's machine with its own bucket and, behind it, buckets so many times as long.
pub fn record_of(scenario: &Scenario, times: &[f64]) -> StoredRecord {
    let g = &scenario.parameters.geometry;
    let bucket = |times: f64| Bucket {
        name: Name::new(&format!("{times} times")).expect("a name"),
        bucket_m: times * g.bucket_m,
        coupler_pin: g.bucket.coupler_pin,
        coupler_m: g.bucket.coupler_m,
    };
    let mut buckets = [None; MAX_BUCKETS];
    buckets.iter_mut().zip([1.0].iter().chain(times)).for_each(|(place, times)| *place = Some(bucket(*times)));
    let machine = Name::new(&scenario.machine.name).expect("a name");
    StoredRecord { machine, parameters: scenario.parameters, buckets, mounted: 0 }
}

/// [`record`], sealed and approved.
pub fn approved(following_error_m: f32) -> Sealed {
    let mut sealed = Sealed::new(&record(following_error_m)).unwrap_or_else(|fault| panic!("{fault}"));
    sealed.approve();
    sealed
}
