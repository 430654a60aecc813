//! What the linked ARM images are made of: no fused multiply-add, which would round once where the host rounds twice, and no
//! panic in the control loop.

use hil_sim::place::Image;
use object::read::elf::{ElfFile32, ProgramHeader};
use object::{Endianness, Object, ObjectSection, ObjectSymbol, SectionKind};

/// A Thumb instruction's halfwords; the second is 0 for a short one.
type Instruction = (u16, u16);

/// VFMA, VFMS, VFNMA, VFNMS (ARM DDI 0403E, A7.7.228, A7.7.230): coprocessor 10 or 11, opcodes 1D01 and 1D10.
fn is_fused_multiply_add((first, second): Instruction) -> bool {
    let coprocessor = second & 0x0e10 == 0x0a00;
    (first & 0xffb0 == 0xee90 || first & 0xffb0 == 0xeea0) && coprocessor
}

/// Any VFP multiply or addition: shows that the scan sees floating-point code at all.
fn is_float_multiply((first, second): Instruction) -> bool {
    first & 0xffb0 == 0xee20 && second & 0x0e50 == 0x0a00
}

/// Every Thumb instruction of the ELF's code with its address, data between it left out by the mapping symbols `$t` and `$d`.
fn instructions(elf: &[u8]) -> Vec<(u64, Instruction)> {
    let file = object::File::parse(elf).expect("an ELF");
    let mut marks: Vec<(u64, bool)> = file
        .symbols()
        .filter_map(|symbol| match symbol.name().ok()?.get(..2)? {
            "$t" => Some((symbol.address() & !1, true)),
            "$d" => Some((symbol.address() & !1, false)),
            _ => None,
        })
        .collect();
    marks.sort_unstable();
    assert!(!marks.is_empty(), "no mapping symbols: the image was stripped");
    let mut found = Vec::new();
    for section in file.sections().filter(|section| section.kind() == SectionKind::Text) {
        let bytes = section.data().expect("the section's bytes");
        let halfword = |at: usize| bytes.get(at..at + 2).map(|b| u16::from_le_bytes([b[0], b[1]]));
        let mut at = 0;
        while let Some(first) = halfword(at) {
            let address = section.address() + at as u64;
            let before = marks.partition_point(|&(mark, _)| mark <= address);
            let is_code = before > 0 && marks[before - 1].1;
            if !is_code {
                at += 2;
                continue;
            }
            // Halfwords from 0b11101 upwards begin an instruction of two.
            let long = first >> 11 >= 0b11101;
            found.push((address, (first, if long { halfword(at + 2).unwrap_or(0) } else { 0 })));
            at += if long { 4 } else { 2 };
        }
    }
    found
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
    for name in ["ecu-emulated", "bench-emulated"] {
        let image = Image::build(name).unwrap_or_else(|error| panic!("{error}"));
        let elf = std::fs::read(&image.path).expect("the image");
        let all = instructions(&elf);
        let multiplies = all.iter().filter(|&&(_, i)| is_float_multiply(i)).count();
        let fused = all.iter().filter(|&&(_, i)| is_fused_multiply_add(i)).count();
        println!("{name}: {} instructions, {multiplies} float multiplies, {fused} fused", all.len());
        assert!(multiplies > 50, "{name}: the scan misses the floating-point code");
        assert_eq!(fused, 0, "{name}");
    }
}

/// The calls (BL) and long jumps (B.W) of the code, from where and to where.
fn calls(elf: &[u8]) -> Vec<(u64, u64)> {
    let jump = |&(at, (first, second)): &(u64, Instruction)| {
        let is_jump = first & 0xf800 == 0xf000 && matches!(second & 0xd000, 0x9000 | 0xd000);
        let bit = |half: u16, n: u32| u32::from(half >> n & 1);
        let (sign, j1, j2) = (bit(first, 10), bit(second, 13), bit(second, 11));
        let offset = sign << 24
            | (1 ^ j1 ^ sign) << 23
            | (1 ^ j2 ^ sign) << 22
            | u32::from(first & 0x3ff) << 12
            | u32::from(second & 0x7ff) << 1;
        let offset = i64::from((offset << 7).cast_signed() >> 7);
        is_jump.then(|| (at, (at + 4).wrapping_add_signed(offset)))
    };
    instructions(elf).iter().filter_map(jump).collect()
}

/// The functions of the ELF, by address, under their mangled names.
fn functions(elf: &[u8]) -> Vec<(u64, String)> {
    let file = object::File::parse(elf).expect("an ELF");
    let named = |symbol: object::Symbol<'_, '_>| Some((symbol.address() & !1, symbol.name().ok()?.to_owned()));
    let is_mark = |name: &str| name.starts_with('$');
    let mut all: Vec<_> = file
        .symbols()
        .filter(|symbol| symbol.kind() == object::SymbolKind::Text)
        .filter_map(named)
        .filter(|(_, name)| !is_mark(name))
        .collect();
    all.sort_unstable();
    all
}

#[test]
#[ignore = "needs the emulator: run cargo xtask test"]
fn nothing_but_the_writing_of_messages_can_panic_in_the_control_image() {
    let image = Image::build("ecu-emulated").unwrap_or_else(|error| panic!("{error}"));
    let elf = std::fs::read(&image.path).expect("the image");
    let functions = functions(&elf);
    let holding = |at: u64| {
        let after = functions.partition_point(|&(start, _)| start <= at);
        functions[..after].last().map_or("", |(_, name)| name.as_str())
    };
    let panics = |name: &str| name.contains("9panicking") || name.contains("16slice_index_fail");
    // Core's own number formatting, which writes the refusal of a parameter record before the loop begins.
    let is_core = |name: &str| name.contains("4core3fmt") || name.contains("4core3num") || panics(name);
    let into_panics: Vec<_> = calls(&elf).into_iter().filter(|&(_, to)| panics(holding(to))).collect();
    assert!(into_panics.len() > 10, "the scan misses core's own panics: {into_panics:?}");
    for (from, to) in into_panics {
        assert!(is_core(holding(from)), "{} calls {}", holding(from), holding(to));
    }
}

/// Where the parameters stand (memory.x): sectors 2 and 3 of the STM32F405.
const PARAMETERS: std::ops::Range<u64> = 0x0800_8000..0x0801_0000;

#[test]
#[ignore = "needs the emulator: run cargo xtask test"]
fn no_image_loads_a_byte_into_the_parameters_sectors() {
    for name in ["ecu-emulated", "bench-emulated"] {
        let image = Image::build(name).unwrap_or_else(|error| panic!("{error}"));
        let elf = std::fs::read(&image.path).expect("the image");
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
