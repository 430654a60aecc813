//! The supervisor's states and the faults, with their codes and names.

use kinematics_core::Cylinder;

use crate::valve::coil_fault::FaultyCoil;

/// The supervisor's state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    /// Waiting for neutral with the enable switch off.
    Locked,
    /// Waiting for the enable switch.
    Ready,
    /// The gate is open.
    Running,
    /// Something went wrong; the fault is latched.
    Fault,
}

impl State {
    const ALL: [Self; 4] = [Self::Locked, Self::Ready, Self::Running, Self::Fault];

    /// As a byte.
    pub const fn code(self) -> u8 {
        self as u8
    }

    /// From a byte.
    pub fn from_code(code: u8) -> Option<Self> {
        Self::ALL.into_iter().find(|state| state.code() == code)
    }
}

/// Why the machine was stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// The emergency stop was pressed.
    EmergencyStop,
    /// A tick did not finish in its period.
    Overrun,
    /// The master cut-off stayed closed though it was opened.
    CutOffWelded,
    /// The master cut-off stayed open though it was closed.
    CutOffStuckOpen,
    /// The converter of the position sensors and the supply does not answer soundly.
    SensorConverter,
    /// The converter of the coil currents does not answer soundly.
    CoilConverter,
    /// The supply voltage left its range.
    Supply,
    /// A coil, its driver or its wires.
    Coil(FaultyCoil),
    /// The position sensors' supply left its range.
    SensorSupply,
    /// A position sensor's code left its range.
    Sensor(Cylinder),
    /// The lengths give no pose: a linkage does not close.
    Geometry,
    /// The command counter stood still longer than the timeout.
    CommandStale,
    /// Something was asked for that the parameters do not hold.
    NotConfigured,
    /// A dig was asked for too far from its start.
    NotAtStart,
    /// A cylinder strayed too far from its reference.
    FollowingError,
    /// The reference left what the machine can reach.
    Trajectory,
}

impl Fault {
    /// Every fault of no coil, most urgent first.
    const PLAIN: [Self; 18] = [
        Self::EmergencyStop,
        Self::Overrun,
        Self::CutOffWelded,
        Self::CutOffStuckOpen,
        Self::SensorConverter,
        Self::CoilConverter,
        Self::Supply,
        Self::SensorSupply,
        Self::Sensor(Cylinder::Swing),
        Self::Sensor(Cylinder::Boom),
        Self::Sensor(Cylinder::Arm),
        Self::Sensor(Cylinder::Bucket),
        Self::Geometry,
        Self::CommandStale,
        Self::NotConfigured,
        Self::NotAtStart,
        Self::FollowingError,
        Self::Trajectory,
    ];

    /// Every fault: those of no coil, most urgent first, then those of the coils.
    pub const ALL: [Self; Self::PLAIN.len() + FaultyCoil::ALL.len()] = {
        let mut all = [Self::EmergencyStop; Self::PLAIN.len() + FaultyCoil::ALL.len()];
        let mut at = 0;
        while at < all.len() {
            all[at] = match at.checked_sub(Self::PLAIN.len()) {
                None => Self::PLAIN[at],
                Some(coil) => Self::Coil(FaultyCoil::ALL[coil]),
            };
            at += 1;
        }
        all
    };

    /// As a byte, never 0.
    pub const fn code(self) -> u8 {
        match self {
            Self::EmergencyStop => 1,
            Self::Overrun => 2,
            Self::Supply => 3,
            Self::Sensor(Cylinder::Swing) => 4,
            Self::Sensor(Cylinder::Boom) => 5,
            Self::Sensor(Cylinder::Arm) => 6,
            Self::Sensor(Cylinder::Bucket) => 7,
            Self::Geometry => 8,
            Self::CommandStale => 9,
            Self::NotAtStart => 10,
            Self::FollowingError => 11,
            Self::Trajectory => 12,
            Self::NotConfigured => 13,
            Self::CutOffWelded => 14,
            Self::CutOffStuckOpen => 15,
            Self::SensorConverter => 16,
            Self::CoilConverter => 17,
            Self::SensorSupply => 63,
            Self::Coil(coil) => coil.code(),
        }
    }

    /// From a byte.
    pub fn from_code(code: u8) -> Option<Self> {
        Self::ALL.into_iter().find(|fault| fault.code() == code)
    }

    /// A name for logs and JSON.
    pub const fn name(self) -> &'static str {
        match self {
            Self::EmergencyStop => "emergency_stop",
            Self::Overrun => "tick_overrun",
            Self::Supply => "supply_out_of_range",
            Self::Sensor(Cylinder::Swing) => "swing_sensor_out_of_range",
            Self::Sensor(Cylinder::Boom) => "boom_sensor_out_of_range",
            Self::Sensor(Cylinder::Arm) => "arm_sensor_out_of_range",
            Self::Sensor(Cylinder::Bucket) => "bucket_sensor_out_of_range",
            Self::Geometry => "geometry_impossible",
            Self::CommandStale => "command_stale",
            Self::NotConfigured => "not_configured",
            Self::CutOffWelded => "cut_off_welded",
            Self::CutOffStuckOpen => "cut_off_stuck_open",
            Self::SensorConverter => "sensor_converter_unsound",
            Self::CoilConverter => "coil_converter_unsound",
            Self::SensorSupply => "sensor_supply_out_of_range",
            Self::Coil(coil) => coil.name(),
            Self::NotAtStart => "not_at_start",
            Self::FollowingError => "following_error",
            Self::Trajectory => "trajectory_unreachable",
        }
    }
}
