//! Keys: words that introduce facts in the texts of a file, in the languages of CAD systems.

/// Fact stated by a text.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Key {
    Size,
    SampleSize,
    Units,
    Quantity,
    PieceName,
    Author,
}

/// The keys in the languages of CAD systems, in capitals with one blank between words. Texts may omit or add a final full stop.
/// The manual lists them.
#[rustfmt::skip] // a table: one row per fact
pub(super) const KEYS: [(Key, &[&str]); 6] = [
    (Key::Size, &["SIZE", "SIZE NAME", "SIZE NO.", "SZ.", "GRÖSSE", "GROESSE", "GROSSE", "GR.", "TAILLE", "TAGLIA", "MISURA", "TALLA", "TAMAÑO", "TAMANO", "TAMANHO", "MAAT", "ROZMIAR", "VELIKOST", "VEĽKOSŤ", "VELKOST", "MÉRET", "MERET", "MĂRIME", "MĂRIMEA", "MARIME", "MARIMEA", "BEDEN", "STORLEK", "STØRRELSE", "STOERRELSE", "РАЗМЕР", "РОЗМІР", "尺码", "尺碼", "号型", "號型", "码数", "碼數", "サイズ", "사이즈", "치수"]),
    (Key::SampleSize, &["SAMPLE SIZE", "BASE SIZE", "BASIC SIZE", "BASISGRÖSSE", "BASISGROESSE", "GRUNDGRÖSSE", "GRUNDGROESSE", "TAILLE DE BASE", "TAGLIA BASE", "TALLA BASE", "TAMANHO BASE", "BASISMAAT", "ROZMIAR BAZOWY", "ZÁKLADNÍ VELIKOST", "ZAKLADNI VELIKOST", "ZÁKLADNÁ VEĽKOSŤ", "ZAKLADNA VELKOST", "ALAPMÉRET", "ALAPMERET", "MĂRIME DE BAZĂ", "MĂRIMEA DE BAZĂ", "MARIME DE BAZA", "MARIMEA DE BAZA", "BAZ BEDEN", "ANA BEDEN", "BASSTORLEK", "GRUNDSTORLEK", "BASISSTØRRELSE", "GRUNDSTØRRELSE", "GRUNNSTØRRELSE", "БАЗОВЫЙ РАЗМЕР", "БАЗОВИЙ РОЗМІР", "БАЗОВ РАЗМЕР", "基码", "基碼", "基本码", "基本尺码", "基本尺碼", "样板尺码", "樣板尺碼", "基準サイズ", "ベースサイズ", "標準サイズ", "기준사이즈", "기준 사이즈", "기본사이즈", "기본 사이즈"]),
    (Key::Units, &["UNITS", "UNIT", "EINHEIT", "EINHEITEN", "UNITÉ", "UNITÉS", "UNITE", "UNITES", "UNITÀ", "UNITA", "UNIDAD", "UNIDADES", "UNIDADE", "单位", "EENHEID", "EENHEDEN", "JEDNOSTKA", "JEDNOSTKI", "BIRIM", "BİRİM", "ЕДИНИЦЫ", "ОДИНИЦІ"]),
    (Key::Quantity, &["QUANTITY", "PIECE QUANTITY", "CUT QUANTITY", "CUT", "QTY", "PIECE QTY", "CUT QTY", "PIECES", "PCS", "ANZAHL", "MENGE", "STÜCK", "STUECK", "STÜCKZAHL", "STUECKZAHL", "STCK", "STK", "ANZ.", "QUANTITÉ", "QUANTITE", "QTÉ", "QTE", "NOMBRE DE PIÈCES", "NOMBRE DE PIECES", "QUANTITÀ", "QUANTITA", "Q.TÀ", "Q.TA", "QTÀ", "QTA", "PEZZI", "NUMERO PEZZI", "CANTIDAD", "CANTIDAD DE PIEZAS", "CANT.", "PIEZAS", "QUANTIDADE", "QUANTIDADE DE PEÇAS", "QTD", "QTDE", "AANTAL", "AANTAL STUKS", "STUKS", "ILOŚĆ", "ILOSC", "ILOŚĆ SZTUK", "ILOSC SZTUK", "LICZBA SZTUK", "SZT.", "POČET", "POCET", "POČET KUSŮ", "POCET KUSU", "POČET KUSOV", "POCET KUSOV", "MNOŽSTVÍ", "MNOZSTVI", "MNOŽSTVO", "MNOZSTVO", "MENNYISÉG", "MENNYISEG", "DARAB", "DARABSZÁM", "DARABSZAM", "DB", "CANTITATE", "CANTITATEA", "BUC.", "BUCĂȚI", "BUCATI", "ADET", "MİKTAR", "MIKTAR", "ANTAL", "ANTAL DELAR", "ANTALL", "КОЛИЧЕСТВО", "КОЛИЧЕСТВО ДЕТАЛЕЙ", "КОЛ-ВО", "КОЛ-ВО ДЕТАЛЕЙ", "КОЛ.", "К-ВО", "КІЛЬКІСТЬ", "КІЛЬКІСТЬ ДЕТАЛЕЙ", "К-СТЬ", "К-ТЬ", "БРОЙ", "数量", "數量", "份数", "份數", "片数", "片數", "件数", "件數", "裁片数", "裁片數", "裁片数量", "裁片數量", "枚数", "枚數", "個数", "수량", "매수", "장수"]),
    (Key::PieceName, &["PIECE NAME", "TEILENAME", "TEIL", "NOM DE PIÈCE", "NOM DE PIECE", "NOME PEZZO", "NOMBRE DE PIEZA", "NOME DA PEÇA", "裁片名称", "ONDERDEEL", "NAZWA CZĘŚCI", "NAZWA CZESCI", "PARÇA", "PARCA", "ДЕТАЛЬ", "НАЗВА ДЕТАЛІ"]),
    (Key::Author, &["AUTHOR", "PRODUCT", "PRODUCT NAME"]),
];

/// The fact of a key, ignoring case.
pub(super) fn key(text: &str) -> Option<Key> {
    // The capital form of the sharp s is two letters, so both spellings match.
    let text = text.to_uppercase();
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    let text = text.trim_end_matches('.').trim_end();
    let is_word = |word: &&str| word.trim_end_matches('.') == text;
    KEYS.iter().find(|(_, words)| words.iter().any(is_word)).map(|(key, _)| *key)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_are_known_in_several_languages_however_they_are_written() {
        for text in ["Size Name", " size  name ", "Größe", "GROESSE", "taille", "尺码"] {
            assert_eq!(key(text), Some(Key::Size), "{text}");
        }
        for text in ["Tamaño", "TAMANO", "Misura", "Gr.", "GROSSE", "große", "Maat", "Розмір", "Размер"] {
            assert_eq!(key(text), Some(Key::Size), "{text}");
        }
        assert_eq!([key("Qty"), key("Quantité"), key("cantidad")], [Some(Key::Quantity); 3]);
        for text in ["QTE", "Stück", "Stueck", "Stückzahl", "STUECKZAHL", "Anz.", "Qtd", "Q.tà", "份数", "裁片数量"]
        {
            assert_eq!(key(text), Some(Key::Quantity), "{text}");
        }
        assert_eq!([key("Basisgröße"), key("Sample Size")], [Some(Key::SampleSize); 2]);
        for text in ["Stck", "Кол-во", "Кол.", "кол", "Cut Quantity", "Pezzi", "Cant", "片数", "數量", "Antal", "Darab"]
        {
            assert_eq!(key(text), Some(Key::Quantity), "{text}");
        }
        assert_eq!([key("SIZES"), key(""), key(".")], [None; 3]);
    }
}
