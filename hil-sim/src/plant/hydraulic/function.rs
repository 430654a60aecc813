//! One function of the valve with its cylinder or motor: model, state, and the flows of a sub-step.

use kinematics_core::geometry::Stroke;

use super::cushion::Cushion;
use super::friction::Friction;
use super::metering::{Flow, check, conductance, in_series, opening, orifice, relief_behind};
use super::oil::{ATMOSPHERE_PA, Oil};
use super::pump::PumpModel;

/// A function of the valve and its actuator. Pairs are extend and retract, or head and rod.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FunctionModel {
    /// Piston areas of head and rod side, m² (all cylinders together); a motor's displacement twice, m³/rad.
    pub areas: [f64; 2],
    /// A cylinder's stroke; `None` for a motor.
    pub stroke: Option<Stroke>,
    /// Oil on each side that no stroke moves: hoses and ports, m³.
    pub dead_volume_m3: f64,
    /// Share of the spool's stroke before anything opens.
    pub dead_band: [f64; 2],
    /// Share of the edges' area that grows with the square of the travel.
    pub fine: f64,
    /// Flow to the actuator at full stroke while the pump keeps its margin, m³/s.
    pub meter_in_m3ps: [f64; 2],
    /// Conductance of the fully open outlet edge, m³/s/√Pa.
    pub meter_out: [f64; 2],
    /// Port relief valves, Pa above the atmosphere.
    pub port_relief_pa: f64,
    /// Between head and rod side, m³/s/Pa.
    pub piston_leak: f64,
    /// From either side to the tank, m³/s/Pa.
    pub spool_leak: f64,
    /// Friction.
    pub friction: Friction,
    /// At the retracted and at the extended end.
    pub cushions: [Cushion; 2],
}

impl FunctionModel {
    /// Volumes of head and rod side at a position, m³.
    pub fn volumes(&self, position: f64) -> [f64; 2] {
        let [head, rod] = self.areas;
        match self.stroke {
            Some(Stroke { min_m, max_m }) => {
                [self.dead_volume_m3 + head * (position - min_m), self.dead_volume_m3 + rod * (max_m - position)]
            }
            None => [self.dead_volume_m3; 2],
        }
    }

    /// What the pressures push with, N (a motor: N·m); absolute Pa.
    pub fn push(&self, [head, rod]: [f64; 2]) -> f64 {
        (head - ATMOSPHERE_PA) * self.areas[0] - (rod - ATMOSPHERE_PA) * self.areas[1]
    }

    /// Steady speed at a spool place in −1…1 while the pump keeps its margin: the curve a calibration finds, m/s or rad/s.
    pub fn steady_speed(&self, place: f64) -> f64 {
        let (direction, sign) = if place > 0.0 { (0, 1.0) } else { (1, -1.0) };
        let open = opening(place * sign, self.dead_band[direction], self.fine);
        sign * open * self.meter_in_m3ps[direction] / self.areas[direction]
    }

    /// Load in the direction of motion (extend 0, retract 1) above which the outlet edge lets more go than the inlet gives, N: what a
    /// calibration under a load finds.
    pub fn overrun_n(&self, direction: usize) -> f64 {
        let (driven, other) = (direction, 1 - direction);
        let out = self.meter_in_m3ps[direction] * self.areas[other] / self.areas[driven];
        let root = out / self.meter_out[direction];
        root * root * self.areas[other]
    }
}

impl FunctionModel {
    /// A place of the spool whose steady speed is near this one, for slow speeds, m/s or rad/s.
    pub(super) fn place_of(&self, speed: f64) -> f64 {
        let (direction, sign) = if speed > 0.0 { (0, 1.0) } else { (1, -1.0) };
        // By halving: the curve rises.
        let (mut low, mut high) = (self.dead_band[direction], 1.0);
        for _ in 0..30 {
            let middle = 0.5 * (low + high);
            if self.steady_speed(sign * middle).abs() < speed.abs() { low = middle } else { high = middle }
        }
        if speed == 0.0 { 0.0 } else { sign * high }
    }
}

/// The oil on one side.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Chamber {
    /// m³ at atmospheric pressure.
    pub content_m3: f64,
    /// Absolute, Pa.
    pub pressure_pa: f64,
}

/// Flows of one side that go to or come from the tank.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct SideFlows {
    /// Through the outlet edge.
    pub out: Flow,
    /// Leakage.
    pub leak: Flow,
    /// Through the port relief valve.
    pub relief: Flow,
    /// In from the tank through the anti-cavitation valve; its slope is by the falling pressure.
    pub make_up: Flow,
}

/// What the edges of a function do in a sub-step, before the implicit part.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct FunctionFlows {
    /// The side that is fed: 0 head, 1 rod; `None` in neutral.
    pub fed: Option<usize>,
    /// From the gallery to it: flow and slopes by the gallery's and the side's pressure.
    pub feed: f64,
    /// ∂feed/∂gallery.
    pub feed_by_gallery: f64,
    /// −∂feed/∂side.
    pub feed_by_side: f64,
    /// Both sides.
    pub sides: [SideFlows; 2],
    /// From head to rod past the piston.
    pub across: f64,
}

/// What surrounds a function: absolute pressures, Pa.
#[derive(Clone, Copy, Debug)]
pub(super) struct Around {
    /// Of the gallery.
    pub gallery_pa: f64,
    /// Of the return line.
    pub tank_pa: f64,
    /// The highest load as it is sensed.
    pub highest_pa: f64,
}

/// A function with its edges' constants.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Function {
    /// The model.
    pub model: FunctionModel,
    /// Pump and sharing, for the pressure drop over the metering edge.
    pump: PumpModel,
    /// Conductance of the fully open inlet edge.
    meter_in: [f64; 2],
    /// Port relief: the larger inflow at 5 % above the setting, m³/s/Pa.
    relief_gain: f64,
    /// Anti-cavitation: twice the larger inflow at 0.2 MPa, m³/s/√Pa.
    make_up: f64,
}

impl Function {
    /// The constants of a model behind this pump.
    pub(super) fn new(model: &FunctionModel, pump: &PumpModel) -> Self {
        let [extend, retract] = model.meter_in_m3ps;
        let larger = if extend > retract { extend } else { retract };
        Self {
            model: *model,
            pump: *pump,
            meter_in: model.meter_in_m3ps.map(|flow| conductance(flow, pump.metering_drop_pa())),
            relief_gain: larger / (0.05 * model.port_relief_pa),
            make_up: conductance(2.0 * larger, 2e5),
        }
    }

    /// The opening of a spool place, and the side it feeds.
    pub(super) fn opened(&self, place: f64) -> Option<(usize, f64)> {
        let (fed, travel) = if place > 0.0 { (0, place) } else { (1, -place) };
        let open = opening(travel, self.model.dead_band[fed], self.model.fine);
        (open > 0.0).then_some((fed, open))
    }

    /// Flows at these pressures with `opened` the spool's opening and `ends_m` the way left to retracted and extended stop.
    pub(super) fn flows(
        &self,
        opened: Option<(usize, f64)>,
        pressures: [f64; 2],
        around: &Around,
        ends_m: [f64; 2],
    ) -> FunctionFlows {
        let model = &self.model;
        let mut flows =
            FunctionFlows { across: model.piston_leak * (pressures[0] - pressures[1]), ..Default::default() };
        for (c, (side, pressure)) in flows.sides.iter_mut().zip(pressures).enumerate() {
            let over_tank = pressure - around.tank_pa;
            side.leak = Flow { flow: model.spool_leak * over_tank, slope: model.spool_leak };
            side.make_up = check(self.make_up, -over_tank);
            // Extending empties the rod side towards the extended end, and the other way round.
            let gap = model.cushions[c].gap(ends_m[c]);
            let edge = opened.filter(|&(fed, _)| fed != c).map_or(0.0, |(fed, open)| open * model.meter_out[fed]);
            side.out = orifice(in_series(edge, gap), over_tank);
            // What the open edge leaves of the drop at the port, where the relief valve sits.
            let at_port = 1.0 / (1.0 + (edge / gap) * (edge / gap));
            let port_pa = around.tank_pa + at_port * over_tank - ATMOSPHERE_PA;
            side.relief = relief_behind(gap, self.relief_gain, port_pa, model.port_relief_pa);
            side.relief.slope *= at_port;
        }
        let Some((fed, open)) = opened else { return flows };
        flows.fed = Some(fed);
        // The load-holding check valve lets nothing back into the gallery.
        if around.gallery_pa > pressures[fed] {
            let (drop, by_gallery, by_side) = self.pump.drop(around.gallery_pa, pressures[fed], around.highest_pa);
            let feed = check(open * self.meter_in[fed], drop);
            let slope = |moves: bool| if moves { feed.slope } else { 0.0 };
            (flows.feed, flows.feed_by_gallery, flows.feed_by_side) = (feed.flow, slope(by_gallery), slope(by_side));
        }
        flows
    }
}

impl Chamber {
    /// A chamber of this volume at this absolute pressure.
    pub(super) fn filled(oil: &Oil, volume_m3: f64, pressure_pa: f64) -> Self {
        Self { content_m3: oil.content_m3(volume_m3, pressure_pa), pressure_pa }
    }
}
