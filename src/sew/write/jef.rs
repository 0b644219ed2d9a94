//! Janome JEF: a header with the hoop and two tables of threads, then pairs of signed bytes, tenths of a millimetre.
//!
//! The middle of the hoop is the origin of the pattern. A trim is three jumps that move nothing, of which most machines need
//! one. A thread of number 0 in the table stands for a stop.

use std::io::{self, Write};

use super::stitch_file::{Extents, Record, records, told_cuts};
use super::target::{Target, Writer};
use crate::diagnostic::Diagnostics;
use crate::machine::Job;
use crate::sew::program::Program;
use crate::sew::verify::Bytes;

pub(super) const TARGET: Target = Target {
    name: "jef",
    about: "a stitch file of Janome machines, which have their own speeds",
    extension: "jef",
    emit: Writer { refusals, write },
    proof: Some(Bytes::Jef),
};

/// The longest move of a record, tenths of a millimetre: -128 is the byte that begins commands.
const LONGEST: i64 = 127;
/// Way of jumps along an axis beyond which machines cut the thread, tenths of a millimetre.
const TRIM_WAY: i64 = 30;
/// Number of jumps that stand for a trim.
const TRIM_JUMPS: usize = 3;
/// Commands, before their move.
const JUMP: [u8; 2] = [0x80, 0x02];
const STOP: [u8; 2] = [0x80, 0x01];
const END: [u8; 2] = [0x80, 0x10];
/// Header up to the tables of threads.
const HEADER_BYTES: usize = 0x74;
/// Time of saving in the header: no clock may change a program.
const SAVED: &[u8; 16] = b"20000101000000\0\0";
/// Threads of the table that machines know, from number 1; 0 stands for a stop.
const THREADS: u16 = 78;
/// Half the hoops, tenths of a millimetre: 110 x 110, 50 x 50, 140 x 200, and one of the user's.
const HOOPS: [[i64; 2]; 4] = [[550, 550], [250, 250], [700, 1000], [700, 1000]];
/// Hoops by the half of their size, with their numbers in the header.
const CODES: [([i64; 2], u32); 4] = [([250, 250], 1), ([630, 550], 3), ([700, 1000], 2), ([1000, 1000], 4)];

/// Totals of the records of a program, and its body.
#[derive(Default)]
struct Body {
    bytes: Vec<u8>,
    /// Stitches count once in the header, all other commands twice.
    points: u32,
    threads: Vec<u32>,
    extents: Extents,
}

fn body(program: &Program) -> Body {
    let mut body = Body { points: 1, threads: vec![1], ..Body::default() };
    records(program, LONGEST, |kind, way| {
        let way_bytes = way.map(|way| i8::try_from(way).expect("a record is no longer than its bytes").cast_unsigned());
        body.extents.add(way);
        let mut command = |word: [u8; 2], way: [u8; 2]| {
            body.bytes.extend(word.into_iter().chain(way));
            body.points += 2;
        };
        match kind {
            Record::Stitch => {
                body.bytes.extend(way_bytes);
                body.points += 1;
            }
            // A jump that moves nothing would be a trim.
            Record::Jump if way == [0, 0] => {}
            Record::Jump => command(JUMP, way_bytes),
            Record::Trim => (0..TRIM_JUMPS).for_each(|_| command(JUMP, [0, 0])),
            Record::Stop => {
                command(STOP, way_bytes);
                body.threads.push(0);
            }
            Record::Thread(thread) => {
                command(STOP, way_bytes);
                body.threads.push(u32::from((thread.max(1) - 1) % THREADS + 1));
            }
        }
    });
    body.bytes.extend(END);
    body
}

fn refusals(program: &Program, _: &Job, out: &mut Diagnostics) {
    let rule = format!("longer than {} mm", TRIM_WAY / 10);
    told_cuts(program, LONGEST, (&rule, "a JEF"), |(_, way)| way > TRIM_WAY, out);
}

fn write(program: &Program, _: &Job, out: &mut dyn Write) -> io::Result<()> {
    let body = body(program);
    let threads = body.threads.len() as u32;
    let mut header = Vec::with_capacity(HEADER_BYTES + 8 * body.threads.len());
    header.extend((HEADER_BYTES as u32 + 8 * threads).to_le_bytes());
    header.extend(0x14_u32.to_le_bytes());
    header.extend(SAVED);
    header.extend(threads.to_le_bytes());
    header.extend(body.points.to_le_bytes());
    let [right, left, up, down] = body.extents.reach;
    let half = [right.max(left), up.max(down)];
    let fits = |hoop: &[i64; 2]| half[0] <= hoop[0] && half[1] <= hoop[1];
    let code = CODES.iter().find(|(hoop, _)| fits(hoop)).map_or(0, |(_, code)| *code);
    header.extend(code.to_le_bytes());
    let mut put = |numbers: [i64; 4]| numbers.iter().for_each(|&number| header.extend((number as i32).to_le_bytes()));
    put([left, up, right, down]);
    for hoop in HOOPS {
        let [x, y] = hoop;
        put(if fits(&hoop) { [x - left, y - up, x - right, y - down] } else { [-1; 4] });
    }
    for thread in &body.threads {
        header.extend(thread.to_le_bytes());
    }
    // The kind of each thread.
    body.threads.iter().for_each(|_| header.extend(0x0D_u32.to_le_bytes()));
    out.write_all(&header)?;
    out.write_all(&body.bytes)
}
