//! Decoder of stitch files, written from the descriptions of their formats.

/// A record and the needle position after it, tenths of a millimetre.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Record {
    pub(super) kind: Kind,
    pub(super) at: [i64; 2],
}

/// Kind of a record.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Stitch,
    Jump,
    /// A thread cut, before the move of the record; so are the next three.
    Trim,
    /// A stop for the next thread.
    Stop,
    /// A stop for the thread of a needle.
    Needle(u16),
    /// A stop for the operator.
    Halt,
}

/// Content of a file.
#[derive(Debug, Default)]
pub struct File {
    pub(super) records: Vec<Record>,
    /// Number of wrong values in the header; `None` for a format without a header.
    pub(super) header: Option<u32>,
    /// True if the end is missing.
    pub(super) has_no_end: bool,
    /// True if bytes follow the end.
    pub(super) has_more: bool,
    /// True if the final record has additional bits; machines still stop there.
    pub(super) has_odd_end: bool,
    /// Number of consecutive jumps that cut the thread on machines.
    pub(super) trim_jumps: Option<usize>,
    /// Way of jumps along an axis beyond which machines cut the thread, tenths of a millimetre.
    pub(super) trim_way: Option<i64>,
}

/// Content of a file, or a description of the part that cannot be read.
pub(super) type Decoded = Result<File, String>;

/// Number of consecutive jumps that machines treat as a trim in a DST file.
const TRIM_JUMPS: usize = 3;

const DST_HEADER: usize = 512;

/// Decodes a DST file.
pub(super) fn dst(bytes: &[u8]) -> Decoded {
    let (header, body) = bytes.split_at_checked(DST_HEADER).ok_or("the header is cut off")?;
    let mut records = Vec::new();
    let (mut at, mut reach) = ([0_i64; 2], [0_i64; 4]);
    let (triples, rest) = body.as_chunks::<3>();
    // Both bits of 81 up and down, which no move has.
    let is_end = |triple: &[u8; 3]| triple[2] & 0b1111_0011 == 0b1111_0011;
    let found = triples.iter().position(is_end);
    // In a file without an end, filling follows the last record. Each record has the two lowest bits of its last byte set.
    let whole = triples.iter().rposition(|triple| triple[2] & 3 == 3).map_or(0, |last| last + 1);
    let end = found.unwrap_or(whole);
    for (i, &[a, b, c]) in triples[..end].iter().enumerate() {
        let kind = match c & 0b1100_0011 {
            0b0000_0011 => Kind::Stitch,
            0b1000_0011 => Kind::Jump,
            0b1100_0011 => Kind::Stop,
            _ => return Err(format!("record {} is none", i + 1)),
        };
        // Bit by bit as in the description of the format: the bits for up and down alternate.
        let bit = |byte: u8, place: u32| i64::from(byte >> place & 1);
        let x = bit(a, 0) - bit(a, 1)
            + 9 * (bit(a, 2) - bit(a, 3))
            + 3 * (bit(b, 0) - bit(b, 1))
            + 27 * (bit(b, 2) - bit(b, 3))
            + 81 * (bit(c, 2) - bit(c, 3));
        let y = bit(a, 7) - bit(a, 6)
            + 9 * (bit(a, 5) - bit(a, 4))
            + 3 * (bit(b, 7) - bit(b, 6))
            + 27 * (bit(b, 5) - bit(b, 4))
            + 81 * (bit(c, 5) - bit(c, 4));
        at = [at[0] + x, at[1] + y];
        let now = [at[0], -at[0], at[1], -at[1]];
        (0..4).for_each(|side| reach[side] = reach[side].max(now[side]));
        records.push(Record { kind, at });
    }
    let wrong = wrong_fields(header, &records, reach);
    Ok(File {
        records,
        header: Some(wrong),
        has_no_end: found.is_none(),
        has_more: end + 1 != triples.len() || !rest.is_empty(),
        has_odd_end: triples.get(end) != Some(&[0, 0, 0xF3]),
        trim_jumps: Some(TRIM_JUMPS),
        trim_way: None,
    })
}

/// Number of fields of the header of a DST file that are not those of its records. `reach` is their extent from the start.
fn wrong_fields(header: &[u8], records: &[Record], reach: [i64; 4]) -> u32 {
    let end = records.last().map_or([0; 2], |record| record.at);
    let stops = records.iter().filter(|record| record.kind == Kind::Stop).count();
    let count = |number: usize| i64::try_from(number).unwrap_or(i64::MAX);
    let told = [
        ("ST", count(records.len())),
        ("CO", count(stops)),
        ("+X", reach[0]),
        ("-X", reach[1]),
        ("+Y", reach[2]),
        ("-Y", reach[3]),
        ("AX", end[0]),
        ("AY", end[1]),
    ];
    let text = String::from_utf8_lossy(header);
    let fields: Vec<(&str, String)> = text
        .split('\r')
        .filter_map(|field| field.split_once(':'))
        .map(|(name, value)| (name, value.replace(' ', "")))
        .collect();
    let is_wrong = |&&(name, value): &&(&str, i64)| {
        !fields.iter().any(|(field, told)| *field == name && told.parse() == Ok(value))
    };
    let wrong = told.iter().filter(is_wrong).count();
    wrong as u32
}

/// Decodes an EXP file.
pub(super) fn exp(bytes: &[u8]) -> Decoded {
    let mut records = Vec::new();
    let mut at = [0_i64; 2];
    let mut rest = bytes;
    while let [first, second, behind @ ..] = rest {
        rest = behind;
        let (kind, way) = if *first == 0x80 {
            let [x, y, behind @ ..] = rest else { return Err("the last record is cut off".to_owned()) };
            rest = behind;
            match second {
                0x80 => (Kind::Trim, [0, 0]),
                0x04 => (Kind::Jump, [*x, *y]),
                0x01 => (Kind::Stop, [*x, *y]),
                0x02 => (Kind::Stitch, [*x, *y]),
                _ => return Err(format!("command {second:02x} is none")),
            }
        } else {
            (Kind::Stitch, [*first, *second])
        };
        let signed = |byte: u8| if byte < 128 { i64::from(byte) } else { i64::from(byte) - 256 };
        at = [at[0] + signed(way[0]), at[1] + signed(way[1])];
        records.push(Record { kind, at });
    }
    if rest.is_empty() { Ok(File { records, ..File::default() }) } else { Err("the last record is cut off".to_owned()) }
}
