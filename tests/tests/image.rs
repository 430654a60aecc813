//! What the linked ARM images are made of: no fused multiply-add, which would round once where the host rounds twice, and no
//! panic in the control loop.

use hil_sim::elf::{ERRAND, Graph, instructions, thumb::Instruction};
use hil_sim::place::Image;
use object::read::elf::{ElfFile32, ProgramHeader};
use object::{Endianness, Object, ObjectSymbol};

/// VFMA, VFMS, VFNMA, VFNMS (ARM DDI 0403E, A7.7.228, A7.7.230): coprocessor 10 or 11, opcodes 1D01 and 1D10.
fn is_fused_multiply_add((first, second): Instruction) -> bool {
    let coprocessor = second & 0x0e10 == 0x0a00;
    (first & 0xffb0 == 0xee90 || first & 0xffb0 == 0xeea0) && coprocessor
}

/// Any VFP multiply or addition: shows that the scan sees floating-point code at all.
fn is_float_multiply((first, second): Instruction) -> bool {
    first & 0xffb0 == 0xee20 && second & 0x0e50 == 0x0a00
}

#[test]
fn the_scan_knows_the_fused_instructions() {
    // vfma.f32 s0, s1, s2; vfms.f32 s0, s1, s2; vfnma.f32 s0, s1, s2; vfnms.f32 s0, s1, s2, as the assembler encodes them.
    for fused in [(0xeea0, 0x0a81), (0xeea0, 0x0ac1), (0xee90, 0x0ac1), (0xee90, 0x0a81)] {
        assert!(is_fused_multiply_add(fused), "{fused:04x?}");
    }
    // vmul, vadd, vmla, vdiv, vsqrt of the same registers.
    for other in [(0xee20, 0x0a81), (0xee30, 0x0a81), (0xee00, 0x0a81), (0xee80, 0x0a81), (0xeeb1, 0x0ae0)] {
        assert!(!is_fused_multiply_add(other), "{other:04x?}");
    }
    assert!(is_float_multiply((0xee20, 0x0a81)));
}

#[test]
#[ignore = "needs the emulator: run cargo xtask test"]
fn no_image_has_a_fused_multiply_add() {
    for name in ["ecu-stm32f405", "ecu-emulated", "bench-emulated"] {
        let image = Image::build(name).unwrap_or_else(|error| panic!("{error}"));
        let elf = std::fs::read(&image.path).expect("the image");
        let all = instructions(&elf).expect("an image with symbols");
        let multiplies = all.iter().filter(|&&(_, i)| is_float_multiply(i)).count();
        let fused = all.iter().filter(|&&(_, i)| is_fused_multiply_add(i)).count();
        println!("{name}: {} instructions, {multiplies} float multiplies, {fused} fused", all.len());
        assert!(multiplies > 50, "{name}: the scan misses the floating-point code");
        assert_eq!(fused, 0, "{name}");
    }
}

/// The images that run the application, and the interrupt its tick runs in.
const APPLICATIONS: [&str; 2] = ["ecu-stm32f405", "ecu-emulated"];
const TICK: &str = "TIM2";

fn elf(name: &str) -> Vec<u8> {
    let image = Image::build(name).unwrap_or_else(|error| panic!("{error}"));
    std::fs::read(&image.path).expect("the image")
}

fn graph(elf: &[u8]) -> Graph {
    Graph::new(elf).unwrap_or_else(|error| panic!("{error}"))
}

/// Where core's panics begin.
fn panics(name: &str) -> bool {
    ["core::panicking", "slice_index_fail", "unwrap_failed", "expect_failed", "rust_begin_unwind"]
        .iter()
        .any(|part| name.contains(part))
}

#[test]
#[ignore = "needs the emulator: run cargo xtask test"]
fn the_control_task_reaches_no_panic_and_calls_nothing_unknown() {
    for name in APPLICATIONS {
        let graph = graph(&elf(name));
        let tick = graph.reached(graph.named(TICK).expect("the tick"));
        println!("{name}: {} functions from the tick", tick.len());
        assert!(tick.len() > 40, "{name}: the graph misses calls");
        for wanted in ["Ecu<F>::sense_and_follow", "Spool::tick", "Reach<T,_>::tick", "memcpy"] {
            assert!(tick.values().any(|function| function.name.contains(wanted)), "{name}: {wanted}");
        }
        for function in tick.values() {
            assert!(!panics(&function.name), "{name}: the tick reaches {}", function.name);
            // Through a pointer anything might be called.
            assert!(!function.indirect, "{name}: {} calls through a pointer", function.name);
        }
        // There are panics in the image, and the graph sees them: start-up may stop.
        assert!(graph.functions().any(|(_, function)| panics(&function.name)), "{name}");
    }
    let board = graph(&elf("ecu-stm32f405"));
    let start = board.reached(board.named("main").expect("the start"));
    assert!(start.values().any(|function| panics(&function.name)), "the scan misses the HAL's own panics");
}

/// What the core stacks by itself when an interrupt comes: registers, floating-point registers, alignment (ARM DDI 0403E, B1.5.7).
const INTERRUPT_FRAME_BYTES: u32 = 8 * 4 + 18 * 4 + 4;

#[test]
#[ignore = "needs the emulator: run cargo xtask test"]
fn the_stack_has_a_bound_and_room_to_spare() {
    for name in APPLICATIONS {
        let elf = elf(name);
        let graph = graph(&elf);
        let deepest = |root: &str| {
            let deepest =
                graph.named(root).and_then(|root| graph.deepest(root)).unwrap_or_else(|error| panic!("{error}"));
            println!("{name}, {root}: {} bytes", deepest.bytes);
            deepest.bytes
        };
        let (tick, start) = (deepest(TICK) + INTERRUPT_FRAME_BYTES, deepest("main"));
        // The emulated image's exchange with the harness lies on it as well.
        let most = if name == "ecu-stm32f405" { 4096 } else { 4608 };
        assert!(tick <= most, "{name}: {tick} bytes for the tick");
        // What the idle loop runs beside the ticks; only the board's image has a store for it.
        let errand = if name == "ecu-stm32f405" { deepest(ERRAND) } else { 0 };
        assert!(errand <= start, "the idle loop is part of what `main` reaches");

        let file = object::File::parse(&*elf).expect("an ELF");
        let symbol = |wanted: &str| {
            let found = file.symbols().find(|symbol| symbol.name() == Ok(wanted));
            found.unwrap_or_else(|| panic!("{name} has no {wanted}")).address()
        };
        let reserved = symbol("_stack_start") - symbol("_stack_end");
        assert!(reserved > 64 * 1024, "{name}: {reserved} bytes of stack");
        // Start-up is over before the first tick; the idle loop may be interrupted by one, and `main` reaches both.
        let most = u64::from(start + tick);
        assert!(most * 10 <= reserved * 7, "{name}: {most} of {reserved} bytes");
    }
}

#[test]
#[ignore = "needs the emulator: run cargo xtask test"]
fn the_boards_image_keeps_within_its_flash_and_memory() {
    let image = Image::build("ecu-stm32f405").unwrap_or_else(|error| panic!("{error}"));
    println!("{} bytes of flash, {} of static memory", image.flash_bytes, image.ram_bytes);
    // 96 KiB of flash were wanted; docs/porting.md says where it goes, and what the rest cannot do without.
    assert!(image.flash_bytes > 10_000 && image.flash_bytes <= 190 * 1024);
    assert!(image.ram_bytes > 0 && image.ram_bytes <= 24 * 1024);
}

#[test]
#[ignore = "needs the emulator: run cargo xtask test"]
fn the_code_that_waits_for_the_flash_lies_in_ram_and_calls_nothing() {
    for name in ["ecu-stm32f405", "faults-emulated"] {
        let graph = graph(&elf(name));
        let (at, waits) = graph
            .functions()
            .find(|(_, function)| function.name.ends_with("flash::wait_in_ram"))
            .expect("the code that waits");
        println!("{name}: {} bytes at {at:#x}", waits.size);
        let ram = 0x2000_0000..0x2002_0000;
        assert!(waits.size > 40 && ram.contains(&at) && ram.contains(&(at + waits.size)), "{waits:?} at {at:#x}");
        assert!(waits.calls.is_empty() && !waits.indirect, "{waits:?}");
    }
}

#[test]
#[ignore = "needs the emulator: run cargo xtask test"]
fn the_boards_image_fits_buckets_and_writes_its_store_in_the_idle_loop_and_never_in_the_tick() {
    let graph = graph(&elf("ecu-stm32f405"));
    let tick = graph.reached(graph.named(TICK).expect("the tick"));
    let errand = graph.reached(graph.named(ERRAND).expect("the errand"));
    for beside in ["Fitted::fit", "Move::plan", "Store<F>::write", "Store<F>::load", "ParameterFlash::operate"] {
        let named = |function: &&hil_sim::elf::Function| function.name.contains(beside);
        assert!(errand.values().any(named), "the errand does not reach {beside}");
        assert!(!tick.values().any(named), "the tick reaches {beside}");
    }
}

/// Where the parameters stand (memory.x): sectors 2 and 3 of the STM32F405.
const PARAMETERS: std::ops::Range<u64> = 0x0800_8000..0x0801_0000;

#[test]
#[ignore = "needs the emulator: run cargo xtask test"]
fn no_image_loads_a_byte_into_the_parameters_sectors() {
    for name in ["ecu-stm32f405", "ecu-emulated", "bench-emulated"] {
        let elf = elf(name);
        let file = ElfFile32::<Endianness>::parse(&*elf).expect("an ELF of 32 bits");
        let endian = file.endian();
        let loaded: Vec<(u64, u64)> = file
            .elf_program_headers()
            .iter()
            .filter(|header| header.p_type(endian) == object::elf::PT_LOAD && header.p_filesz(endian) > 0)
            .map(|header| (header.p_paddr(endian).into(), header.p_filesz(endian).into()))
            .collect();
        assert!(loaded.iter().any(|&(from, _)| from == 0x0800_0000), "{name}: the vectors stand in sector 0");
        assert!(loaded.iter().any(|&(from, _)| from >= PARAMETERS.end), "{name}: the code stands behind them");
        for (from, bytes) in loaded {
            assert!(from + bytes <= PARAMETERS.start || from >= PARAMETERS.end, "{name}: {bytes} bytes at {from:#x}");
        }
    }
}
