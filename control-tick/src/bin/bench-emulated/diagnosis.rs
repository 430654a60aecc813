//! The diagnosis of all four actuators: in healthy motion, and at rest.

use core::hint::black_box;

use firmware::Fault;
use firmware::diagnosis::{Diagnosis, DiagnosisParameters, NO_PRESSURES, Pressures};
use firmware::io::Speeds;
use firmware::sensing::SensorView;

use crate::bench::{Out, row};
use crate::emulated::stopwatch::Stopwatch;

type Tick = ([u16; 4], Pressures, Speeds);

#[inline(never)]
fn judge(diagnosis: &mut Diagnosis, (codes, pressures, sent): &Tick) -> Option<Fault> {
    diagnosis.judge(codes, pressures);
    let fault = diagnosis.fault();
    diagnosis.sent(sent);
    fault
}

pub(crate) fn diagnosis(out: &mut Out, stopwatch: &Stopwatch) {
    let parameters = DiagnosisParameters::of_full_speeds([[0.4; 2]; 4]);
    // 20 µm a code: 20 codes a tick at full speed.
    let mut diagnosis = black_box(Diagnosis::new(&parameters, [SensorView { unit: 2e-5, stops: [0, u16::MAX] }; 4]));
    let at = |code: f32, speed: f32| -> Tick { ([code as u16; 4], NO_PRESSURES, Speeds::from_array([speed; 4])) };
    row(out, stopwatch, "diagnosis_moving", |t| at(20_000.0 + 2000.0 * t, 0.4), |tick| judge(&mut diagnosis, tick));
    for _ in 0..5000 {
        judge(&mut diagnosis, &at(22_000.0, 0.0));
    }
    // Noise of some codes.
    row(
        out,
        stopwatch,
        "diagnosis_at_rest",
        |t| at(22_000.0 + 707.0 * t % 7.0, 0.0),
        |tick| judge(&mut diagnosis, tick),
    );
}
