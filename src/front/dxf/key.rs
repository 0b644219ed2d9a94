//! Keys: the words by which texts of a file say facts, in the languages of CAD systems.

/// What a text says.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Key {
    Size,
    SampleSize,
    Units,
    Quantity,
    PieceName,
    Author,
}

/// The keys in English, German, French, Italian, Spanish, Portuguese, Dutch, Polish, Turkish, Russian, Ukrainian and Chinese,
/// in capitals with one blank between words.
#[rustfmt::skip] // a table: a row a fact
const KEYS: [(Key, &[&str]); 6] = [
    (Key::Size, &["SIZE", "SIZE NAME", "GRÖSSE", "GROESSE", "TAILLE", "TAGLIA", "TALLA", "TAMANHO", "TAMAÑO", "TAMANO", "MISURA", "GR.", "GROSSE", "MAAT", "ROZMIAR", "BEDEN", "РАЗМЕР", "РОЗМІР", "尺码", "号型"]),
    (Key::SampleSize, &["SAMPLE SIZE", "BASE SIZE", "BASISGRÖSSE", "BASISGROESSE", "GRUNDGRÖSSE", "GRUNDGROESSE", "TAILLE DE BASE", "TAGLIA BASE", "TALLA BASE", "TAMANHO BASE", "基码", "样板尺码", "BASISMAAT", "ROZMIAR BAZOWY", "BAZ BEDEN", "БАЗОВЫЙ РАЗМЕР", "БАЗОВИЙ РОЗМІР"]),
    (Key::Units, &["UNITS", "UNIT", "EINHEIT", "EINHEITEN", "UNITÉ", "UNITÉS", "UNITE", "UNITES", "UNITÀ", "UNITA", "UNIDAD", "UNIDADES", "UNIDADE", "单位", "EENHEID", "EENHEDEN", "JEDNOSTKA", "JEDNOSTKI", "BIRIM", "BİRİM", "ЕДИНИЦЫ", "ОДИНИЦІ"]),
    (Key::Quantity, &["QUANTITY", "QTY", "QTY.", "ANZAHL", "MENGE", "QUANTITÉ", "QUANTITE", "QTÉ", "QUANTITÀ", "QUANTITA", "CANTIDAD", "CANT.", "QUANTIDADE", "QTE", "STÜCK", "STUECK", "STÜCKZAHL", "STUECKZAHL", "ANZ.", "QTD", "Q.TÀ", "PIECES", "PCS", "AANTAL", "ILOŚĆ", "ILOSC", "ADET", "КОЛИЧЕСТВО", "КІЛЬКІСТЬ", "数量", "份数", "裁片数量"]),
    (Key::PieceName, &["PIECE NAME", "TEILENAME", "TEIL", "NOM DE PIÈCE", "NOM DE PIECE", "NOME PEZZO", "NOMBRE DE PIEZA", "NOME DA PEÇA", "裁片名称", "ONDERDEEL", "NAZWA CZĘŚCI", "NAZWA CZESCI", "PARÇA", "PARCA", "ДЕТАЛЬ", "НАЗВА ДЕТАЛІ"]),
    (Key::Author, &["AUTHOR", "PRODUCT", "PRODUCT NAME"]),
];

/// The fact of a key that is written in any letters.
pub(super) fn key(text: &str) -> Option<Key> {
    // Capitals of the sharp s are two letters, and so a key may be written either way.
    let text = text.to_uppercase();
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    KEYS.iter().find(|(_, words)| words.contains(&text.as_str())).map(|(key, _)| *key)
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
        assert_eq!([key("SIZES"), key("")], [None; 2]);
    }
}
