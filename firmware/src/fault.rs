//! The supervisor's states and the faults, with their codes and names.

use kinematics_core::Cylinder;

use crate::valve::coil_fault::{CoilFault, FaultyCoil};

/// The supervisor's state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    /// Waiting for neutral with the enable switch off.
    Locked,
    /// Waiting for the enable switch.
    Ready,
    /// The gate is open.
    Running,
    /// Something went wrong; the fault is latched until neutral and a fresh enable.
    Fault,
    /// The start-up self-test has not passed yet.
    SelfTest,
    /// Something went wrong after which only a restart is trusted.
    Stopped,
}

impl State {
    /// Every state, in the order of the codes.
    pub const ALL: [Self; 6] = [Self::Locked, Self::Ready, Self::Running, Self::Fault, Self::SelfTest, Self::Stopped];

    /// As a byte.
    pub const fn code(self) -> u8 {
        self as u8
    }

    /// From a byte.
    pub fn from_code(code: u8) -> Option<Self> {
        Self::ALL.into_iter().find(|state| state.code() == code)
    }

    /// A name for logs, drawings and the bus.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Locked => "locked",
            Self::Ready => "ready",
            Self::Running => "running",
            Self::Fault => "fault",
            Self::SelfTest => "self_test",
            Self::Stopped => "stopped",
        }
    }
}

/// Why the machine was stopped; [`Fault::LateTick`] alone stops nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// The emergency stop was pressed.
    EmergencyStop,
    /// [`crate::supervisor::OVERRUN_TICKS`] ticks in a row did not finish in their period.
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
    /// The stored parameters' CRC is wrong.
    ParametersCorrupt,
    /// The memory test failed.
    Memory,
    /// A converter's configuration does not read back.
    ConverterSetUp,
    /// The output drivers failed their test.
    OutputDrivers,
    /// The cut-off did not close and open at start-up.
    CutOffUnproven,
    /// One tick did not finish in its period: told of, nothing more.
    LateTick,
    /// A position sensor's code jumped farther than the actuator can move.
    Jump(Cylinder),
    /// A position sensor does not follow the motion that must have happened.
    Stuck(Cylinder),
    /// An actuator moves though nothing asks for it, or faster than asked.
    Uncommanded(Cylinder),
    /// An actuator moves against its command.
    Against(Cylinder),
}

impl Fault {
    /// Every fault of no coil, most urgent first.
    const PLAIN: [Self; 40] = [
        Self::Overrun,
        Self::CutOffWelded,
        Self::ParametersCorrupt,
        Self::Memory,
        Self::ConverterSetUp,
        Self::OutputDrivers,
        Self::CutOffUnproven,
        Self::EmergencyStop,
        Self::CutOffStuckOpen,
        Self::SensorConverter,
        Self::CoilConverter,
        Self::Supply,
        Self::SensorSupply,
        Self::Sensor(Cylinder::Swing),
        Self::Sensor(Cylinder::Boom),
        Self::Sensor(Cylinder::Arm),
        Self::Sensor(Cylinder::Bucket),
        Self::Jump(Cylinder::Swing),
        Self::Jump(Cylinder::Boom),
        Self::Jump(Cylinder::Arm),
        Self::Jump(Cylinder::Bucket),
        Self::Stuck(Cylinder::Swing),
        Self::Stuck(Cylinder::Boom),
        Self::Stuck(Cylinder::Arm),
        Self::Stuck(Cylinder::Bucket),
        Self::Geometry,
        Self::Against(Cylinder::Swing),
        Self::Against(Cylinder::Boom),
        Self::Against(Cylinder::Arm),
        Self::Against(Cylinder::Bucket),
        Self::Uncommanded(Cylinder::Swing),
        Self::Uncommanded(Cylinder::Boom),
        Self::Uncommanded(Cylinder::Arm),
        Self::Uncommanded(Cylinder::Bucket),
        Self::CommandStale,
        Self::NotConfigured,
        Self::NotAtStart,
        Self::FollowingError,
        Self::Trajectory,
        Self::LateTick,
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
    /// Whether only a restart clears it: memory, scheduling or the cut-off itself cannot be trusted any more.
    #[inline]
    pub const fn needs_restart(self) -> bool {
        matches!(
            self,
            Self::Overrun
                | Self::CutOffWelded
                | Self::ParametersCorrupt
                | Self::Memory
                | Self::ConverterSetUp
                | Self::OutputDrivers
                | Self::CutOffUnproven
                | Self::Coil(FaultyCoil { fault: CoilFault::Cross, .. })
        )
    }

    /// Whether the sensors' lengths, and so the pose, mean nothing while it lasts.
    #[inline]
    pub const fn hides_pose(self) -> bool {
        matches!(self, Self::Sensor(_) | Self::Geometry | Self::Jump(_) | Self::Stuck(_))
    }

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
            Self::ParametersCorrupt => 18,
            Self::Memory => 19,
            Self::ConverterSetUp => 20,
            Self::OutputDrivers => 21,
            Self::CutOffUnproven => 22,
            Self::LateTick => 23,
            Self::Jump(Cylinder::Swing) => 24,
            Self::Jump(Cylinder::Boom) => 25,
            Self::Jump(Cylinder::Arm) => 26,
            Self::Jump(Cylinder::Bucket) => 27,
            Self::Stuck(Cylinder::Swing) => 28,
            Self::Stuck(Cylinder::Boom) => 29,
            Self::Stuck(Cylinder::Arm) => 30,
            Self::Stuck(Cylinder::Bucket) => 31,
            Self::Uncommanded(Cylinder::Swing) => 32,
            Self::Uncommanded(Cylinder::Boom) => 33,
            Self::Uncommanded(Cylinder::Arm) => 34,
            Self::Uncommanded(Cylinder::Bucket) => 35,
            Self::Against(Cylinder::Swing) => 36,
            Self::Against(Cylinder::Boom) => 37,
            Self::Against(Cylinder::Arm) => 38,
            Self::Against(Cylinder::Bucket) => 39,
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
            Self::ParametersCorrupt => "parameters_corrupt",
            Self::Memory => "memory",
            Self::ConverterSetUp => "converter_set_up",
            Self::OutputDrivers => "output_drivers",
            Self::CutOffUnproven => "cut_off_unproven",
            Self::LateTick => "tick_late",
            Self::Jump(Cylinder::Swing) => "swing_sensor_jumped",
            Self::Jump(Cylinder::Boom) => "boom_sensor_jumped",
            Self::Jump(Cylinder::Arm) => "arm_sensor_jumped",
            Self::Jump(Cylinder::Bucket) => "bucket_sensor_jumped",
            Self::Stuck(Cylinder::Swing) => "swing_sensor_stuck",
            Self::Stuck(Cylinder::Boom) => "boom_sensor_stuck",
            Self::Stuck(Cylinder::Arm) => "arm_sensor_stuck",
            Self::Stuck(Cylinder::Bucket) => "bucket_sensor_stuck",
            Self::Uncommanded(Cylinder::Swing) => "swing_moves_uncommanded",
            Self::Uncommanded(Cylinder::Boom) => "boom_moves_uncommanded",
            Self::Uncommanded(Cylinder::Arm) => "arm_moves_uncommanded",
            Self::Uncommanded(Cylinder::Bucket) => "bucket_moves_uncommanded",
            Self::Against(Cylinder::Swing) => "swing_moves_against_command",
            Self::Against(Cylinder::Boom) => "boom_moves_against_command",
            Self::Against(Cylinder::Arm) => "arm_moves_against_command",
            Self::Against(Cylinder::Bucket) => "bucket_moves_against_command",
        }
    }
}
