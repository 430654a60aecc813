//! The fence of whole machines: no random operator carries any part of the linkage past a limit.

use hil_sim::fence::{Kind, campaign};
use hil_sim::machine_file::MachineFile;

#[test]
fn sixty_random_operators_never_carry_the_linkage_past_a_limit_and_a_fence_of_the_tip_alone_lets_them() {
    for name in ["zx200", "frankel"] {
        let machine = MachineFile::load(name).unwrap();
        let [linkage, tip, none] = campaign(&machine, 60, 1, || {}).unwrap();
        assert_eq!((linkage.fence, tip.fence, none.fence), (Kind::Linkage, Kind::Tip, Kind::None));
        assert_eq!(linkage.violated, 0, "{name}: {linkage:?}");
        assert!(linkage.closest_mm > 0.0 && linkage.let_through > 0.3, "{name}: {linkage:?}");
        assert!(tip.violated > 20 && none.violated >= tip.violated, "{name}: {tip:?} {none:?}");
        assert_eq!([linkage.faults, tip.faults, none.faults], [0; 3], "{name}");
        assert_eq!(none.let_through, 1.0, "{name}");
    }
}
