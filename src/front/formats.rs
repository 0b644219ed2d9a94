//! Formats that cutc does not read, by their first bytes, else by file names: a table with the name of each and advice.

use super::sewn;

/// Number of bytes that are looked at, and of rows of a table after its header.
const SNIFFED: usize = 4096;
const MOST_ROWS: usize = 8;

/// A format that no dialect reads.
#[derive(Debug)]
pub(super) struct Format {
    /// Name for messages.
    pub(super) what: &'static str,
    /// Advice.
    pub(super) hint: &'static str,
    /// True if the file name tells more than the bytes, if it is known.
    pub(super) is_vague: bool,
    is: fn(&[u8]) -> bool,
}

const EXPORT_CUT: &str = "let the CAD export an ISO cut file for a knife cutter";
const EXPORT_PLOT: &str = "let the program that drew it export SVG, DXF or an HPGL plot, or the CAD an ISO cut file";
const EXPORT_PATTERN: &str = "open it in its CAD and export an ISO cut file, an HPGL plot, or pattern DXF (AAMA, ASTM)";
const EXPORT_DRAWING: &str = "let the CAD export the flat drawing as DXF or SVG";
const TABLE: &str = "save a list of points as CSV: `x_mm,y_mm`; let the CAD export all else";
const UNPACK: &str = "unpack it and give cutc the files inside";
const SEW: &str = "`cutc sew` reads stitch files, patterns and stitch queues of sewing machines";
const OTHER_STITCHES: &str =
    "let its program save it as DST for `cutc sew`, or the Python package pyembroidery convert it";
const OWN_STITCHES: &str = "let its own program save it as DST: `cutc sew` reads that";
const PICTURE: &str = "pictures hold no lines: let the CAD export an ISO cut file or an HPGL plot";
const RASTER: &str = "it holds no lines: let the driver send vectors (HP-GL/2), or the CAD write an HPGL plot";
const OTHER_PLOTTER: &str = "let the driver of the plotter write HPGL instead";

/// Least number of bytes that tell a parity.
const LEAST_OF_PARITY: usize = 32;

const fn known(what: &'static str, hint: &'static str, is: fn(&[u8]) -> bool) -> Format {
    Format { what, hint, is_vague: false, is }
}

const fn vague(what: &'static str, hint: &'static str, is: fn(&[u8]) -> bool) -> Format {
    Format { what, hint, is_vague: true, is }
}

/// Formats by their bytes, the surest signs first.
#[rustfmt::skip] // a table: a row a format
const FORMATS: &[Format] = &[
    known("a stitch file of a sewing machine (DST)", SEW, sewn::is_dst),
    known("a pattern for a sewing machine", SEW, sewn::is_pattern),
    known("a stitch queue of a sewing machine", SEW, sewn::is_queue),
    known("an embroidery file of Barudan machines (DSB)", OTHER_STITCHES, sewn::is_dsb),
    known("an embroidery file (PES)", SEW, sewn::is_pes),
    known("an embroidery file (PEC)", SEW, sewn::is_pec),
    known("an embroidery file (VP3)", SEW, sewn::is_vp3),
    known("an embroidery file (JEF)", SEW, sewn::is_jef),
    known("a document of an office program (XLSX, DOCX)", TABLE, is_office),
    vague("a zip archive", UNPACK, |b| b.starts_with(b"PK")),
    known("a 7z archive", UNPACK, |b| b.starts_with(b"7z\xbc\xaf\x27\x1c")),
    known("a RAR archive", UNPACK, |b| b.starts_with(b"Rar!")),
    known("a bzip2 archive", UNPACK, |b| b.starts_with(b"BZh") && b.get(4..10) == Some(b"1AY&SY")),
    known("an xz archive", UNPACK, |b| b.starts_with(b"\xfd7zXZ\0")),
    known("a Zstandard archive", UNPACK, |b| b.starts_with(b"\x28\xb5\x2f\xfd")),
    known("an LHA archive", UNPACK, |b| b.get(2..5) == Some(b"-lh") && b.get(6) == Some(&b'-')),
    known("a program for Windows (EXE)", UNPACK, |b| b.starts_with(b"MZ") && is_binary(b)),
    known("a drawing of CorelDRAW", EXPORT_PLOT, |b| b.starts_with(b"RIFF") && b.get(8..11) == Some(b"CDR")),
    known("a message of a mail program", "save the attachment, and give cutc that", is_mail),
    known("bytes with a parity bit", "the serial line was read with 8 bits of data: set it to 7 bits and the parity of the sender", has_parity),
    vague("a gzip archive", UNPACK, |b| b.starts_with(b"\x1f\x8b")),
    known("a drawing of Adobe Illustrator (AI)", EXPORT_PLOT, is_illustrator),
    known("a PDF document", EXPORT_CUT, is_pdf),
    known("a PostScript file (EPS)", EXPORT_PLOT, |b| b.starts_with(b"%!") || b.starts_with(b"\xc5\xd0\xd3\xc6")),
    known("a PNG picture", PICTURE, |b| b.starts_with(b"\x89PNG")),
    known("a JPEG picture", PICTURE, |b| b.starts_with(b"\xff\xd8\xff")),
    known("a GIF picture", PICTURE, |b| b.starts_with(b"GIF8")),
    known("a TIFF picture", PICTURE, |b| b.starts_with(b"II*\0") || b.starts_with(b"MM\0*")),
    known("a WebP picture", PICTURE, |b| b.starts_with(b"RIFF") && b.get(8..12) == Some(b"WEBP")),
    known("a BMP picture", PICTURE, is_bmp),
    known("a Photoshop picture (PSD)", PICTURE, |b| b.starts_with(b"8BPS")),
    known("an icon (ICO)", PICTURE, |b| b.starts_with(&[0, 0, 1, 0])),
    known("a HEIC or AVIF picture", PICTURE, |b| b.get(4..8) == Some(b"ftyp")),
    known("a Windows metafile (WMF)", EXPORT_PLOT, |b| b.starts_with(b"\xd7\xcd\xc6\x9a")),
    known("an enhanced metafile (EMF)", EXPORT_PLOT, |b| b.get(40..44) == Some(b" EMF")),
    known("a tar archive", UNPACK, |b| b.get(257..262) == Some(b"ustar")),
    known("a text document (RTF)", TABLE, |b| b.starts_with(b"{\\rtf")),
    known("a STEP model", EXPORT_DRAWING, |b| b.starts_with(b"ISO-10303-21")),
    known("an IGES model", EXPORT_DRAWING, is_iges),
    known("JSON data", EXPORT_CUT, is_json),
    known("a web page (HTML)", "the download gave a page in its stead: sign in and fetch the file itself", is_web_page),
    known("a pointer of Git LFS", "the file itself is stored elsewhere: fetch it with `git lfs pull`", |b| b.starts_with(b"version https://git-lfs")),
    known("text in UTF-16", "save it as plain text: one byte a character", is_utf16),
    known("a binary DXF drawing", "save it as text (ASCII DXF)", |b| b.starts_with(b"AutoCAD Binary DXF")),
    known("a DWG drawing of AutoCAD", "save it as ASCII DXF", |b| b.starts_with(b"AC10")),
    known("a table of grading rules (RUL)", "give cutc the pattern DXF that lies beside it", is_rule_table),
    known("a GP-GL plot (Graphtec)", OTHER_PLOTTER, is_gp_gl),
    known("a DMPL plot (Houston Instruments)", OTHER_PLOTTER, |b| b.trim_ascii_start().starts_with(b";:")),
    known("a raster page for a printer or an inkjet plotter (PCL, HP RTL)", RASTER, is_raster),
    vague("binary data", EXPORT_CUT, |b| is_binary(b) && !(has(b, b"\x1b*b") && has_vectors(b))),
    known("a Gerber file for circuit boards", "the name is the same, the format is not; garment CAD writes ISO cut files with M14 and M15", is_circuit_board),
    known("a CAMM-GL I plot (Roland)", OTHER_PLOTTER, is_camm_gl),
    known("a drill file for circuit boards (Excellon)", "garment CAD writes ISO cut files with M14 and M15", is_excellon),
    known("a table of points with decimal commas", "write commas between the numbers and points for decimals: `x_mm,y_mm`", is_comma_table),
    known("a table of points in another form", "begin with the row `x_mm,y_mm`, write commas between the numbers, no quotes and no remarks", is_other_table),
    known("an ISO cut file in small letters", "write its codes in capitals: X, Y, M14, M15", is_small_iso),
    known("G-code for a machine tool", "its blocks end with the line; cutter files end them with `*`", is_g_code),
];

/// A format that is recognised by file names alone.
struct Named {
    extensions: &'static [&'static str],
    format: Format,
}

const fn named(extensions: &'static [&'static str], what: &'static str, hint: &'static str) -> Named {
    Named { extensions, format: known(what, hint, |_| false) }
}

#[rustfmt::skip] // likewise
const NAMED: &[Named] = &[
    named(&["dst", "exp", "pes", "pec", "jef", "vp3", "xxx", "u00", "u01", "u02"], "a stitch file of a sewing machine", SEW),
    named(&["dsb"], "an embroidery file of Barudan machines (DSB)", OTHER_STITCHES),
    named(&["hus", "sew", "shv", "dsz", "10o", "emd", "ksm", "pcs", "phb", "phc", "stx", "tbf", "zhs", "zxy"], "an embroidery file", OTHER_STITCHES),
    named(&["emb", "vip", "art", "ofm"], "an embroidery file", OWN_STITCHES),
    named(&["mrk", "mark"], "a marker of AccuMark or Optitex (MRK)", EXPORT_PATTERN),
    named(&["mkx", "mka", "plx", "plh"], "a marker of Lectra Diamino", EXPORT_PATTERN),
    named(&["mdl", "iba", "vet", "vtx", "mdlx"], "a model of Lectra Modaris", EXPORT_PATTERN),
    named(&["pds", "pdml"], "a pattern set of Optitex", EXPORT_PATTERN),
    named(&["zprj", "zpac", "zpat"], "a project of CLO", EXPORT_PATTERN),
    named(&["val", "sm2d"], "a pattern of Valentina or Seamly2D", EXPORT_PATTERN),
    named(&["svgz"], "a compressed SVG drawing (SVGZ)", "save it as plain SVG, or unpack it with `gzip -d`"),
    named(&["cdr"], "a drawing of CorelDRAW", EXPORT_PLOT),
    named(&["studio", "studio3"], "a drawing of Silhouette Studio", EXPORT_PLOT),
];

/// Format of a content.
pub(super) fn of_content(bytes: &[u8]) -> Option<&'static Format> {
    FORMATS.iter().find(|format| (format.is)(bytes))
}

/// Format of files with such a name.
pub(super) fn of_name(name: &str) -> Option<&'static Format> {
    let (_, extension) = name.rsplit_once('.')?;
    let is = |known: &&'static str| extension.eq_ignore_ascii_case(known);
    NAMED.iter().find(|named| named.extensions.iter().any(is)).map(|named| &named.format)
}

/// First bytes of a file, as far as they are looked at.
pub(super) fn head(bytes: &[u8]) -> &[u8] {
    &bytes[..bytes.len().min(SNIFFED)]
}

/// True if a text holds some bytes, in upper or lower case.
fn has(bytes: &[u8], text: &[u8]) -> bool {
    head(bytes).windows(text.len()).any(|window| window.eq_ignore_ascii_case(text))
}

fn is_illustrator(bytes: &[u8]) -> bool {
    (bytes.starts_with(b"%!PS") || bytes.starts_with(b"%PDF")) && has(bytes, b"Adobe Illustrator")
}

/// A PDF document; printer commands (PJL) or a byte order mark may precede it.
fn is_pdf(bytes: &[u8]) -> bool {
    let is_printed = bytes.starts_with(b"\x1b%-12345X") || bytes.starts_with(b"\xef\xbb\xbf");
    bytes.starts_with(b"%PDF") || is_printed && has(bytes, b"%PDF-")
}

/// A zip archive whose first entry lists its parts, as office programs write it.
fn is_office(bytes: &[u8]) -> bool {
    bytes.starts_with(b"PK") && has(bytes, b"[Content_Types].xml")
}

/// A first line of 80 characters whose 73rd one names the start section.
fn is_iges(bytes: &[u8]) -> bool {
    bytes.get(72) == Some(&b'S')
        && bytes.get(73..80).is_some_and(|number| number.trim_ascii() == b"1" || number == b"0000001")
}

/// An object or a list of JSON: a bracket followed by a quoted key or another bracket.
fn is_json(bytes: &[u8]) -> bool {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes).trim_ascii_start();
    let behind = |open: u8| bytes.strip_prefix(&[open]).map(<[u8]>::trim_ascii_start).and_then(<[u8]>::first);
    behind(b'{') == Some(&b'"') || matches!(behind(b'['), Some(b'{' | b'['))
}

/// An HTML page; a byte order mark may precede it.
fn is_web_page(bytes: &[u8]) -> bool {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes).trim_ascii_start();
    let begins = |with: &[u8]| bytes.get(..with.len()).is_some_and(|start| start.eq_ignore_ascii_case(with));
    begins(b"<!DOCTYPE html") || begins(b"<html") || begins(b"<head") || begins(b"<body")
}

/// Keys of ASTM D6673 that are no lines of their own in DXF files.
fn is_rule_table(bytes: &[u8]) -> bool {
    if memchr::memmem::find(head(bytes), b"RULE").is_none() {
        return false;
    }
    let starts = |line: &[u8], key: &[u8]| line.len() >= key.len() && line[..key.len()].eq_ignore_ascii_case(key);
    let keys: [&[u8]; 3] = [b"RULE:", b"GRADE RULE TABLE:", b"SIZE LIST:"];
    let lines = || head(bytes).split(|&byte| byte == b'\n').map(<[u8]>::trim_ascii);
    keys.iter().filter(|key| lines().any(|line| starts(line, key))).count() >= 2
}

/// Rows of at least two numbers with decimal commas, separated by semicolons, tabs or blanks.
fn is_comma_table(bytes: &[u8]) -> bool {
    table(bytes, |byte| b"; \t".contains(byte)).iter().any(|row| row.contains(&b','))
}

/// Table of numbers in another form than points in CSV: with other separators, quotes or remarks.
fn is_other_table(bytes: &[u8]) -> bool {
    if table(bytes, |byte| b",; \t".contains(byte)).is_empty() {
        return false; // as nearly all files
    }
    // Rows below the header of points in CSV have messages of their own.
    let first: Vec<u8> = head(bytes).iter().copied().filter(|byte| !b" \t\r".contains(byte)).collect();
    let is_csv = has(&first, b"x_mm,y_mm\n")
        || !table(bytes, |byte| *byte == b',').is_empty() && !first.iter().any(|byte| b"\"#".contains(byte));
    !is_csv
}

/// Rows of a table of numbers, in quotes or not, without remarks and header; empty where a row is of another kind.
fn table(bytes: &[u8], parts: fn(&u8) -> bool) -> Vec<&[u8]> {
    let head = head(bytes);
    // The last number may be cut off.
    let end = if head.len() < bytes.len() { head.iter().rposition(|byte| parts(byte) || *byte == b'\n') } else { None };
    let head = &head[..end.unwrap_or(head.len())];
    let is_remark = |row: &[u8]| row.is_empty() || row.starts_with(b"#") || row.starts_with(b"//");
    let mut rows = head.split(|&byte| byte == b'\n').map(<[u8]>::trim_ascii).filter(|row| !is_remark(row));
    let is_row = |row: &[u8]| {
        let fields = row.split(parts).map(|field| unquoted(field.trim_ascii())).filter(|field| !field.is_empty());
        fields.clone().count() > 1 && fields.clone().all(is_number)
    };
    let Some(first) = rows.next() else { return Vec::new() };
    let rows: Vec<&[u8]> = std::iter::once(first).filter(|row| is_row(row)).chain(rows.take(MOST_ROWS)).collect();
    if rows.iter().all(|row| is_row(row)) { rows } else { Vec::new() }
}

/// A field without the quotes around it.
fn unquoted(field: &[u8]) -> &[u8] {
    field.strip_prefix(b"\"").and_then(|field| field.strip_suffix(b"\"")).unwrap_or(field)
}

/// True if a field is a number, with a comma or a point for decimals.
fn is_number(field: &[u8]) -> bool {
    let digits = field.strip_prefix(b"-").or_else(|| field.strip_prefix(b"+")).unwrap_or(field);
    let mut parts = digits.split(|byte| b",.".contains(byte));
    let are_digits = |part: &[u8]| !part.is_empty() && part.iter().all(u8::is_ascii_digit);
    parts.clone().count() <= 2 && parts.all(are_digits)
}

/// Commands of one letter between ETX bytes, moves and lines among them.
fn is_gp_gl(bytes: &[u8]) -> bool {
    if memchr::memchr(3, head(bytes)).is_none() || memchr::memchr(b';', head(bytes)).is_some() {
        return false;
    }
    let commands = head(bytes).split(|&byte| byte == 3).map(<[u8]>::trim_ascii).filter(|command| !command.is_empty());
    let leads = commands.filter(|command| is_lead(command, b"MDOE"));
    leads.count() >= 2
}

/// The first header line of a message, or of one of its parts.
fn is_mail(bytes: &[u8]) -> bool {
    let begins =
        [&b"content-type:"[..], b"content-transfer-encoding:", b"mime-version:", b"received:", b"return-path:"];
    begins.iter().any(|begin| bytes.get(..begin.len()).is_some_and(|head| head.eq_ignore_ascii_case(begin)))
}

/// True if the eighth bit of each byte makes the number of its bits even, or of each odd, in what is otherwise text.
fn has_parity(bytes: &[u8]) -> bool {
    let head = head(bytes);
    let is_high = head.iter().any(|byte| byte & 0x80 != 0) && head.iter().any(|byte| byte & 0x80 == 0);
    let is_text = |&byte: &u8| matches!(byte & 0x7f, b'\t' | b'\n' | b'\r' | 0x1b | b' '..=b'~');
    let odd = head.first().map_or(0, |byte| byte.count_ones() % 2);
    head.len() >= LEAST_OF_PARITY && is_high && head.iter().all(|byte| byte.count_ones() % 2 == odd && is_text(byte))
}

/// The signature, and then either four reserved bytes that are 0 or a known header size.
fn is_bmp(bytes: &[u8]) -> bool {
    let sizes = [12, 40, 52, 56, 64, 108, 124];
    bytes.starts_with(b"BM")
        && (bytes.get(6..10) == Some(&[0; 4]) || sizes.iter().any(|&size| bytes.get(14..18) == Some(&[size, 0, 0, 0])))
}

/// Lines of one letter with pairs of numbers, moves and lines, among commands of mode 2 after a circumflex; or the lines alone.
fn is_camm_gl(bytes: &[u8]) -> bool {
    let begins = |bytes: &[u8]| matches!(bytes, [first, second, ..] if *first == b'^' || !second.is_ascii_alphabetic());
    let holds = |byte: u8| memchr::memchr(byte, head(bytes)).is_some();
    if holds(b'*') || !holds(b',') || !begins(bytes.trim_ascii_start()) {
        return false; // as nearly all that is read
    }
    let commands = head(bytes).split(|byte| b";\r\n".contains(byte)).map(<[u8]>::trim_ascii);
    let commands = commands.filter(|command| !command.is_empty() && !b"^!".contains(&command[0]));
    let (mut all, mut leads) = (0, 0);
    if is_mode_2(bytes) {
        return true;
    }
    for command in commands.take(50) {
        all += 1;
        leads += usize::from(is_lead(command, b"MDIR"));
    }
    leads >= 3 && 2 * leads > all
}

/// True if there are commands of two letters, each after a circumflex.
fn is_mode_2(bytes: &[u8]) -> bool {
    let commands = head(bytes).split(|byte| b";\r\n".contains(byte)).map(<[u8]>::trim_ascii);
    let is_of_it =
        |command: &&[u8]| matches!(command, [b'^', a, b, ..] if a.is_ascii_alphabetic() && b.is_ascii_alphabetic());
    commands.filter(is_of_it).take(3).count() == 3
}

/// True if a command is one of some letters with a pair of numbers, separated by a comma.
fn is_lead(command: &[u8], letters: &[u8]) -> bool {
    let Some((letter, numbers)) = command.split_first() else { return false };
    let is_number = |byte: &u8| byte.is_ascii_digit() || b"+-., ".contains(byte);
    letters.contains(letter) && numbers.contains(&b',') && numbers.iter().all(is_number) && numbers[0] != b','
}

fn is_utf16(bytes: &[u8]) -> bool {
    if bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff") {
        return true;
    }
    // Without a mark: every other byte of western text is NUL.
    let zeros = |parity: usize| {
        let (pairs, _) = head(bytes).as_chunks::<2>();
        pairs.len() >= 4 && pairs.iter().all(|pair| pair[parity] == 0 && pair[1 - parity] != 0)
    };
    zeros(0) || zeros(1)
}

/// More than one byte in ten that is in no text. NUL bytes at the end of the file do not count.
fn is_binary(bytes: &[u8]) -> bool {
    let whole = bytes.iter().rposition(|&byte| byte != 0).map_or(0, |last| last + 1);
    let head = head(&bytes[..whole]);
    let control =
        |&&byte: &&u8| (byte < b' ' && !byte.is_ascii_whitespace() && byte != 0x1a && byte != 0) || byte == 0x7f;
    let zeros = memchr::memchr_iter(0, head).count();
    let asterisks = memchr::memchr_iter(b'*', head).count();
    10 * head.iter().filter(control).count() > head.len() || (zeros > asterisks && 4 * zeros > head.len())
}

/// Sequences that begin, fill and end a raster: `ESC * r A`, `ESC * b W`.
fn is_raster(bytes: &[u8]) -> bool {
    let has = |text: &[u8]| memchr::memmem::find(head(bytes), text).is_some();
    has(b"\x1b*r") && has(b"\x1b*b") && !has(b"PD") && !has_vectors(bytes)
}

/// Instructions of a plot, or switches to them: it may hold a raster picture beside its lines.
fn has_vectors(bytes: &[u8]) -> bool {
    let holds = |text: &&[u8]| memchr::memmem::find(bytes, text).is_some();
    [&b"\x1b%0B"[..], b"\x1b%1B", b";PD", b"PD;", b";PU", b"PU;"].iter().any(holds)
}

/// The header of a drill file: `M48`, up to a line with a per cent sign.
fn is_excellon(bytes: &[u8]) -> bool {
    let lines = head(bytes).split(|&byte| byte == b'\n').map(<[u8]>::trim_ascii);
    let mut lines = lines.skip_while(|line| line.is_empty() || line.starts_with(b";"));
    lines.next() == Some(b"M48") && lines.any(|line| line == b"%" || line == b"M95")
}

/// Codes of the knife (M14, M15) in small letters.
fn is_small_iso(bytes: &[u8]) -> bool {
    let head = head(bytes);
    let has = |code: &[u8]| memchr::memmem::find(head, code).is_some();
    has(b"m14*") && has(b"m15*") && !has(b"M14*")
}

/// Parameters between per cent signs, or places with codes of apertures (RS-274D), and no knife.
fn is_circuit_board(bytes: &[u8]) -> bool {
    let holds = |text: &[u8]| memchr::memmem::find(head(bytes), text).is_some();
    if !holds(b"D0") && !holds(b"%") || holds(b"M15*") || holds(b"M14*") {
        return false; // as nearly all that is read
    }
    let is_flash = |block: &[u8]| {
        let block = block.trim_ascii();
        block.first().is_some_and(|byte| b"XY".contains(byte))
            && [b"D01", b"D02", b"D03"].iter().any(|d| block.ends_with(*d))
    };
    if head(bytes).split(|&byte| byte == b'*').filter(|block| is_flash(block)).count() >= 2 {
        return true;
    }
    let starts =
        |text: &[u8]| [b"%FS", b"%MO", b"%AD", b"%AM", b"%LP", b"%TF", b"%IP"].iter().any(|p| text.starts_with(*p));
    head(bytes).split(|&byte| byte == b'*' || byte == b'\n').take(20).any(|block| starts(block.trim_ascii()))
}

/// Lines of words that begin with G, M, N and the like, without asterisks at the end.
fn is_g_code(bytes: &[u8]) -> bool {
    let head = head(bytes);
    let begins_word = |at: usize| at == 0 || head[at - 1].is_ascii_whitespace();
    let is_g_word = |at: usize| begins_word(at) && head.get(at + 1).is_some_and(u8::is_ascii_digit);
    if !memchr::memchr2_iter(b'G', b'g', head).any(is_g_word) {
        return false; // as most files that are read
    }
    let (mut all, mut sound) = (0, 0);
    for line in head.split(|&byte| byte == b'\n').map(<[u8]>::trim_ascii).filter(|line| !line.is_empty()) {
        all += 1;
        let comment = matches!(line[0], b'(' | b';' | b'%');
        let word =
            line[0].is_ascii_alphabetic() && line.get(1).is_some_and(|b| b.is_ascii_digit() || b"-. ".contains(b));
        sound += usize::from(comment || word);
    }
    // Some senders add a checksum after an asterisk, at most one per line, never after each word.
    let asterisks = memchr::memchr_iter(b'*', head).count();
    2 * sound > all && all >= 2 && asterisks == 0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(bytes: &[u8], what: Option<&str>) {
        let found = of_content(bytes).map(|format| format.what);
        assert_eq!(found, what, "{}", String::from_utf8_lossy(bytes));
    }

    #[test]
    fn a_foreign_file_is_called_by_its_name() {
        check(b"x_mm,y_mm,element\n0,0,\n", Some("a pattern for a sewing machine"));
        check(b"op,dx_mm,dy_mm,value\nEND,,,\n", Some("a stitch queue of a sewing machine"));
        check(b"PK\x03\x04\x14\0", Some("a zip archive"));
        check(b"PK\x03\x04\x14\0\x06\0[Content_Types].xml", Some("a document of an office program (XLSX, DOCX)"));
        check(b"\x1b%-12345X@PJL JOB\r\n%PDF-1.7\n", Some("a PDF document"));
        check(b"BZh91AY&SY\0\x01", Some("a bzip2 archive"));
        check(b"\x21\x4a-lh5-\0\0", Some("an LHA archive"));
        check(b"RIFF\0\x10\0\0CDR9vrsn", Some("a drawing of CorelDRAW"));
        check(b"MIME-Version: 1.0\nContent-Transfer-Encoding: base64\n\nSDEqRzcx", Some("a message of a mail program"));
        let even = |byte: u8| byte | u8::from(byte.count_ones() % 2 == 1) << 7;
        let cut = b"H1*G71*N1*M15*X100Y100*M14*X200Y100*X200Y200*M15*M0*";
        check(&cut.map(even), Some("bytes with a parity bit"));
        check(&cut.map(|byte| even(byte) ^ 0x80), Some("bytes with a parity bit"));
        check(b"8BPS\0\x01", Some("a Photoshop picture (PSD)"));
        check(b"\0\0\x01\0\x01\0\x20\x20", Some("an icon (ICO)"));
        check(b"\0\0\0\x18ftypheic", Some("a HEIC or AVIF picture"));
        check(b"\xd7\xcd\xc6\x9a\0\0", Some("a Windows metafile (WMF)"));
        check(&[&[1, 0, 0, 0][..], &[0; 36], b" EMF"].concat(), Some("an enhanced metafile (EMF)"));
        check(&[&b"marker.plt"[..], &[0; 247], b"ustar"].concat(), Some("a tar archive"));
        check(b"{\\rtf1\\ansi", Some("a text document (RTF)"));
        check(b"ISO-10303-21;\nHEADER;", Some("a STEP model"));
        check(format!("{:72}S      1\n", "a body").as_bytes(), Some("an IGES model"));
        check(b"{\n  \"pieces\": []}", Some("JSON data"));
        check(b"[[0, 1], [2, 3]]", Some("JSON data"));
        check(b"{1,2}", None);
        check(b"G04 comment*\n%FSLAX24Y24*%\n%MOIN*%\nX0Y0D02*", Some("a Gerber file for circuit boards"));
        check(b"%\nG21\nG0 X1 Y2\nM30\n", Some("G-code for a machine tool"));
        check(b"AutoCAD Binary DXF\r\n\x1a\0\0\0SECTION", Some("a binary DXF drawing"));
        check(b"H\x001\0*\0M\x001\x005\0*\0", Some("text in UTF-16"));
        check(b"\x01\x02\x7f\x03abc\x04\x05", Some("binary data"));
        // Some programs fill the last block of a file with NUL.
        check(&[b"G71*N1*X0Y0*M14*X9Y0*M15*M0*".as_slice(), &[0; 200]].concat(), None);
        check(b"G75*\nG70*\nD10*\nX0Y5D02*\nX0Y9D01*\nM02*\n", Some("a Gerber file for circuit boards"));
        check(
            b"%!PS-Adobe-3.0 EPSF-3.0\n%%Creator: Adobe Illustrator(R) 9",
            Some("a drawing of Adobe Illustrator (AI)"),
        );
        check(b"%!PS-Adobe-3.0 EPSF-3.0\n", Some("a PostScript file (EPS)"));
        check(b"%!\nnewpath 0 0 moveto\n", Some("a PostScript file (EPS)"));
        check(b"BM\x36\x10\0\0ab\0\0\x36\0\0\0\x28\0\0\0", Some("a BMP picture"));
        check(b"^IN;!MC0;V20;^PU400,400;^PD12400,400;^PU0,0;", Some("a CAMM-GL I plot (Roland)"));
        check(b"\xff\xd8\xff\xe0\0\x10JFIF", Some("a JPEG picture"));
        check(
            b"ANSI/AAMA\r\nUNITS: METRIC\r\nSIZE LIST: S M\r\nRULE: DELTA 1\r\n",
            Some("a table of grading rules (RUL)"),
        );
        check(b"\x1b\x04FX20,0\x03M400,400\x03D4400,400,4400,2400\x03", Some("a GP-GL plot (Graphtec)"));
        check(b";:H A L0 EC1 U 400,400 D 4400,400 @ ", Some("a DMPL plot (Houston Instruments)"));
        check(b"H\nM0,0\nD100,0\nD100,50\n", Some("a CAMM-GL I plot (Roland)"));
        check(b"^IN;!PG;H\nM0,0\nD2000,0,2000,3000\nM4000,0\nD6000,0\nH\n", Some("a CAMM-GL I plot (Roland)"));
        check(b"\r\n<!doctype HTML><html><body><svg></svg></body></html>", Some("a web page (HTML)"));
        check(b"version https://git-lfs.github.com/spec/v1\noid sha256:aa\nsize 12345\n", Some("a pointer of Git LFS"));
    }

    #[test]
    fn drill_files_raster_pages_and_tables_in_another_form_are_known() {
        check(b"M48\nINCH,LZ\nT1C0.02\n%\nT1\nX12500Y10000\n", Some("a drill file for circuit boards (Excellon)"));
        let raster = Some("a raster page for a printer or an inkjet plotter (PCL, HP RTL)");
        check(b"\x1bE\x1b*t300R\x1b*r1A\x1b*b4Wabcd\x1b*rB", raster);
        check(b"\x1bE\x1b*t300R\x1b*r1A\x1b*b4Wabcd\x1b*rB\x1b%0BIN;PU0,0;PD9,9;", None);
        check(b"\x1b%0BINSP1PU0,0PD9,0,9,9PU\x1b%0A\x1b*r1A\x1b*b4Wabcd\x1b*rB", None);
        let other = Some("a table of points in another form");
        for text in ["# points\n1.0,2.0\n3.0,4.0\n", "\"x\",\"y\"\n\"1.0\",\"2.0\"\n", "x;y\n1.0;2.0\n", "1;2\n3;4\n"] {
            check(text.as_bytes(), other);
        }
    }

    #[test]
    fn a_table_with_decimal_commas_is_known_however_it_is_laid_out() {
        let table = Some("a table of points with decimal commas");
        for text in [
            "404,9;413,5",
            "404,9;413,5\n",
            "404,9;413,5;12409,4;413,5;12409,4;8444,6",
            "404,9;413,5;\r\n12409,4;413,5;\r\n",
            "X;Y\n404,9;413,5\n12409,4;413,5\n",
            "1;404,9;413,5\n2;12409,4;413\n",
            "404,9\t413,5\n12409,4\t-413,5\n",
            "x y\n\n404,9 413,5\n",
            &"404,9;413,5;".repeat(1000),
        ] {
            check(text.as_bytes(), table);
        }
        for text in ["404,9", "1, 2\n3, 4\n", "x;y\n", "1,2;3,4;PU\n", ";PU7,4;PD8,4;"] {
            check(text.as_bytes(), None);
        }
    }

    #[test]
    fn a_name_tells_of_files_whose_bytes_do_not() {
        let what = |name: &str| of_name(name).map(|format| format.what);
        assert_eq!(what("a/b.MRK"), Some("a marker of AccuMark or Optitex (MRK)"));
        assert_eq!([what("a.cut"), what("mrk"), what("a.plt")], [None; 3]);
    }

    #[test]
    fn a_cutter_file_is_not_foreign() {
        check(b"H1*G71*M15*N1*X0Y0*M14*X100Y0*M15*M0*", None);
        check(b"H1*\nG71*\nM15*\nX0Y0*\nM14*\n", None);
        check(b"x_mm,y_mm\n1,2\n", None);
        check(b"  0\r\nSECTION\r\n  2\r\nHEADER\r\n", None);
        check(b"H1*M15*M20*%FS;PU;PD*M0*", None);
    }
}
