//! The few Thumb instructions that tell where a function goes and what stack it takes (ARM DDI 0403E, A7.7).

/// An instruction's halfwords; the second is 0 for a short one.
pub type Instruction = (u16, u16);

/// What an instruction means for the call graph and the stack.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Meaning {
    /// BL: another function, and back.
    Call(u64),
    /// A branch: inside the function, or a tail call.
    Jump(u64),
    /// BLX or BX of a register that is not the return address: a function pointer or a vtable.
    Indirect,
    /// So many bytes of stack are taken.
    Takes(u32),
    /// The stack pointer is lowered by a register.
    TakesRegister(u8),
    /// A register is loaded with a constant.
    Constant(u8, u32),
    /// Nothing of interest.
    Other,
}

/// Meaning of the instruction at an address.
pub fn meaning(at: u64, (first, second): Instruction) -> Meaning {
    if first >> 11 < 0b11101 { short(at, first) } else { long(at, first, second) }
}

fn target(at: u64, offset: i32) -> u64 {
    (at + 4).wrapping_add_signed(offset.into())
}

/// The lowest `bits` of a number with sign.
fn signed(value: u32, bits: u32) -> i32 {
    (value << (32 - bits)).cast_signed() >> (32 - bits)
}

fn short(at: u64, i: u16) -> Meaning {
    let word = u32::from(i);
    match i {
        // PUSH: eight low registers and LR.
        _ if i & 0xfe00 == 0xb400 => Meaning::Takes(4 * (word & 0x1ff).count_ones()),
        // SUB SP, #imm7
        _ if i & 0xff80 == 0xb080 => Meaning::Takes(4 * (word & 0x7f)),
        // B
        _ if i & 0xf800 == 0xe000 => Meaning::Jump(target(at, signed(word << 1, 12))),
        // B on condition; 14 and 15 are UDF and SVC.
        _ if i & 0xf000 == 0xd000 && i & 0x0e00 != 0x0e00 => Meaning::Jump(target(at, signed(word << 1, 9))),
        // BX LR returns; BX and BLX of anything else, and MOV to PC, go where a register says.
        0x4770 => Meaning::Other,
        _ if i & 0xff07 == 0x4700 || i & 0xff87 == 0x4687 => Meaning::Indirect,
        // MOV Rd, #imm8
        _ if i & 0xf800 == 0x2000 => Meaning::Constant((i >> 8 & 7) as u8, word & 0xff),
        _ => Meaning::Other,
    }
}

fn long(at: u64, first: u16, second: u16) -> Meaning {
    let (high, low) = (u32::from(first), u32::from(second));
    let bit = |word: u32, n: u32| word >> n & 1;
    if first & 0xf800 == 0xf000 && second & 0x8000 != 0 {
        let (sign, j1, j2) = (bit(high, 10), bit(low, 13), bit(low, 11));
        let far =
            sign << 24 | (1 ^ j1 ^ sign) << 23 | (1 ^ j2 ^ sign) << 22 | (high & 0x3ff) << 12 | (low & 0x7ff) << 1;
        let near = sign << 20 | j2 << 19 | j1 << 18 | (high & 0x3f) << 12 | (low & 0x7ff) << 1;
        return match second & 0xd000 {
            0xd000 => Meaning::Call(target(at, signed(far, 25))),
            0x9000 => Meaning::Jump(target(at, signed(far, 25))),
            // Conditions 14 and 15 are system instructions.
            0x8000 if high >> 6 & 0xf < 14 => Meaning::Jump(target(at, signed(near, 21))),
            _ => Meaning::Other,
        };
    }
    let immediate = bit(high, 10) << 11 | (low >> 12 & 7) << 8 | low & 0xff;
    let to = (second >> 8 & 0xf) as u8;
    match first {
        // PUSH.W; STR and STRD before SP; VPUSH
        0xe92d => Meaning::Takes(4 * low.count_ones()),
        0xf84d if second & 0x0f00 == 0x0d00 => Meaning::Takes(low & 0xff),
        0xe96d => Meaning::Takes(4 * (low & 0xff)),
        _ if first & 0xffbf == 0xed2d => Meaning::Takes(4 * (low & 0xff)),
        // SUB.W SP, SP, #const and SUBW SP, SP, #imm12
        _ if first & 0xfbef == 0xf1ad && second & 0x8f00 == 0x0d00 => Meaning::Takes(expanded(immediate)),
        _ if first & 0xfbff == 0xf2ad && second & 0x8f00 == 0x0d00 => Meaning::Takes(immediate),
        // SUB.W SP, SP, Rm
        0xebad if second & 0x0f00 == 0x0d00 => Meaning::TakesRegister((second & 0xf) as u8),
        // MOVW, MOV.W
        _ if first & 0xfbf0 == 0xf240 && second & 0x8000 == 0 => Meaning::Constant(to, (high & 0xf) << 12 | immediate),
        _ if first & 0xfbef == 0xf04f && second & 0x8000 == 0 => Meaning::Constant(to, expanded(immediate)),
        // LDR to PC
        _ if first & 0xff70 == 0xf850 && second >> 12 == 0xf => Meaning::Indirect,
        _ => Meaning::Other,
    }
}

/// A modified immediate constant (A5.3.2).
fn expanded(immediate: u32) -> u32 {
    let byte = immediate & 0xff;
    match immediate >> 8 {
        0 => byte,
        1 => byte << 16 | byte,
        2 => byte << 24 | byte << 8,
        3 => byte * 0x0101_0101,
        _ => (0x80 | byte & 0x7f).rotate_right(immediate >> 7),
    }
}

#[cfg(test)]
mod tests {
    use super::{Meaning, meaning};

    #[test]
    fn stack_taken_is_read_from_the_prologues_instructions() {
        // As the assembler encodes them.
        for (instruction, bytes) in [
            ((0xb5f0, 0), 20),          // push {r4-r7, lr}
            ((0xe92d, 0x0f00), 16),     // push.w {r8-r11}
            ((0xf84d, 0xbd04), 4),      // str r11, [sp, #-4]!
            ((0xed2d, 0x8b06), 24),     // vpush {d8-d10}
            ((0xb084, 0), 16),          // sub sp, #16
            ((0xf5ad, 0x7d04), 528),    // sub.w sp, sp, #528
            ((0xf6ad, 0x2d84), 0xa84),  // subw sp, sp, #2692
            ((0xf5ad, 0x4de0), 0x7000), // sub.w sp, sp, #28672
        ] {
            assert_eq!(meaning(0, instruction), Meaning::Takes(bytes), "{instruction:04x?}");
        }
        assert_eq!(meaning(0, (0xebad, 0x0d04)), Meaning::TakesRegister(4));
        assert_eq!(meaning(0, (0xf241, 0x5404)), Meaning::Constant(4, 0x1504));
        // add sp, #16; sub.w sp, r7, #16
        assert_eq!(meaning(0, (0xb004, 0)), Meaning::Other);
        assert_eq!(meaning(0, (0xf1a7, 0x0d10)), Meaning::Other);
    }

    #[test]
    fn branches_lead_where_the_assembler_sends_them() {
        assert_eq!(meaning(0x100, (0xf000, 0xf806)), Meaning::Call(0x110));
        assert_eq!(meaning(0x100, (0xf7ff, 0xfffe)), Meaning::Call(0x100));
        assert_eq!(meaning(0x100, (0xf000, 0xb806)), Meaning::Jump(0x110));
        assert_eq!(meaning(0x100, (0xf000, 0x8006)), Meaning::Jump(0x110));
        assert_eq!(meaning(0x100, (0xe7fe, 0)), Meaning::Jump(0x100));
        assert_eq!(meaning(0x100, (0xd0fe, 0)), Meaning::Jump(0x100));
        assert_eq!(meaning(0, (0x4790, 0)), Meaning::Indirect);
        assert_eq!(meaning(0, (0x4770, 0)), Meaning::Other);
    }
}
