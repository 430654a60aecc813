//! d
use hil_sim::machine_file::MachineFile;
use hil_sim::scenes::*;
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let f = MachineFile::load(&a[1]).unwrap();
    let k = Kit::new(&f.geometry).unwrap();
    let s = k.scene(1, a[2].parse().unwrap());
    let d = |j: [kinematics_core::Rotor<f64>; 4]| j.map(|r| (r.angle().to_degrees() * 10.0).round() / 10.0);
    println!("start {:?} pose {:?} target {:?} tip {:?}", d(s.start), d(s.pose), s.target, k.tip(&s.pose));
    println!("{:?} careless {}", s.obstacles, s.careless);
    println!("start clear {} pose clear {}", k.clearance(&s.start, &s.obstacles), k.clearance(&s.pose, &s.obstacles));
    let p32 = s.pose.map(|r| kinematics_core::Rotor { cos: r.cos as f32, sin: r.sin as f32 });
    println!("within {} {:?}", k.avoid.within_travel(&k.avoid.aim(&p32)), k.avoid.aim(&p32));
    let mut n = 0;
    let mut last = 9.0;
    let o = k.play(&s, |x| {
        if x.clearance_m < 0.02 * f.geometry.reach_m() || n % 25 == 0 {
            if n < 4000 && (last > 0.0) {
                println!("{:.2} {:?} {:.3}", x.time_s, d(x.joints), x.clearance_m);
            }
        }
        last = x.clearance_m;
        n += 1;
    });
    println!("{:?}", o);
}
