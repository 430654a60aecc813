//! Looks into a linked image. Without the linker script the linker drops everything and still succeeds, so an image
//! counts only when its entry point lies in code that would be loaded.

const MACHINE_ARM: u32 = 40;
const TYPE_EXECUTABLE: u32 = 2;
const SEGMENT_LOAD: u32 = 1;
const FLAG_EXECUTE: u32 = 1;

/// Bytes the image occupies in flash (code, constants, initial values of variables), or what is wrong with it.
///
/// Expects a 32-bit little-endian ARM executable.
pub(crate) fn flash_bytes(file: &[u8]) -> Result<u64, &'static str> {
    const CUT: &str = "the ELF is cut short";
    if file.get(..4) != Some(b"\x7fELF") {
        return Err("this is not an ELF");
    }
    // Class 1: 32 bits; data 1: little-endian.
    if file.get(4..6) != Some(&[1, 1]) || field(file, 18, 2).ok_or(CUT)? != MACHINE_ARM {
        return Err("the ELF is not for a 32-bit little-endian ARM");
    }
    if field(file, 16, 2).ok_or(CUT)? != TYPE_EXECUTABLE {
        return Err("the ELF is not an executable");
    }
    // Bit 0 of the entry point only says Thumb.
    let entry = field(file, 24, 4).ok_or(CUT)? & !1;
    let (table, size, count) = (field(file, 28, 4), field(file, 42, 2), field(file, 44, 2));
    let (table, size, count) = (table.ok_or(CUT)? as usize, size.ok_or(CUT)? as usize, count.ok_or(CUT)? as usize);
    let (mut flash, mut entered) = (0, false);
    for index in 0..count {
        let header = file.get(table + index * size..).ok_or(CUT)?;
        let word = |at| field(header, at, 4).ok_or(CUT);
        let (kind, address, in_file, flags) = (word(0)?, word(8)?, word(16)?, word(24)?);
        if kind == SEGMENT_LOAD {
            flash += u64::from(in_file);
            entered |= flags & FLAG_EXECUTE != 0 && entry.checked_sub(address).is_some_and(|offset| offset < in_file);
        }
    }
    match (flash, entered) {
        (0, _) => Err("the image is empty: nothing in it would be loaded (are images/build.rs's link arguments used?)"),
        (_, false) => Err("the entry point is not in loaded code (are images/build.rs's link arguments used?)"),
        (flash, true) => Ok(flash),
    }
}

/// A little-endian number of up to four bytes.
fn field(bytes: &[u8], at: usize, length: usize) -> Option<u32> {
    let field = bytes.get(at..at.checked_add(length)?)?;
    Some(field.iter().rev().fold(0, |number, &byte| number << 8 | u32::from(byte)))
}

#[cfg(test)]
mod images {
    use super::flash_bytes;

    /// A header for Thumb code entered at `entry`, then one program header for each (type, address, size, flags).
    fn elf(entry: u32, segments: &[(u32, u32, u32, u32)]) -> Vec<u8> {
        let mut file = b"\x7fELF\x01\x01\x01".to_vec();
        file.resize(16, 0);
        file.extend([2, 0, 40, 0, 1, 0, 0, 0]);
        file.extend((entry | 1).to_le_bytes());
        file.extend(52_u32.to_le_bytes());
        file.resize(42, 0);
        file.extend([32, 0, segments.len() as u8, 0]);
        file.resize(52, 0);
        for &(kind, address, size, flags) in segments {
            for word in [kind, 0, address, address, size, size, flags, 4] {
                file.extend(word.to_le_bytes());
            }
        }
        file
    }

    const CODE: (u32, u32, u32, u32) = (1, 0x0800_0000, 0x1000, 5);

    #[test]
    fn the_loaded_bytes_are_added_up() {
        let data = (1, 0x2000_0000, 0x20, 6);
        let stack = (0x6474_e551, 0, 0x999, 6);
        assert_eq!(flash_bytes(&elf(0x0800_0400, &[CODE, data, stack])), Ok(0x1020));
    }

    #[test]
    fn an_image_linked_without_its_script_is_refused() {
        assert!(flash_bytes(&elf(0, &[])).unwrap_err().contains("empty"));
        assert!(flash_bytes(&elf(0x0800_0400, &[(1, 0x0800_0000, 0, 5)])).unwrap_err().contains("empty"));
        assert!(flash_bytes(&elf(0, &[CODE])).unwrap_err().contains("entry point"));
    }

    #[test]
    fn the_entry_point_must_be_code() {
        let constants = (1, 0x0800_0000, 0x1000, 4);
        assert!(flash_bytes(&elf(0x0800_0400, &[constants])).unwrap_err().contains("entry point"));
        assert!(flash_bytes(&elf(0x0800_1000, &[CODE])).unwrap_err().contains("entry point"));
    }

    #[test]
    fn a_file_of_another_kind_is_named() {
        assert!(flash_bytes(b"").unwrap_err().contains("not an ELF"));
        let mut host = elf(0x0800_0400, &[CODE]);
        host[18] = 62;
        assert!(flash_bytes(&host).unwrap_err().contains("ARM"));
        let mut object = elf(0x0800_0400, &[CODE]);
        object[16] = 1;
        assert!(flash_bytes(&object).unwrap_err().contains("executable"));
    }

    #[test]
    fn a_file_cut_anywhere_is_an_error() {
        let whole = elf(0x0800_0400, &[CODE]);
        // The last word (alignment) is not read.
        for length in 0..whole.len() - 4 {
            assert!(flash_bytes(&whole[..length]).is_err(), "{length}");
        }
    }
}
