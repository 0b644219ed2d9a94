//! Second, minimal reading of the lines of a DXF file: the contents of each block.

use std::collections::BTreeMap;

use super::letters::Letters;
use crate::machine::labels::Labels;

/// Group code and its value.
#[derive(Debug, Clone, Copy)]
struct Tag<'a> {
    code: i32,
    text: &'a [u8],
}

/// Entity, text or structural item of the file.
#[derive(Debug, Clone)]
pub(super) struct Item<'a> {
    /// Type, in capitals.
    pub(super) kind: Vec<u8>,
    /// Number of the group that it begins with.
    pub(super) number: u32,
    tags: Vec<Tag<'a>>,
    /// Encoding of its texts; `None` before it is known.
    letters: Option<Letters>,
}

/// Other words for some keys, as written by CAD systems in other countries.
#[rustfmt::skip] // a table: a row a key
const ALSO: [(&str, &[&str]); 5] = [
    ("SIZE", &["SIZE NO.", "SZ.", "BEDEN", "GR.", "GROESSE", "GROSSE", "GRÖSSE", "MAAT", "MARIME", "MARIMEA", "MERET", "MISURA", "MÉRET", "MĂRIME", "MĂRIMEA", "ROZMIAR", "SIZE NAME", "STOERRELSE", "STORLEK", "STØRRELSE", "TAGLIA", "TAILLE", "TALLA", "TAMANHO", "TAMANO", "TAMAÑO", "VELIKOST", "VELKOST", "VEĽKOSŤ", "РАЗМЕР", "РОЗМІР", "サイズ", "号型", "尺码", "尺碼", "码数", "碼數", "號型", "사이즈", "치수"]),
    ("SAMPLE SIZE", &["ALAPMERET", "ALAPMÉRET", "ANA BEDEN", "BASE SIZE", "BASIC SIZE", "BASISGROESSE", "BASISGRÖSSE", "BASISMAAT", "BASISSTØRRELSE", "BASSTORLEK", "BAZ BEDEN", "GRUNDGROESSE", "GRUNDGRÖSSE", "GRUNDSTORLEK", "GRUNDSTØRRELSE", "GRUNNSTØRRELSE", "MARIME DE BAZA", "MARIMEA DE BAZA", "MĂRIME DE BAZĂ", "MĂRIMEA DE BAZĂ", "ROZMIAR BAZOWY", "TAGLIA BASE", "TAILLE DE BASE", "TALLA BASE", "TAMANHO BASE", "ZAKLADNA VELKOST", "ZAKLADNI VELIKOST", "ZÁKLADNÁ VEĽKOSŤ", "ZÁKLADNÍ VELIKOST", "БАЗОВ РАЗМЕР", "БАЗОВИЙ РОЗМІР", "БАЗОВЫЙ РАЗМЕР", "ベースサイズ", "基本尺码", "基本尺碼", "基本码", "基準サイズ", "基码", "基碼", "样板尺码", "標準サイズ", "樣板尺碼", "기본 사이즈", "기본사이즈", "기준 사이즈", "기준사이즈"]),
    ("UNITS", &["UNIT", "EINHEIT", "EINHEITEN", "UNIDAD", "UNIDADE", "UNIDADES", "UNITA", "UNITE", "UNITES", "UNITÀ", "UNITÉ", "UNITÉS", "单位", "BIRIM", "BİRİM", "EENHEDEN", "EENHEID", "JEDNOSTKA", "JEDNOSTKI", "ЕДИНИЦЫ", "ОДИНИЦІ"]),
    ("QUANTITY", &["CUT", "AANTAL", "AANTAL STUKS", "ADET", "ANTAL", "ANTAL DELAR", "ANTALL", "ANZ.", "ANZAHL", "BUC.", "BUCATI", "BUCĂȚI", "CANT.", "CANTIDAD", "CANTIDAD DE PIEZAS", "CANTITATE", "CANTITATEA", "CUT QTY", "CUT QUANTITY", "DARAB", "DARABSZAM", "DARABSZÁM", "DB", "ILOSC", "ILOSC SZTUK", "ILOŚĆ", "ILOŚĆ SZTUK", "LICZBA SZTUK", "MENGE", "MENNYISEG", "MENNYISÉG", "MIKTAR", "MNOZSTVI", "MNOZSTVO", "MNOŽSTVO", "MNOŽSTVÍ", "MİKTAR", "NOMBRE DE PIECES", "NOMBRE DE PIÈCES", "NUMERO PEZZI", "PCS", "PEZZI", "PIECE QTY", "PIECE QUANTITY", "PIECES", "PIEZAS", "POCET", "POCET KUSOV", "POCET KUSU", "POČET", "POČET KUSOV", "POČET KUSŮ", "Q.TA", "Q.TÀ", "QTA", "QTD", "QTDE", "QTE", "QTY", "QTÀ", "QTÉ", "QUANTIDADE", "QUANTIDADE DE PEÇAS", "QUANTITA", "QUANTITE", "QUANTITÀ", "QUANTITÉ", "STCK", "STK", "STUECK", "STUECKZAHL", "STUKS", "STÜCK", "STÜCKZAHL", "SZT.", "БРОЙ", "К-ВО", "К-СТЬ", "К-ТЬ", "КІЛЬКІСТЬ", "КІЛЬКІСТЬ ДЕТАЛЕЙ", "КОЛ-ВО", "КОЛ-ВО ДЕТАЛЕЙ", "КОЛ.", "КОЛИЧЕСТВО", "КОЛИЧЕСТВО ДЕТАЛЕЙ", "件数", "件數", "份数", "份數", "個数", "数量", "數量", "枚数", "枚數", "片数", "片數", "裁片数", "裁片数量", "裁片數", "裁片數量", "매수", "수량", "장수"]),
    ("PIECE NAME", &["NOM DE PIECE", "NOM DE PIÈCE", "NOMBRE DE PIEZA", "NOME DA PEÇA", "NOME PEZZO", "TEIL", "TEILENAME", "裁片名称", "NAZWA CZESCI", "NAZWA CZĘŚCI", "ONDERDEEL", "PARCA", "PARÇA", "ДЕТАЛЬ", "НАЗВА ДЕТАЛІ"]),
];

/// Block, or the items outside blocks.
#[derive(Debug, Clone, Default)]
pub(super) struct Sheet<'a> {
    pub(super) name: Vec<u8>,
    /// Number of the group that it begins with.
    pub(super) number: u32,
    /// Base point that an insertion places, in units of the file; `None` when it is damaged.
    pub(super) base: Option<[f64; 2]>,
    pub(super) items: Vec<Item<'a>>,
}

/// Tolerance for the components of the viewing direction: rounding.
const FLAT: f64 = 1e-5;

impl<'a> Item<'a> {
    pub(super) fn text(&self, code: i32) -> &'a [u8] {
        self.tags.iter().find(|tag| tag.code == code).map_or(b"", |tag| tag.text)
    }

    pub(super) fn number(&self, code: i32) -> Option<f64> {
        number(self.text(code))
    }

    /// Numbers of two codes.
    pub(super) fn pair(&self, codes: [i32; 2]) -> Option<[f64; 2]> {
        Some([self.number(codes[0])?, self.number(codes[1])?])
    }

    /// True if a bit of the flags of a line is set; `None` when the flags are damaged.
    pub(super) fn flag(&self, bit: u32) -> Option<bool> {
        let is_line = [&b"POLYLINE"[..], b"LWPOLYLINE", b"VERTEX"].contains(&&self.kind[..]);
        if is_line && self.has(70) { self.number(70).map(|flags| flags as u32 & bit != 0) } else { Some(false) }
    }

    /// Value of a variable of the header.
    fn variable(&self, name: &[u8]) -> Option<&'a [u8]> {
        let at = self.tags.iter().position(|tag| tag.code == 9 && tag.text.eq_ignore_ascii_case(name))?;
        Some(self.tags.get(at + 1)?.text)
    }

    fn has(&self, code: i32) -> bool {
        self.tags.iter().any(|tag| tag.code == code)
    }

    /// True if it is drawn as seen from above, and once. Lines and points have coordinates in space instead.
    pub(super) fn is_plain(&self) -> bool {
        if ![&b"INSERT"[..], b"POLYLINE", b"LWPOLYLINE", b"ARC", b"CIRCLE"].contains(&&self.kind[..]) {
            return true;
        }
        let is = |code, wanted: f64| !self.has(code) || self.number(code).is_some_and(|n| (n - wanted).abs() < FLAT);
        let is_array = self.kind == b"INSERT" && [70, 71].iter().any(|&code| self.number(code).unwrap_or(1.0) > 1.0);
        is(210, 0.0) && is(220, 0.0) && is(230, 1.0) && !is_array
    }

    /// True if it is drawn on a layer that requests cuts.
    pub(super) fn is_of_cuts(&self) -> bool {
        self.kind != b"INSERT" && !self.is_text() && matches!(self.layer(), Some(1 | 4 | 6 | 11 | 13 | 80..=83))
    }

    /// Number of its layer; `None` when the name is not a number.
    pub(super) fn layer(&self) -> Option<u32> {
        std::str::from_utf8(self.text(8)).ok()?.parse().ok()
    }

    /// Places of two codes, each with the number of its first group in the file.
    pub(super) fn places(&self, [x, y]: [i32; 2]) -> Vec<([f64; 2], u32)> {
        let mut places = Vec::new();
        let mut before = None;
        for (tag, place) in self.tags.iter().zip(self.number + 1..) {
            let value = || number(tag.text);
            if tag.code == x {
                before = value().map(|value| (value, place));
            } else if tag.code == y
                && let (Some((first, place)), Some(second)) = (before.take(), value())
            {
                places.push(([first, second], place));
            }
        }
        places
    }

    /// Each value of some codes, in order.
    pub(super) fn each(&self, codes: [i32; 3]) -> impl Iterator<Item = (i32, f64)> {
        let tags = self.tags.iter().filter(move |tag| codes.contains(&tag.code));
        tags.filter_map(|tag| Some((tag.code, number(tag.text)?)))
    }

    /// State of a layer that is off or frozen: true if it is frozen, so that blocks on it show nothing at all; `None` for a
    /// visible layer.
    fn frozen(&self) -> Option<bool> {
        let is_frozen = self.number(70).is_some_and(|flags| flags as u32 & 1 != 0);
        (is_frozen || self.number(62).is_some_and(|colour| colour < 0.0)).then_some(is_frozen)
    }

    pub(super) fn is_text(&self) -> bool {
        [&b"TEXT"[..], b"MTEXT", b"ATTDEF", b"ATTRIB"].contains(&&self.kind[..])
    }

    /// Value of a text under a key: the part behind `KEY:`, or the value of an attribute with that tag.
    pub(super) fn says(&self, key: &str) -> Option<&'a [u8]> {
        self.says_in(self.letters?, key)
    }

    /// Keys under which a text has a value when it is decoded with these letters.
    fn keys_in(&self, letters: Letters) -> impl Iterator<Item = &'static str> {
        ALSO.iter().map(|(key, _)| *key).filter(move |key| self.says_in(letters, key).is_some())
    }

    fn says_in(&self, letters: Letters, key: &str) -> Option<&'a [u8]> {
        if !self.is_text() {
            return None;
        }
        let also = ALSO.iter().find(|(word, _)| *word == key).map_or(&[][..], |(_, also)| also);
        let is_key = |name: &[u8]| {
            let name = letters.read(name).to_uppercase();
            let name = name.trim_end().trim_end_matches('.');
            let is = |word: &str| name.split_whitespace().eq(word.trim_end_matches('.').split_whitespace());
            is(key) || also.iter().any(|word| is(word))
        };
        let (text, is_count) = (self.text(1), key == "QUANTITY");
        if self.kind == b"MTEXT" {
            return behind(text, is_count, is_key);
        }
        match colon(text, is_key).or_else(|| bare_count(text).filter(|(name, _)| is_count && is_key(name))) {
            Some((name, value)) if is_key(name) => Some(value.trim_ascii()).filter(|text| !text.is_empty()),
            None if self.kind != b"TEXT" && is_key(self.text(2)) => Some(text).filter(|text| !text.is_empty()),
            _ => None,
        }
    }
}

/// Both sides of the colon of a line: a full-width colon, in UTF-8 or a code page, behind a key; otherwise the first plain
/// colon.
fn colon(line: &[u8], is_key: impl Fn(&[u8]) -> bool) -> Option<(&[u8], &[u8])> {
    for at in 0..line.len() {
        let (name, rest) = line.split_at(at);
        let wide = [&b"\xef\xbc\x9a"[..], b"\xa3\xba", b"\xa1\x47", b"\x81\x46"];
        let value = wide.iter().find_map(|colon| rest.strip_prefix(*colon));
        if let Some(value) = value.filter(|_| is_key(name)) {
            return Some((name, value));
        }
    }
    let at = line.iter().position(|&byte| byte == b':')?;
    Some((&line[..at], &line[at + 1..]))
}

/// Name and value of a count without a colon: the texts before and behind the first blank or `=` that precedes a digit.
fn bare_count(line: &[u8]) -> Option<(&[u8], &[u8])> {
    let at = line.windows(2).position(|pair| matches!(pair[0], b' ' | b'=') && pair[1].is_ascii_digit())?;
    let name = line[..at].trim_ascii_end();
    let is_sign = |byte: &u8| matches!(byte, b'=' | b'-') && line[at] == b' ';
    let name = name.split_last().filter(|(last, _)| is_sign(last)).map_or(name, |(_, name)| name);
    Some((name.trim_ascii_end(), &line[at + 1..]))
}

/// Value behind a key and its colon in a text with lines that end at `\P`, and with formatting codes in backslashes and braces.
fn behind(mut text: &[u8], is_count: bool, is_key: impl Fn(&[u8]) -> bool) -> Option<&[u8]> {
    while !text.is_empty() {
        let end = text.windows(2).position(|pair| pair == b"\\P").unwrap_or(text.len());
        let line = &text[..end];
        let count = || bare_count(bare(line)).filter(|(name, _)| is_count && is_key(name));
        if let Some((name, value)) = colon(line, |name| is_key(bare(name))).or_else(count) {
            let value = bare(value).split(|&byte| byte == b'}').next().unwrap_or_default().trim_ascii();
            if is_key(bare(name)) && !value.is_empty() {
                return Some(value);
            }
        }
        text = text.get(end + 2..).unwrap_or_default();
    }
    None
}

/// Text behind its leading codes: `{`, single letters for lines at the letters, or longer codes up to a `;`.
fn bare(text: &[u8]) -> &[u8] {
    let text = text.trim_ascii_start();
    match text {
        [b'{', rest @ ..] | [b'\\', b'L' | b'l' | b'O' | b'o' | b'K' | b'k', rest @ ..] => bare(rest),
        [b'\\', b'A' | b'C' | b'c' | b'F' | b'f' | b'H' | b'Q' | b'p' | b'T' | b'W', rest @ ..] => {
            rest.iter().position(|&byte| byte == b';').map_or(text, |end| bare(&rest[end + 1..]))
        }
        _ => text,
    }
}

fn number(text: &[u8]) -> Option<f64> {
    std::str::from_utf8(text).ok()?.parse().ok()
}

impl Sheet<'_> {
    /// True if an item of the sheet requests cuts, or may.
    pub(super) fn asks_for_cuts(&self) -> bool {
        let is_part = |item: &Item| item.kind == b"VERTEX" || item.kind == b"SEQEND";
        self.items.iter().any(|item| item.is_of_cuts() && !is_part(item) || item.kind == b"INSERT")
    }

    /// Value of the first of its texts under a key.
    pub(super) fn says(&self, key: &str) -> Option<&[u8]> {
        self.items.iter().find_map(|item| item.says(key))
    }
}

/// Contents of a file.
#[derive(Debug)]
pub(super) struct File<'a> {
    pub(super) blocks: Vec<Sheet<'a>>,
    /// Items outside blocks.
    pub(super) loose: Sheet<'a>,
    /// Number of the unit in the header.
    pub(super) unit: Option<f64>,
    /// Encoding of the texts.
    pub(super) letters: Letters,
    /// Layers that are off or frozen, by name; true for frozen ones.
    pub(super) hidden: BTreeMap<Vec<u8>, bool>,
}

/// Finds the encoding in which the most texts have a value, and sets it for all items.
fn lettered(items: &mut [Item], labels: &Labels) -> Letters {
    let page = items.iter().find_map(|item| item.variable(b"$DWGCODEPAGE"));
    let is_foreign = |item: &&Item| item.is_text() && item.tags.iter().any(|tag| !tag.text.is_ascii());
    let foreign: Vec<&Item> = items.iter().filter(is_foreign).collect();
    let said = |letters: Letters| {
        let keys = |(k, item): (usize, &&Item)| item.keys_in(letters).map(move |key| (k, key)).collect::<Vec<_>>();
        foreign.iter().enumerate().flat_map(keys).collect::<Vec<_>>()
    };
    let letters = Letters::of(page.unwrap_or_default(), labels, said);
    for item in items {
        item.letters = Some(letters);
    }
    letters
}

/// Reads a file.
pub(super) fn sheets<'a>(bytes: &'a [u8], labels: &Labels) -> File<'a> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    // Some programs end lines with a carriage return alone.
    let end = if bytes.contains(&b'\n') { b'\n' } else { b'\r' };
    let lines: Vec<&[u8]> = bytes.split(|&byte| byte == end).map(<[u8]>::trim_ascii).collect();
    let mut items: Vec<Item> = Vec::new();
    for (pair, number) in lines.chunks_exact(2).zip(1..) {
        let Some(code) = std::str::from_utf8(pair[0]).ok().and_then(|code| code.parse().ok()) else { break };
        match items.last_mut() {
            _ if code == 0 => {
                items.push(Item { kind: pair[1].to_ascii_uppercase(), number, tags: Vec::new(), letters: None });
            }
            Some(item) => item.tags.push(Tag { code, text: pair[1] }),
            None => {}
        }
    }
    let letters = lettered(&mut items, labels);
    let (mut blocks, mut loose): (Vec<Sheet>, Sheet) = (Vec::new(), Sheet::default());
    let (mut section, mut is_in_block, mut unit, mut hidden) = (Vec::new(), false, None, BTreeMap::new());
    // Items with 1 in group 67 are on the sheet around the drawing; of these only texts matter.
    let is_part =
        |item: &Item| [&b"VERTEX"[..], b"SEQEND", b"SECTION", b"ENDSEC", b"BLOCK", b"ENDBLK"].contains(&&item.kind[..]);
    let is_drawn = |item: &Item| item.number(67) != Some(1.0) || item.is_text() || is_part(item);
    // Attributes follow their insertion and are on the same sheet.
    let mut is_on_paper = false;
    for item in items {
        is_on_paper = if item.kind == b"ATTRIB" { is_on_paper } else { !is_drawn(&item) };
        if is_on_paper {
            continue;
        }
        match &item.kind[..] {
            b"SECTION" => {
                section = item.text(2).to_ascii_uppercase();
                if section == b"HEADER" {
                    unit = unit.or(item.variable(b"$INSUNITS").and_then(number));
                }
            }
            b"ENDSEC" => section.clear(),
            b"LAYER" if section == b"TABLES" => {
                hidden.extend(item.frozen().map(|frozen| (item.text(2).to_vec(), frozen)));
            }
            b"BLOCK" => {
                is_in_block = true;
                let base = if item.has(10) || item.has(20) { item.pair([10, 20]) } else { Some([0.0; 2]) };
                blocks.push(Sheet {
                    name: item.text(2).to_ascii_uppercase(),
                    number: item.number,
                    base,
                    items: Vec::new(),
                });
            }
            b"ENDBLK" => is_in_block = false,
            _ if is_in_block => blocks.last_mut().into_iter().for_each(|block| block.items.push(item.clone())),
            _ if section == b"ENTITIES" => loose.items.push(item),
            _ => {}
        }
    }
    File { blocks, loose, unit, letters, hidden }
}
