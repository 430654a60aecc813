//! The peer libraries are set up for the same chain: same tip, and back to the same joints.
#![cfg(feature = "peers")]

use bench::peers::Peers;
use bench::seed::double::Dimensions;

const SWING_RAD: f64 = 0.3;

fn joints() -> impl Iterator<Item = [f64; 3]> {
    let strokes = [(29.0, 46.5434), (27.699, 41.9298), (22.0242, 38.6144)];
    let seed = Dimensions::new();
    (1..10).map(move |i| {
        let part = |stride: i32, (min, max): (f64, f64)| min + f64::from(i * stride % 10) / 10.0 * (max - min);
        seed.cyl_to_joint([part(1, strokes[0]), part(3, strokes[1]), part(7, strokes[2])])
    })
}

fn close(a: [f64; 3], b: [f64; 3], within: f64) -> bool {
    let tau = core::f64::consts::TAU;
    a.into_iter().zip(b).all(|(a, b)| {
        let apart = (a - b).rem_euclid(tau);
        apart < within || tau - apart < within
    })
}

#[test]
fn both_put_the_tip_where_the_paper_does() {
    let (peers, seed) = (Peers::new(), Dimensions::new());
    for joints in joints() {
        let tip = seed.jdisp(SWING_RAD, joints);
        for found in [peers.k_tip(SWING_RAD, joints), peers.opw_tip(SWING_RAD, joints)] {
            assert!(tip.into_iter().zip(found).all(|(a, b)| (a - b).abs() < 1e-9), "{tip:?} and {found:?}");
        }
    }
}

#[test]
fn both_find_the_joints_back() {
    let (peers, seed) = (Peers::new(), Dimensions::new());
    let mut found_by_k = 0;
    for joints in joints() {
        let opw = peers.opw_joints(&peers.opw_pose(SWING_RAD, joints)).expect("a solution");
        assert!(close(opw, joints, 1e-9), "{opw:?} for {joints:?}");
        let [x, y, z] = seed.jdisp(SWING_RAD, joints);
        let reach = x * SWING_RAD.cos() + y * SWING_RAD.sin();
        let k = peers.k_joints(SWING_RAD, [reach, z, joints.iter().sum()]);
        found_by_k += usize::from(close(k, joints, 1e-3));
    }
    // It iterates from one start; where it gives up its count is a lower bound.
    println!("k finds {found_by_k} of 9");
    assert!(found_by_k >= 6);
}
