//! Book-keeping of oil and energy, for whoever asks: nothing of it is computed in a plain step.

use super::oil::Oil;

/// The ways oil takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Path {
    /// From the tank into the gallery.
    Pump,
    /// From the gallery to the tank.
    MainRelief,
    /// From the gallery to a chamber.
    MeterIn,
    /// From a chamber to the tank, or back.
    MeterOut,
    /// Past a piston, from one side to the other.
    PistonLeak,
    /// Past a spool to the tank.
    SpoolLeak,
    /// Through a port relief valve to the tank.
    PortRelief,
    /// From the tank through an anti-cavitation valve.
    MakeUp,
}

/// Energy that leaves the machine's mechanics.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Loss {
    /// Friction.
    Friction,
    /// Against a travel stop.
    Stop,
    /// In the soil.
    Soil,
}

/// Hears of every flow and loss of a sub-step.
pub(super) trait Observer {
    /// Whether it is told anything at all.
    const LISTENS: bool;
    /// Content (m³) that went from one absolute pressure to another.
    fn flow(&mut self, path: Path, from_pa: f64, to_pa: f64, content_m3: f64);
    /// Energy lost by the mechanics, J.
    fn loss(&mut self, loss: Loss, energy_j: f64);
    /// Work the pistons did on the atmosphere, J.
    fn atmosphere(&mut self, energy_j: f64);
}

impl Observer for () {
    const LISTENS: bool = false;
    fn flow(&mut self, _: Path, _: f64, _: f64, _: f64) {}
    fn loss(&mut self, _: Loss, _: f64) {}
    fn atmosphere(&mut self, _: f64) {}
}

/// The sums of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ledger {
    oil: Oil,
    tank_pa: f64,
    /// Delivered by the pump, J.
    pub pump_j: f64,
    /// Lost in metering edges and cushions, J.
    pub metering_j: f64,
    /// Lost in leakage, relief and anti-cavitation valves, J.
    pub valves_j: f64,
    /// Lost in friction, J.
    pub friction_j: f64,
    /// Lost at the travel stops, J.
    pub stops_j: f64,
    /// Lost in the soil, J.
    pub soil_j: f64,
    /// Work on the atmosphere, J.
    pub atmosphere_j: f64,
    /// Oil the pump delivered, m³ at atmospheric pressure.
    pub pumped_m3: f64,
    /// Oil that went back to the tank, m³.
    pub returned_m3: f64,
    /// Oil sucked from the tank by the chambers, m³.
    pub made_up_m3: f64,
}

impl Ledger {
    /// Empty sums.
    pub(super) fn new(oil: Oil, tank_pa: f64) -> Self {
        Self {
            oil,
            tank_pa,
            pump_j: 0.0,
            metering_j: 0.0,
            valves_j: 0.0,
            friction_j: 0.0,
            stops_j: 0.0,
            soil_j: 0.0,
            atmosphere_j: 0.0,
            pumped_m3: 0.0,
            returned_m3: 0.0,
            made_up_m3: 0.0,
        }
    }

    /// Oil that stayed in the machine, m³.
    pub fn kept_m3(&self) -> f64 {
        self.pumped_m3 + self.made_up_m3 - self.returned_m3
    }

    /// Everything lost, J.
    pub fn lost_j(&self) -> f64 {
        self.metering_j + self.valves_j + self.friction_j + self.stops_j + self.soil_j
    }

    /// Energy of a content in the machine, above what it had in the tank, J.
    pub(super) fn stored_j(&self, content_m3: f64, pressure_pa: f64) -> f64 {
        content_m3 * (self.oil.energy(pressure_pa) - self.oil.enthalpy(self.tank_pa))
    }
}

impl Observer for Ledger {
    const LISTENS: bool = true;

    fn flow(&mut self, path: Path, from_pa: f64, to_pa: f64, content_m3: f64) {
        let lost = content_m3 * (self.oil.enthalpy(from_pa) - self.oil.enthalpy(to_pa));
        match path {
            Path::Pump => {
                self.pump_j -= lost;
                self.pumped_m3 += content_m3;
            }
            Path::MeterIn | Path::MeterOut => self.metering_j += lost,
            Path::MainRelief | Path::PistonLeak | Path::SpoolLeak | Path::PortRelief | Path::MakeUp => {
                self.valves_j += lost
            }
        }
        match path {
            Path::MakeUp => self.made_up_m3 += content_m3,
            Path::MainRelief | Path::MeterOut | Path::SpoolLeak | Path::PortRelief => self.returned_m3 += content_m3,
            Path::Pump | Path::MeterIn | Path::PistonLeak => {}
        }
    }

    fn loss(&mut self, loss: Loss, energy_j: f64) {
        match loss {
            Loss::Friction => self.friction_j += energy_j,
            Loss::Stop => self.stops_j += energy_j,
            Loss::Soil => self.soil_j += energy_j,
        }
    }

    fn atmosphere(&mut self, energy_j: f64) {
        self.atmosphere_j += energy_j;
    }
}
