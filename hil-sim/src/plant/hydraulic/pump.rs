//! Load-sensing pump: pressure a margin above the highest load, within flow, power and pressure limits, each with its lag.
//!
//! The regulator is modelled by what it achieves: the delivery follows, with a lag, the flow that would bring the gallery's pressure to its
//! target with another lag. Its spool and swash plate are not modelled.

/// How the valve shares the pump's flow when there is too little of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Compensation {
    /// A compensator before each metering edge: the heaviest load starves first.
    Pre,
    /// A compensator behind each, set by the highest load: all slow down in proportion.
    Post,
}

/// The pump and its valve block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PumpModel {
    /// Largest delivery, m³/s.
    pub flow_m3ps: f64,
    /// Largest hydraulic power, W.
    pub power_w: f64,
    /// Above the highest load, Pa.
    pub margin_pa: f64,
    /// Where the regulator cuts off and the main relief valve begins to open, Pa above the atmosphere.
    pub supply_pa: f64,
    /// Lag of the swash plate, s.
    pub lag_s: f64,
    /// Lag of the load-sensing line, s.
    pub sense_lag_s: f64,
    /// Oil between pump and valves, m³.
    pub volume_m3: f64,
    /// Sharing.
    pub compensation: Compensation,
}

impl PumpModel {
    /// Pressure drop over a metering edge while there is flow enough, Pa.
    pub fn metering_drop_pa(&self) -> f64 {
        match self.compensation {
            // What the compensator keeps for itself is a quarter.
            Compensation::Pre => 0.75 * self.margin_pa,
            Compensation::Post => self.margin_pa,
        }
    }

    /// Conductance of the main relief valve above its setting, m³/s/Pa: all of the flow at 3 % more.
    pub fn relief_gain(&self) -> f64 {
        self.flow_m3ps / (0.03 * self.supply_pa)
    }

    /// Pressure drop over the metering edge of a consumer at `load_pa` under a highest load of `highest_pa`; and whether it moves with the
    /// gallery's pressure, and with the consumer's.
    pub fn drop(&self, gallery_pa: f64, load_pa: f64, highest_pa: f64) -> (f64, bool, bool) {
        let whole = gallery_pa - load_pa;
        match self.compensation {
            Compensation::Pre => {
                let kept = self.metering_drop_pa();
                if whole > kept { (kept, false, false) } else { (whole, true, true) }
            }
            Compensation::Post if highest_pa > load_pa => (gallery_pa - highest_pa, true, false),
            Compensation::Post => (whole, true, true),
        }
    }
}

/// A pump that turns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pump {
    /// Delivery, m³/s.
    pub flow_m3ps: f64,
    /// What arrives of the highest load, Pa.
    pub sensed_pa: f64,
}

/// What the pump meets in a sub-step; pressures above the atmosphere, Pa.
#[derive(Clone, Copy, Debug)]
pub(super) struct Demand {
    /// In the gallery.
    pub(super) gallery_pa: f64,
    /// dN/dp of the gallery, m³/Pa.
    pub(super) capacity: f64,
    /// What the functions take, m³/s, and its slope by the gallery's pressure, m³/s/Pa.
    pub(super) taken: f64,
    /// See `taken`.
    pub(super) slope: f64,
}

impl Pump {
    /// One sub-step of the load-sensing line towards the highest load, Pa above the atmosphere.
    pub(super) fn sense(&mut self, model: &PumpModel, load_pa: f64, h: f64) {
        self.sensed_pa += (load_pa - self.sensed_pa) * (h / (model.sense_lag_s + 0.5 * h));
    }

    /// One sub-step: towards the flow that the functions would take at the target pressure, and that raises the gallery to it.
    pub(super) fn advance(&mut self, model: &PumpModel, demand: &Demand, h: f64) {
        let target = (self.sensed_pa + model.margin_pa).clamp(0.0, model.supply_pa);
        let by_power = model.power_w / if demand.gallery_pa > 1e5 { demand.gallery_pa } else { 1e5 };
        let most = if by_power < model.flow_m3ps { by_power } else { model.flow_m3ps };
        let raising = demand.slope + demand.capacity / (2.0 * model.lag_s);
        let wanted = (demand.taken + raising * (target - demand.gallery_pa)).clamp(0.0, most);
        self.flow_m3ps += (wanted - self.flow_m3ps) * (h / (model.lag_s + 0.5 * h));
    }
}
