//! The oil of the whole machine: one gallery behind the pump, two chambers a function, one linearly implicit sub-step.
//!
//! Openings are stiff: a small chamber behind a wide edge settles within a fraction of a millisecond. Each sub-step takes every flow with its
//! slope, solves the pressures' changes at once (the gallery couples the functions, so the system is an arrow), and moves the same flows out of
//! one place and into the next. So oil is conserved to rounding, whatever the step.

// Functions and sides index several arrays at once.
#![allow(clippy::needless_range_loop)]

use super::function::{Around, Chamber, Function, FunctionFlows};
use super::ledger::{Ledger, Observer, Path};
use super::metering::{Flow, relief};
use super::oil::{ATMOSPHERE_PA, Oil};
use super::pump::{Demand, Pump, PumpModel};

/// The oil and where it is.
#[derive(Clone, Debug)]
pub(super) struct Circuit {
    oil: Oil,
    model: PumpModel,
    tank_pa: f64,
    /// The pump.
    pub pump: Pump,
    /// Oil between pump and valves.
    pub gallery: Chamber,
    /// Head and rod side of swing, boom, arm, bucket.
    pub chambers: [[Chamber; 2]; 4],
}

/// What the mechanics say of a function at the beginning of a sub-step.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Motion {
    /// Volumes of head and rod side, m³.
    pub volumes_m3: [f64; 2],
    /// Their growth, m³/s.
    pub growth_m3ps: [f64; 2],
    /// The spool's opening and the side it feeds.
    pub opened: Option<(usize, f64)>,
    /// To the retracted and the extended stop, m.
    pub ends_m: [f64; 2],
}

/// How much of a sub-step's change of pressure a flow is taken at: a half would be exact to the second order, one the most damped.
const WEIGHT: f64 = 0.6;

impl FunctionFlows {
    /// The slopes as a sub-step takes them.
    fn weighted(mut self) -> Self {
        self.feed_by_gallery *= WEIGHT;
        self.feed_by_side *= WEIGHT;
        for side in &mut self.sides {
            for flow in [&mut side.out, &mut side.leak, &mut side.relief, &mut side.make_up] {
                flow.slope *= WEIGHT;
            }
        }
        self
    }
}

/// dp/dN and −dp/dV of a volume.
fn stiffness(oil: &Oil, chamber: &Chamber, volume_m3: f64) -> (f64, f64) {
    let by_volume = 1.0 / (chamber.content_m3 * oil.compressibility(chamber.pressure_pa));
    (by_volume * volume_m3 / chamber.content_m3, by_volume)
}

/// A flow after a change of the pressure that drives it; a valve that closes lets nothing back.
fn after(flow: Flow, change: f64) -> f64 {
    let flow = flow.flow + flow.slope * change;
    if flow > 0.0 { flow } else { 0.0 }
}

impl Circuit {
    /// At rest with these absolute pressures.
    pub(super) fn new(
        oil: Oil,
        model: PumpModel,
        tank_pa: f64,
        volumes: [[f64; 2]; 4],
        pressures: [[f64; 2]; 4],
    ) -> Self {
        let chamber = |f: usize, c: usize| Chamber::filled(&oil, volumes[f][c], pressures[f][c]);
        let stand_by = ATMOSPHERE_PA + model.margin_pa;
        Self {
            oil,
            model,
            tank_pa,
            pump: Pump { flow_m3ps: 0.0, sensed_pa: 0.0 },
            gallery: Chamber::filled(&oil, model.volume_m3, stand_by),
            chambers: [0, 1, 2, 3].map(|f| [chamber(f, 0), chamber(f, 1)]),
        }
    }

    /// Absolute pressures of a function's sides now, Pa.
    pub(super) fn pressures(&self, function: usize) -> [f64; 2] {
        self.chambers[function].map(|chamber| chamber.pressure_pa)
    }

    /// Pressures of a function's sides from their content and these volumes.
    pub(super) fn settle(&mut self, function: usize, volumes_m3: [f64; 2]) {
        for (chamber, volume) in self.chambers[function].iter_mut().zip(volumes_m3) {
            chamber.pressure_pa = self.oil.pressure_pa(chamber.content_m3, volume);
        }
    }

    /// v(p) of this oil.
    pub(super) fn specific_volume(&self, pressure_pa: f64) -> f64 {
        self.oil.specific_volume(pressure_pa)
    }

    /// An empty ledger for this oil.
    pub(super) fn ledger(&self) -> Ledger {
        Ledger::new(self.oil, self.tank_pa)
    }

    fn everywhere(&self) -> impl Iterator<Item = &Chamber> {
        self.chambers.iter().flatten().chain([&self.gallery])
    }

    /// Oil in gallery and chambers, m³ at atmospheric pressure.
    pub(super) fn content_m3(&self) -> f64 {
        self.everywhere().map(|chamber| chamber.content_m3).sum()
    }

    /// Its energy above what it had in the tank, J.
    pub(super) fn energy_j(&self) -> f64 {
        let ledger = self.ledger();
        self.everywhere().map(|chamber| ledger.stored_j(chamber.content_m3, chamber.pressure_pa)).sum()
    }

    /// Moves the oil of one sub-step of `h` seconds; the pressures stay until the volumes have followed ([`Circuit::settle`]).
    pub(super) fn step(&mut self, functions: &[Function; 4], motion: &[Motion; 4], h: f64) -> Moved {
        // The pump sees the highest load; what it makes of it holds from half a sub-step ago to half a sub-step ahead, as the rates do.
        let mut highest = 0.0;
        for (f, motion) in motion.iter().enumerate() {
            let load = motion.opened.map_or(0.0, |(side, _)| self.chambers[f][side].pressure_pa - ATMOSPHERE_PA);
            highest = if load > highest { load } else { highest };
        }
        self.pump.sense(&self.model, highest, h);
        let around = Around {
            gallery_pa: self.gallery.pressure_pa,
            tank_pa: self.tank_pa,
            highest_pa: ATMOSPHERE_PA + self.pump.sensed_pa,
        };
        let flows: [FunctionFlows; 4] =
            [0, 1, 2, 3].map(|f| functions[f].flows(motion[f].opened, self.pressures(f), &around, motion[f].ends_m));
        let taken: f64 = flows.iter().map(|flow| flow.feed).sum();
        let slope: f64 = flows.iter().map(|flow| flow.feed_by_gallery).sum();
        let (by_content, _) = stiffness(&self.oil, &self.gallery, self.model.volume_m3);
        let over = around.gallery_pa - ATMOSPHERE_PA;
        let demand = Demand { gallery_pa: over, capacity: 1.0 / by_content, taken, slope };
        self.pump.advance(&self.model, &demand, h);
        let pumped = self.pump.flow_m3ps;
        let mut spilled = relief(self.model.relief_gain(), over, self.model.supply_pa);
        spilled.slope *= WEIGHT;
        let flows = flows.map(FunctionFlows::weighted);

        // Changes of the chambers' pressures: what comes of their own, and what of the gallery's change.
        let mut own = [[0.0; 2]; 4];
        let mut coupled = [0.0; 4];
        let (mut drawn, mut stiff) = (taken + spilled.flow, spilled.slope);
        for f in 0..4 {
            for c in 0..2 {
                let (chamber, side) = (&self.chambers[f][c], &flows[f].sides[c]);
                let (by_content, by_volume) = stiffness(&self.oil, chamber, motion[f].volumes_m3[c]);
                let fed = flows[f].fed == Some(c);
                let across = if c == 0 { -flows[f].across } else { flows[f].across };
                let (feed, feed_slope) = if fed { (flows[f].feed, flows[f].feed_by_side) } else { (0.0, 0.0) };
                let inflow = feed + across + side.make_up.flow - side.out.flow - side.leak.flow - side.relief.flow;
                let slope = feed_slope + side.make_up.slope + side.out.slope + side.leak.slope + side.relief.slope;
                let divisor = 1.0 / (1.0 + h * by_content * slope);
                own[f][c] = h * (by_content * inflow - by_volume * motion[f].growth_m3ps[c]) * divisor;
                if fed {
                    coupled[f] = h * by_content * flows[f].feed_by_gallery * divisor;
                    drawn -= feed_slope * own[f][c];
                    stiff += flows[f].feed_by_gallery - feed_slope * coupled[f];
                }
            }
        }
        let gallery = h * by_content * (pumped - drawn) / (1.0 + h * by_content * stiff);

        let mut moved = Moved {
            pumped: h * pumped,
            spilled: h * after(spilled, gallery),
            fed: flows.map(|flow| flow.fed),
            ..Moved::of(self)
        };
        for f in 0..4 {
            moved.across[f] = h * flows[f].across;
            for c in 0..2 {
                let side = &flows[f].sides[c];
                let fed = flows[f].fed == Some(c);
                let change = own[f][c] + if fed { coupled[f] * gallery } else { 0.0 };
                if fed {
                    let feed = flows[f].feed + flows[f].feed_by_gallery * gallery - flows[f].feed_by_side * change;
                    moved.feeds[f] = if feed > 0.0 { h * feed } else { 0.0 };
                }
                let sides = SidesMoved {
                    out: h * (side.out.flow + side.out.slope * change),
                    leak: h * (side.leak.flow + side.leak.slope * change),
                    relief: h * after(side.relief, change),
                    make_up: h * after(side.make_up, -change),
                };
                let across = if c == 0 { -moved.across[f] } else { moved.across[f] };
                let fed = if fed { moved.feeds[f] } else { 0.0 };
                self.chambers[f][c].content_m3 += fed + across + sides.make_up - sides.out - sides.leak - sides.relief;
                moved.sides[f][c] = sides;
            }
        }
        let given: f64 = moved.feeds.iter().sum();
        self.gallery.content_m3 += moved.pumped - given - moved.spilled;
        self.gallery.pressure_pa = self.oil.pressure_pa(self.gallery.content_m3, self.model.volume_m3);
        moved
    }

    /// Tells an observer of what a sub-step moved, each flow at the mean of the pressures before and after.
    pub(super) fn report<O: Observer>(&self, moved: &Moved, observer: &mut O) {
        let mean = |a: f64, b: f64| 0.5 * (a + b);
        let gallery = mean(moved.gallery_pa, self.gallery.pressure_pa);
        observer.flow(Path::Pump, self.tank_pa, gallery, moved.pumped);
        observer.flow(Path::MainRelief, gallery, self.tank_pa, moved.spilled);
        for f in 0..4 {
            let side = |c: usize| mean(moved.pressures[f][c], self.chambers[f][c].pressure_pa);
            if let Some(fed) = moved.fed[f] {
                observer.flow(Path::MeterIn, gallery, side(fed), moved.feeds[f]);
            }
            observer.flow(Path::PistonLeak, side(0), side(1), moved.across[f]);
            for c in 0..2 {
                let sides = &moved.sides[f][c];
                observer.flow(Path::MeterOut, side(c), self.tank_pa, sides.out);
                observer.flow(Path::SpoolLeak, side(c), self.tank_pa, sides.leak);
                observer.flow(Path::PortRelief, side(c), self.tank_pa, sides.relief);
                observer.flow(Path::MakeUp, self.tank_pa, side(c), sides.make_up);
            }
        }
    }
}

/// Content that went in a sub-step, m³, and the absolute pressures before it, Pa.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moved {
    pumped: f64,
    spilled: f64,
    fed: [Option<usize>; 4],
    feeds: [f64; 4],
    across: [f64; 4],
    sides: [[SidesMoved; 2]; 4],
    gallery_pa: f64,
    pressures: [[f64; 2]; 4],
}

/// Of one side, to the tank and from it.
#[derive(Clone, Copy, Debug, Default)]
struct SidesMoved {
    out: f64,
    leak: f64,
    relief: f64,
    make_up: f64,
}

impl Moved {
    /// Nothing yet.
    fn of(circuit: &Circuit) -> Self {
        Self {
            pumped: 0.0,
            spilled: 0.0,
            fed: [None; 4],
            feeds: [0.0; 4],
            across: [0.0; 4],
            sides: [[SidesMoved::default(); 2]; 4],
            gallery_pa: circuit.gallery.pressure_pa,
            pressures: circuit.chambers.map(|pair| pair.map(|chamber| chamber.pressure_pa)),
        }
    }
}
