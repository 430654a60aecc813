//! Who calls whom in a linked image, and what stack each takes.

use std::collections::{BTreeMap, BTreeSet};

use object::{Object, ObjectSection, ObjectSymbol, SectionKind, SymbolKind};

use super::ElfError;
use super::thumb::{Instruction, Meaning, meaning};

/// A function of the image.
#[derive(Clone, Debug)]
pub struct Function {
    /// Its name as the source has it.
    pub name: String,
    /// Bytes of code and of constants between it.
    pub size: u64,
    /// Stack it takes itself, bytes; every lowering of the stack pointer counts, even those that exclude each other.
    pub frame: u32,
    /// The functions it calls or jumps to, by address.
    pub calls: BTreeSet<u64>,
    /// Whether it calls what a register says.
    pub indirect: bool,
}

/// An image's functions by address.
#[derive(Clone, Debug)]
pub struct Graph {
    functions: BTreeMap<u64, Function>,
}

/// The deepest way through a graph.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Deepest {
    /// Bytes.
    pub bytes: u32,
    /// The functions on it with their frames, from the root.
    pub way: Vec<(String, u32)>,
}

/// Every Thumb instruction of an ELF's code with its address, data between it left out by the mapping symbols `$t` and `$d`.
///
/// # Errors
/// No ELF, or one without these symbols.
pub fn instructions(elf: &[u8]) -> Result<Vec<(u64, Instruction)>, ElfError> {
    let file = object::File::parse(elf)?;
    let mut marks: Vec<(u64, bool)> = file
        .symbols()
        .filter_map(|symbol| match symbol.name().ok()?.get(..2)? {
            "$t" => Some((symbol.address() & !1, true)),
            "$d" => Some((symbol.address() & !1, false)),
            _ => None,
        })
        .collect();
    marks.sort_unstable();
    if marks.is_empty() {
        return Err(ElfError::Stripped);
    }
    let mut found = Vec::new();
    for section in file.sections().filter(|section| is_code(section.kind(), section.name())) {
        let bytes = section.data()?;
        let halfword = |at: usize| bytes.get(at..at + 2).map(|b| u16::from_le_bytes([b[0], b[1]]));
        let mut at = 0;
        while let Some(first) = halfword(at) {
            let address = section.address() + at as u64;
            let before = marks.partition_point(|&(mark, _)| mark <= address);
            let is_code = before > 0 && marks[before - 1].1 && marks[before - 1].0 >= section.address();
            // Halfwords from 0b11101 upwards begin an instruction of two.
            let long = is_code && first >> 11 >= 0b11101;
            if is_code {
                found.push((address, (first, if long { halfword(at + 2).unwrap_or(0) } else { 0 })));
            }
            at += if long { 4 } else { 2 };
        }
    }
    found.sort_unstable();
    Ok(found)
}

/// Code lies in the text, and where RAM holds some, in the initial values of the variables.
fn is_code(kind: SectionKind, name: object::Result<&str>) -> bool {
    kind == SectionKind::Text || name == Ok(".data")
}

impl Graph {
    /// Of an image's bytes.
    ///
    /// # Errors
    /// No ELF, or a frame whose size cannot be told.
    pub fn new(elf: &[u8]) -> Result<Self, ElfError> {
        let file = object::File::parse(elf)?;
        let mut functions = BTreeMap::new();
        for symbol in file.symbols().filter(|symbol| symbol.kind() == SymbolKind::Text) {
            let name = symbol.name()?;
            if !name.starts_with('$') {
                let name = format!("{:#}", rustc_demangle::demangle(name));
                let (calls, size) = (BTreeSet::new(), symbol.size());
                functions.insert(symbol.address() & !1, Function { name, size, frame: 0, calls, indirect: false });
            }
        }
        let mut graph = Self { functions };
        let mut constants = (0, BTreeMap::new());
        for (at, instruction) in instructions(elf)? {
            let Some(start) = graph.start(at) else { continue };
            // Between functions stands what the linker fills gaps with.
            if graph.functions.get(&start).is_some_and(|function| function.size > 0 && at >= start + function.size) {
                continue;
            }
            if constants.0 != start {
                constants = (start, BTreeMap::new());
            }
            let into = |to: u64| (to != start).then_some(to);
            let (mut call, mut takes, mut indirect) = (None, 0, false);
            match meaning(at, instruction) {
                Meaning::Call(to) => call = Some(to),
                Meaning::Jump(to) => call = graph.start(to).and_then(into),
                Meaning::Indirect => indirect = true,
                Meaning::Takes(bytes) => takes = bytes,
                Meaning::TakesRegister(register) => {
                    takes = constants.1.get(&register).copied().ok_or(ElfError::Frame { at })?;
                }
                Meaning::Constant(register, value) => drop(constants.1.insert(register, value)),
                Meaning::Other => {}
            }
            let call = call.and_then(|to| graph.start(to));
            if let Some(function) = graph.functions.get_mut(&start) {
                function.calls.extend(call);
                function.frame += takes;
                function.indirect |= indirect;
            }
        }
        Ok(graph)
    }

    /// Start of the function that holds an address.
    fn start(&self, at: u64) -> Option<u64> {
        self.functions.range(..=at).next_back().map(|(&start, _)| start)
    }

    /// The functions by address.
    pub fn functions(&self) -> impl Iterator<Item = (u64, &Function)> {
        self.functions.iter().map(|(&at, function)| (at, function))
    }

    /// Address of the function of this name.
    ///
    /// # Errors
    /// There is none.
    pub fn named(&self, name: &str) -> Result<u64, ElfError> {
        let found = self.functions().find(|(_, function)| function.name == name);
        found.map(|(at, _)| at).ok_or_else(|| ElfError::NoFunction(name.to_owned()))
    }

    /// Everything that can run once `root` was called: it and all it leads to.
    pub fn reached(&self, root: u64) -> BTreeMap<u64, &Function> {
        let (mut found, mut open) = (BTreeMap::new(), vec![root]);
        while let Some(at) = open.pop() {
            if let Some(function) = self.functions.get(&at)
                && found.insert(at, function).is_none()
            {
                open.extend(&function.calls);
            }
        }
        found
    }

    /// The deepest stack from `root` on.
    ///
    /// # Errors
    /// Recursion: there is no bound.
    pub fn deepest(&self, root: u64) -> Result<Deepest, ElfError> {
        let mut way = Vec::new();
        let mut known = BTreeMap::new();
        self.depth(root, &mut way, &mut known)?;
        let (mut at, mut named) = (Some(root), Vec::new());
        while let Some((function, &(_, next))) = at.and_then(|at| Some((self.functions.get(&at)?, known.get(&at)?))) {
            named.push((function.name.clone(), function.frame));
            at = next;
        }
        Ok(Deepest { bytes: known.get(&root).map_or(0, |&(bytes, _)| bytes), way: named })
    }

    fn depth(&self, at: u64, way: &mut Vec<u64>, known: &mut Known) -> Result<u32, ElfError> {
        if let Some(&(bytes, _)) = known.get(&at) {
            return Ok(bytes);
        }
        let Some(function) = self.functions.get(&at) else { return Ok(0) };
        if way.contains(&at) {
            return Err(ElfError::Recursion(function.name.clone()));
        }
        way.push(at);
        let mut below = (0, None);
        for &to in &function.calls {
            let bytes = self.depth(to, way, known)?;
            if bytes >= below.0 {
                below = (bytes, Some(to));
            }
        }
        way.pop();
        known.insert(at, (function.frame + below.0, below.1));
        Ok(function.frame + below.0)
    }
}

/// Depth below a function, and the next function on the way there.
type Known = BTreeMap<u64, (u32, Option<u64>)>;
