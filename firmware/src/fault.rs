//! The supervisor's states and the faults, with their codes and names.

use kinematics_core::Cylinder;

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
    /// The supply voltage left its range.
    Supply,
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
    /// Every fault, most urgent first.
    pub const ALL: [Self; 13] = [
        Self::EmergencyStop,
        Self::Overrun,
        Self::Supply,
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
            Self::NotAtStart => "not_at_start",
            Self::FollowingError => "following_error",
            Self::Trajectory => "trajectory_unreachable",
        }
    }
}
