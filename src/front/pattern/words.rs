//! Manual entries on pattern DXF.

use crate::front::Word;

/// The layers, entities and texts of pattern DXF and their effects.
#[rustfmt::skip] // a table: one row per line
pub(super) const WORDS: &[Word] = &[
    Word { words: "layer 1; layer 11", about: "outlines and cut-outs, cut; polylines, or lines whose ends meet within 0.2 mm; an outline that does not close is refused. Three or more outlines inside one another, such as sizes drawn over each other in one block, are refused. A line that leads away from an outline is a slit: the outline goes along it and back" },
    Word { words: "layer 4; layers 80 to 83", about: "notches, as points on the outline: a slit, or a V when it has a width (group 39); T, castle, check (cut as a V) and U. Depth is group 30 whatever its sign, else `dxf.notch_mm`; the direction is group 50, else into the part. Lines on these layers are not cut, and that is told. A point at a notch that the outline already has adds no second one; a warning says so" },
    Word { words: "layer 6", about: "fold line of half a piece: outline, notches, holes, cut-outs, internal and seam lines are on both sides, and the fold is not cut. It lies within 0.2 mm along an edge of the outline, about which all is mirrored. A piece without a fold line whose text says `ON FOLD`, `IM BRUCH`, `AU PLI` or the like is cut as drawn, with a warning" },
    Word { words: "layer 13", about: "drill holes, as points or circles, one where both are: drill 1. Other lines there are told and not drilled" },
    Word { words: "layers 5, 7, 8, 14, 15 and all others", about: "drawn, not cut: grade references, grain lines, internal lines, seam lines (`cutc sew --line 14`), annotations. A point on no layer of this list, and a line on none, are told" },
    Word { words: "layers 84 to 87", about: "the curves of layers 1, 8, 11 and 14 in fine chords: cut or sewn in their stead where all vertices of a line lie on one of them, within 0.01 mm, and it has more. One that leads from a vertex of a line to another replaces the edges between them if the vertices there lie on it, within 0.05 mm. One that misses vertices is not used, with a warning, unless it is the control polygon of a line that is fine itself: it has at most half of the vertices as its own, and the chords at half of the curve points or more are within 0.2 mm of a curve" },
    Word { words: "layers 2, 3", about: "turn points and curve points: where a line has no fine one, a curve is laid through the curve points from turn point to turn point, as the CAD system does that `AUTHOR:` names: Gerber AccuMark, Richpeace or CLO, else as a natural spline, with a warning. It is straight where no curve point stands between. A size without such points has those of another size of its piece (`PIECE NAME:`). `dxf.curves` says otherwise" },
    Word { words: "`POLYLINE`, `LWPOLYLINE`, `LINE`, `ARC`, `CIRCLE`, `POINT`", about: "read; bulges and arcs as chords within a quarter of the tolerance; control points of splines are passed over" },
    Word { words: "`TEXT`, `MTEXT`, `ATTDEF`, `ATTRIB`", about: "labels; never cut. What they say is read from the lines of an MTEXT, too, and codes such as `\\U+00F6`, `\\M+5B3DF` and `%%d` stand for their letters" },
    Word { words: "`INSERT`", about: "places, mirrors and turns a block; one that scales it, puts rows and columns of it or inserts into another block what is cut there is refused; when all of them are at the origin, or most pieces would lie on each other, the pieces lie in a row. A block whose name begins with `*` is a piece only where one puts it. An INSERT without its block is reported, and so is a group code that INSERT or POINT cannot have" },
    Word { words: "`SIZE:`, `SIZE NAME:`, `SAMPLE SIZE:`, `SIZE=`, `SIZE 36`", about: "the size of a block, where an attribute of its INSERT holds before a text; the size that is cut unless `--size` says otherwise, one in all of the file. Sizes that INSERTs place beside each other are all cut" },
    Word { words: "`QUANTITY:`, `QTY:`, `QUANTITY=`, `QUANTITY 2`", about: "how often a piece is cut, `1,1` = right and left, which is mirrored; of `2x`, `2 PCS`, `2 SELF` and `2 (1 PAIR)` the number holds, with a warning; other forms with several numbers (`1+1`, `L1 R1`) are refused; an attribute of its INSERT holds before a text of its block; where INSERTs place it they say how often; `dxf.quantity` or `--quantity one` says otherwise" },
    Word { words: "`UNITS:`", about: "`METRIC` = mm, `CM` = cm, `ENGLISH` = inch; else what `$INSUNITS` of the header says, else mm, with a warning; `dxf.unit` says otherwise. A unit of the header that would make a line longer than 30 m is taken for mm, with a warning" },
    Word { words: "keys of a size", about: "`SIZE`, `SIZE NAME`, `SIZE NO.`, `SZ.`, `GRÖSSE`, `GROESSE`, `GROSSE`, `GR.`, `TAILLE`, `TAGLIA`, `MISURA`, `TALLA`, `TAMAÑO`, `TAMANO`, `TAMANHO`, `MAAT`, `ROZMIAR`, `VELIKOST`, `VEĽKOSŤ`, `VELKOST`, `MÉRET`, `MERET`, `MĂRIME`, `MĂRIMEA`, `MARIME`, `MARIMEA`, `BEDEN`, `STORLEK`, `STØRRELSE`, `STOERRELSE`, `РАЗМЕР`, `РОЗМІР`, `尺码`, `尺碼`, `号型`, `號型`, `码数`, `碼數`, `サイズ`, `사이즈`, `치수`" },
    Word { words: "keys of the sample size", about: "`SAMPLE SIZE`, `BASE SIZE`, `BASIC SIZE`, `BASISGRÖSSE`, `BASISGROESSE`, `GRUNDGRÖSSE`, `GRUNDGROESSE`, `TAILLE DE BASE`, `TAGLIA BASE`, `TALLA BASE`, `TAMANHO BASE`, `BASISMAAT`, `ROZMIAR BAZOWY`, `ZÁKLADNÍ VELIKOST`, `ZAKLADNI VELIKOST`, `ZÁKLADNÁ VEĽKOSŤ`, `ZAKLADNA VELKOST`, `ALAPMÉRET`, `ALAPMERET`, `MĂRIME DE BAZĂ`, `MĂRIMEA DE BAZĂ`, `MARIME DE BAZA`, `MARIMEA DE BAZA`, `BAZ BEDEN`, `ANA BEDEN`, `BASSTORLEK`, `GRUNDSTORLEK`, `BASISSTØRRELSE`, `GRUNDSTØRRELSE`, `GRUNNSTØRRELSE`, `БАЗОВЫЙ РАЗМЕР`, `БАЗОВИЙ РОЗМІР`, `БАЗОВ РАЗМЕР`, `基码`, `基碼`, `基本码`, `基本尺码`, `基本尺碼`, `样板尺码`, `樣板尺碼`, `基準サイズ`, `ベースサイズ`, `標準サイズ`, `기준사이즈`, `기준 사이즈`, `기본사이즈`, `기본 사이즈`" },
    Word { words: "keys of the unit", about: "`UNITS`, `UNIT`, `EINHEIT`, `EINHEITEN`, `UNITÉ`, `UNITÉS`, `UNITE`, `UNITES`, `UNITÀ`, `UNITA`, `UNIDAD`, `UNIDADES`, `UNIDADE`, `单位`, `EENHEID`, `EENHEDEN`, `JEDNOSTKA`, `JEDNOSTKI`, `BIRIM`, `BİRİM`, `ЕДИНИЦЫ`, `ОДИНИЦІ`" },
    Word { words: "keys of a quantity", about: "`QUANTITY`, `PIECE QUANTITY`, `CUT QUANTITY`, `CUT`, `QTY`, `PIECE QTY`, `CUT QTY`, `PIECES`, `PCS`, `ANZAHL`, `MENGE`, `STÜCK`, `STUECK`, `STÜCKZAHL`, `STUECKZAHL`, `STCK`, `STK`, `ANZ.`, `QUANTITÉ`, `QUANTITE`, `QTÉ`, `QTE`, `NOMBRE DE PIÈCES`, `NOMBRE DE PIECES`, `QUANTITÀ`, `QUANTITA`, `Q.TÀ`, `Q.TA`, `QTÀ`, `QTA`, `PEZZI`, `NUMERO PEZZI`, `CANTIDAD`, `CANTIDAD DE PIEZAS`, `CANT.`, `PIEZAS`, `QUANTIDADE`, `QUANTIDADE DE PEÇAS`, `QTD`, `QTDE`, `AANTAL`, `AANTAL STUKS`, `STUKS`, `ILOŚĆ`, `ILOSC`, `ILOŚĆ SZTUK`, `ILOSC SZTUK`, `LICZBA SZTUK`, `SZT.`, `POČET`, `POCET`, `POČET KUSŮ`, `POCET KUSU`, `POČET KUSOV`, `POCET KUSOV`, `MNOŽSTVÍ`, `MNOZSTVI`, `MNOŽSTVO`, `MNOZSTVO`, `MENNYISÉG`, `MENNYISEG`, `DARAB`, `DARABSZÁM`, `DARABSZAM`, `DB`, `CANTITATE`, `CANTITATEA`, `BUC.`, `BUCĂȚI`, `BUCATI`, `ADET`, `MİKTAR`, `MIKTAR`, `ANTAL`, `ANTAL DELAR`, `ANTALL`, `КОЛИЧЕСТВО`, `КОЛИЧЕСТВО ДЕТАЛЕЙ`, `КОЛ-ВО`, `КОЛ-ВО ДЕТАЛЕЙ`, `КОЛ.`, `К-ВО`, `КІЛЬКІСТЬ`, `КІЛЬКІСТЬ ДЕТАЛЕЙ`, `К-СТЬ`, `К-ТЬ`, `БРОЙ`, `数量`, `數量`, `份数`, `份數`, `片数`, `片數`, `件数`, `件數`, `裁片数`, `裁片數`, `裁片数量`, `裁片數量`, `枚数`, `枚數`, `個数`, `수량`, `매수`, `장수`" },
    Word { words: "keys of the name of a piece", about: "`PIECE NAME`, `TEILENAME`, `TEIL`, `NOM DE PIÈCE`, `NOM DE PIECE`, `NOME PEZZO`, `NOMBRE DE PIEZA`, `NOME DA PEÇA`, `裁片名称`, `ONDERDEEL`, `NAZWA CZĘŚCI`, `NAZWA CZESCI`, `PARÇA`, `PARCA`, `ДЕТАЛЬ`, `НАЗВА ДЕТАЛІ`" },
    Word { words: "keys of the CAD system", about: "`AUTHOR`, `PRODUCT`, `PRODUCT NAME`" },
    Word { words: "paper space (group 67)", about: "not cut, and told" },
    Word { words: "what is not shown (group 60, layers that are off or frozen)", about: "cut as all else, and told" },
    Word { words: "any other entity", about: "refused on a layer that is cut, else reported. What nothing cuts refuses nothing: an entity there that is damaged is left out, with a warning" },
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::front::pattern::key::{KEYS, Key};

    #[test]
    fn the_keys_that_are_listed_are_those_that_are_read() {
        for (key, words) in KEYS {
            let row = match key {
                Key::Size => "keys of a size",
                Key::SampleSize => "keys of the sample size",
                Key::Units => "keys of the unit",
                Key::Quantity => "keys of a quantity",
                Key::PieceName => "keys of the name of a piece",
                Key::Author => "keys of the CAD system",
            };
            let listed: Vec<&str> = WORDS.iter().filter(|word| word.words == row).map(|word| word.about).collect();
            let read = words.iter().map(|word| format!("`{word}`")).collect::<Vec<_>>().join(", ");
            assert_eq!(listed, [read], "{row}");
        }
    }
}
