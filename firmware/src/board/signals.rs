//! Which signal stands on which channel of the two converters, as a table.

use super::ads8688::{Codes, Range};
use crate::io::Solenoids;

/// What a channel measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Signal {
    /// Position sensor of a spool's cylinder, by its place in [`crate::io::SPOOLS`].
    Position(usize),
    /// Battery voltage behind its divider.
    Supply,
    /// Supply of the position sensors.
    SensorSupply,
    /// Current of a spool's solenoid: spool, then 0 extend or 1 retract.
    Coil(usize, usize),
    /// Connected to analogue ground.
    Spare,
}

/// Channel by channel: first converter, second converter.
pub const SIGNALS: [[Signal; 8]; 2] = [
    [
        Signal::Position(0),
        Signal::Position(1),
        Signal::Position(2),
        Signal::Position(3),
        Signal::Supply,
        Signal::SensorSupply,
        Signal::Spare,
        Signal::Spare,
    ],
    [
        Signal::Coil(0, 0),
        Signal::Coil(0, 1),
        Signal::Coil(1, 0),
        Signal::Coil(1, 1),
        Signal::Coil(2, 0),
        Signal::Coil(2, 1),
        Signal::Coil(3, 0),
        Signal::Coil(3, 1),
    ],
];

/// Ranges of the same channels: sensors 0.5 to 9.5 V, shunt amplifiers 0 to 5 V.
pub const RANGES: [[Range; 8]; 2] = [[Range::To10V24; 8], [Range::To5V12; 8]];

/// The codes by what they mean.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Measured {
    /// Position sensors: swing, boom, arm, bucket.
    pub positions: [u16; 4],
    /// Battery voltage.
    pub supply: u16,
    /// The position sensors' supply.
    pub sensor_supply: u16,
    /// Coil currents, a spool each.
    pub coils: [Solenoids<u16>; 4],
}

impl Measured {
    /// Sorts both converters' scans by [`SIGNALS`].
    pub fn from_scans(scans: &[Codes; 2]) -> Self {
        let mut measured = Self::default();
        for (signal, &code) in SIGNALS.iter().flatten().zip(scans.iter().flatten()) {
            let place = match *signal {
                Signal::Position(spool) => measured.positions.get_mut(spool),
                Signal::Coil(spool, solenoid) => measured.coils.get_mut(spool).and_then(|s| s.get_mut(solenoid)),
                Signal::Supply => Some(&mut measured.supply),
                Signal::SensorSupply => Some(&mut measured.sensor_supply),
                Signal::Spare => None,
            };
            if let Some(place) = place {
                *place = code;
            }
        }
        measured
    }
}
