//! Cycle times of the 20 t class.

use cross_tests::plant::*;

#[test]
fn explore() {
    let m = model("zx200");
    for (name, f, d, start) in [
        ("boom up", BOOM, 1.0, [0.0, 0.5, 0.5]),
        ("boom down", BOOM, -1.0, [1.0, 0.5, 0.5]),
        ("arm in", ARM, 1.0, [0.7, 0.0, 0.5]),
        ("arm out", ARM, -1.0, [0.7, 1.0, 0.5]),
        ("bucket in", BUCKET, 1.0, [0.7, 0.5, 0.0]),
        ("bucket out", BUCKET, -1.0, [0.7, 0.5, 1.0]),
    ] {
        let mut p = at(&m, shares(&m, start));
        println!("{name}: start {:?} {:?}", p.positions(), p.pressures_pa());
        let c = currents(&m, lever(f, d));
        for t in 0..6000 {
            p.step(c);
            if t % 250 == 249 {
                println!("{:5} pos {:?} v {:.3} p {:.2?} pump {:.2} {:.1} {:?}", t + 1, p.positions()[f], p.velocities()[f],
                    p.pressures_pa()[f - 1].map(|x| x * 1e-6), p.pump_pressure_pa() * 1e-6, p.pump_flow_m3ps() * 6e4, p.against_stops());
            }
            if p.against_stops()[f] && t > 300 { println!("stop at {t}"); break; }
        }
    }
    let mut p = at(&m, shares(&m, [0.5, 0.5, 0.5]));
    let t = std::time::Instant::now();
    run(&mut p, &m, [0.0; 4], 20000);
    println!("rest {:.2} us/ms", t.elapsed().as_secs_f64() / 20000.0 * 1e6);
    let mut p = at(&m, shares(&m, [0.1, 0.5, 0.5]));
    let t = std::time::Instant::now();
    run(&mut p, &m, [0.3; 4], 2000);
    println!("moving {:.2} us/ms", t.elapsed().as_secs_f64() / 2000.0 * 1e6);
}
