//! Runs one map so many times, for counting its instructions: `host-maps MAP COUNT`, or `host-maps list`.
//!
//! The counter is callgrind: the difference of two runs, less that of the map `nothing`, is the map alone.

use std::hint::black_box;
use std::process::ExitCode;

use bench::maps::{MAPS, Poses};

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match &arguments[..] {
        [list] if list == "list" => {
            for (name, _) in MAPS {
                println!("{name}");
            }
            ExitCode::SUCCESS
        }
        [name, count] => {
            let map = MAPS.iter().find(|(map, _)| map == name);
            let (Some((_, map)), Ok(count)) = (map, count.parse::<usize>()) else {
                eprintln!("usage: host-maps MAP COUNT, MAP one of `host-maps list`");
                return ExitCode::from(2);
            };
            let poses = black_box(Poses::new());
            for pose in 0..count {
                map(&poses, pose % Poses::COUNT);
            }
            ExitCode::SUCCESS
        }
        _ => {
            eprintln!("usage: host-maps MAP COUNT, or host-maps list");
            ExitCode::from(2)
        }
    }
}
