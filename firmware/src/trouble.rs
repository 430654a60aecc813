//! Each fault's diagnostic trouble code, J1939-73: suspect parameter number (SPN), failure mode identifier (FMI), lamp.

use kinematics_core::Cylinder;

use crate::fault::Fault;
use crate::valve::coil_fault::CoilFault;

/// The lamp a fault lights.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lamp {
    /// The machine goes on.
    AmberWarning,
    /// The machine was stopped.
    RedStop,
}

/// A trouble code.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TroubleCode {
    /// 19 bits.
    pub spn: u32,
    /// 5 bits.
    pub fmi: u8,
    /// Its lamp.
    pub lamp: Lamp,
}

/// First of the SPNs that J1939 leaves to makers; the last is 524287.
pub const FIRST_SPN: u32 = 520_192;

/// Data erratic, intermittent or incorrect.
const ERRATIC: u8 = 2;
/// Voltage above normal, or shorted to high source.
const SHORTED_HIGH: u8 = 3;
/// Voltage below normal, or shorted to low source.
const SHORTED_LOW: u8 = 4;
/// Current below normal or open circuit.
const OPEN: u8 = 5;
/// Current above normal or grounded circuit.
const OVER_CURRENT: u8 = 6;
/// Mechanical system not responding or out of adjustment.
const NOT_RESPONDING: u8 = 7;
/// Abnormal update rate.
const UPDATE_RATE: u8 = 9;
/// Abnormal rate of change.
const ABNORMAL_RATE: u8 = 10;
/// Bad intelligent device or component.
const BAD_DEVICE: u8 = 12;
/// Out of calibration.
const NOT_CALIBRATED: u8 = 13;
/// Special instructions: both solenoids of a spool are on.
const CROSS: u8 = 14;
/// Data valid but below normal operating range, moderately severe.
const TOO_LITTLE: u8 = 18;
/// Condition exists.
const EXISTS: u8 = 31;

const fn stop(number: u32, fmi: u8) -> TroubleCode {
    TroubleCode { spn: FIRST_SPN + number, fmi, lamp: Lamp::RedStop }
}

const fn failure_mode(fault: CoilFault) -> u8 {
    match fault {
        CoilFault::ShortToGround => SHORTED_LOW,
        CoilFault::ShortToSupply => SHORTED_HIGH,
        CoilFault::Cross => CROSS,
        CoilFault::OverCurrent => OVER_CURRENT,
        CoilFault::Open => OPEN,
        CoilFault::Saturated => TOO_LITTLE,
    }
}

impl Fault {
    /// Its trouble code. A number once given is never given to another cause.
    pub const fn trouble_code(self) -> TroubleCode {
        match self {
            Self::EmergencyStop => stop(0, EXISTS),
            Self::Overrun => stop(1, BAD_DEVICE),
            Self::Supply => stop(2, ERRATIC),
            Self::Sensor(Cylinder::Swing) => stop(3, ERRATIC),
            Self::Sensor(Cylinder::Boom) => stop(4, ERRATIC),
            Self::Sensor(Cylinder::Arm) => stop(5, ERRATIC),
            Self::Sensor(Cylinder::Bucket) => stop(6, ERRATIC),
            Self::Geometry => stop(7, ERRATIC),
            Self::CommandStale => stop(8, UPDATE_RATE),
            Self::NotAtStart => stop(9, EXISTS),
            Self::FollowingError => stop(10, NOT_RESPONDING),
            Self::Trajectory => stop(11, EXISTS),
            Self::NotConfigured => stop(12, NOT_CALIBRATED),
            Self::CutOffWelded => stop(13, NOT_RESPONDING),
            Self::CutOffStuckOpen => stop(14, NOT_RESPONDING),
            Self::SensorConverter => stop(15, BAD_DEVICE),
            Self::CoilConverter => stop(16, BAD_DEVICE),
            Self::ParametersCorrupt => stop(17, ERRATIC),
            Self::Memory => stop(18, BAD_DEVICE),
            Self::ConverterSetUp => stop(19, NOT_CALIBRATED),
            Self::OutputDrivers => stop(20, BAD_DEVICE),
            Self::CutOffUnproven => stop(21, NOT_RESPONDING),
            Self::LateTick => TroubleCode { lamp: Lamp::AmberWarning, ..stop(22, BAD_DEVICE) },
            Self::Jump(Cylinder::Swing) => stop(23, ABNORMAL_RATE),
            Self::Jump(Cylinder::Boom) => stop(24, ABNORMAL_RATE),
            Self::Jump(Cylinder::Arm) => stop(25, ABNORMAL_RATE),
            Self::Jump(Cylinder::Bucket) => stop(26, ABNORMAL_RATE),
            Self::Stuck(Cylinder::Swing) => stop(27, ERRATIC),
            Self::Stuck(Cylinder::Boom) => stop(28, ERRATIC),
            Self::Stuck(Cylinder::Arm) => stop(29, ERRATIC),
            Self::Stuck(Cylinder::Bucket) => stop(30, ERRATIC),
            Self::Uncommanded(Cylinder::Swing) => stop(31, EXISTS),
            Self::Uncommanded(Cylinder::Boom) => stop(32, EXISTS),
            Self::Uncommanded(Cylinder::Arm) => stop(33, EXISTS),
            Self::Uncommanded(Cylinder::Bucket) => stop(34, EXISTS),
            Self::Against(Cylinder::Swing) => stop(35, NOT_RESPONDING),
            Self::Against(Cylinder::Boom) => stop(36, NOT_RESPONDING),
            Self::Against(Cylinder::Arm) => stop(37, NOT_RESPONDING),
            Self::Against(Cylinder::Bucket) => stop(38, NOT_RESPONDING),
            Self::SensorSupply => stop(63, ERRATIC),
            // A number a coil; the identifier says what is wrong with it.
            Self::Coil(coil) => stop(64 + coil.coil(), failure_mode(coil.fault)),
        }
    }
}
