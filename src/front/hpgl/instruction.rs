//! Table of the known instructions.

use super::page::End;

/// Effect of an instruction on lines.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Instruction {
    /// IN: reset to the power-on state.
    Initialize,
    /// BP: reset as by IN, with a title among its values.
    Begin,
    /// DF: reset of modes; pen, position, corners and rotation stay.
    Default,
    /// PA, PR: the following coordinates are absolute or relative.
    Absolute,
    Relative,
    /// PU, PD.
    Up,
    Down,
    /// SP.
    Pen,
    /// PE.
    Encoded,
    /// AA, AR: an arc, by centre and sweep.
    ArcAbsolute,
    ArcRelative,
    /// AT, RT: an arc through two points.
    ArcThroughAbsolute,
    ArcThroughRelative,
    /// CI.
    Circle,
    /// BZ, BR.
    BezierAbsolute,
    BezierRelative,
    /// EA, ER.
    RectangleAbsolute,
    RectangleRelative,
    /// EW.
    Wedge,
    /// PM.
    Polygon,
    /// EP.
    EdgePolygon,
    /// SC, IP, IR, RO, PS.
    Scale,
    Corners,
    CornersPercent,
    Rotate,
    PageSize,
    /// PG, AF, AH, FR, EC: the page ends.
    Page(End),
    /// LB, DT.
    Label,
    Terminator,
    /// BL stores a text, PB draws it.
    Buffer,
    PrintBuffer,
    /// WD: a text for the plotter's display.
    Display,
    /// CO, MG: a text without output on paper.
    Comment,
    /// SM: a character drawn at each point.
    Symbol,
    /// DI, DR: direction of labels.
    Direction,
    /// Draws but is ignored, with a description.
    LeftOut(&'static str),
    /// Draws but is ignored, with a description; also moves the pen by the size of letters, which is unknown.
    Letters(&'static str),
    /// No effect on lines.
    Housekeeping,
    /// Missing in this table.
    Unknown,
}

/// Content after a mnemonic.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Tail {
    /// Numbers, or nothing.
    Numbers,
    /// A text up to the label terminator.
    Text,
    /// A text in quotes, or up to the label terminator.
    Display,
    /// A byte that becomes the label terminator.
    Terminator,
    /// One byte.
    Character,
    /// A text in quotes.
    Quoted,
    /// Numbers and quoted texts.
    Values,
    /// Numbers with digits of base 64 or 32.
    Encoded,
}

impl Instruction {
    /// True for PU, PD, PA and PR.
    pub(super) fn is_move(self) -> bool {
        matches!(self, Self::Up | Self::Down | Self::Absolute | Self::Relative)
    }

    /// Content after its mnemonic.
    pub(super) fn tail(self) -> Tail {
        match self {
            Self::Label | Self::Buffer => Tail::Text,
            Self::Display => Tail::Display,
            Self::Terminator => Tail::Terminator,
            Self::Symbol => Tail::Character,
            Self::Comment => Tail::Quoted,
            Self::Begin => Tail::Values,
            Self::Encoded => Tail::Encoded,
            Self::Initialize
            | Self::Default
            | Self::Absolute
            | Self::Relative
            | Self::Up
            | Self::Down
            | Self::Pen
            | Self::ArcAbsolute
            | Self::ArcRelative
            | Self::ArcThroughAbsolute
            | Self::ArcThroughRelative
            | Self::Circle
            | Self::BezierAbsolute
            | Self::BezierRelative
            | Self::RectangleAbsolute
            | Self::RectangleRelative
            | Self::Wedge
            | Self::Polygon
            | Self::EdgePolygon
            | Self::Scale
            | Self::Corners
            | Self::CornersPercent
            | Self::Rotate
            | Self::PageSize
            | Self::Page(_)
            | Self::PrintBuffer
            | Self::Direction
            | Self::LeftOut(_)
            | Self::Letters(_)
            | Self::Housekeeping
            | Self::Unknown => Tail::Numbers,
        }
    }
}

/// True if the instruction with a mnemonic draws or writes at the place of the pen, or ends a page there.
pub(super) fn serves_place(mnemonic: [u8; 2]) -> bool {
    match instruction(mnemonic) {
        Instruction::Down
        | Instruction::Encoded
        | Instruction::ArcAbsolute
        | Instruction::ArcRelative
        | Instruction::ArcThroughAbsolute
        | Instruction::ArcThroughRelative
        | Instruction::Circle
        | Instruction::BezierAbsolute
        | Instruction::BezierRelative
        | Instruction::RectangleAbsolute
        | Instruction::RectangleRelative
        | Instruction::Wedge
        | Instruction::Polygon
        | Instruction::EdgePolygon
        | Instruction::Page(_)
        | Instruction::Label
        | Instruction::PrintBuffer
        | Instruction::Symbol => true,
        _ => matches!(&mnemonic, b"FP" | b"RA" | b"RR" | b"UC" | b"WG" | b"XT" | b"YT"),
    }
}

/// The instruction with a mnemonic, which must be in upper case.
pub(super) fn instruction(mnemonic: [u8; 2]) -> Instruction {
    match &mnemonic {
        b"PD" => Instruction::Down,
        b"PU" => Instruction::Up,
        b"PA" => Instruction::Absolute,
        b"PR" => Instruction::Relative,
        b"SP" => Instruction::Pen,
        b"PE" => Instruction::Encoded,
        b"IN" => Instruction::Initialize,
        b"BP" => Instruction::Begin,
        b"DF" => Instruction::Default,
        b"AA" => Instruction::ArcAbsolute,
        b"AR" => Instruction::ArcRelative,
        b"AT" => Instruction::ArcThroughAbsolute,
        b"RT" => Instruction::ArcThroughRelative,
        b"CI" => Instruction::Circle,
        b"BZ" => Instruction::BezierAbsolute,
        b"BR" => Instruction::BezierRelative,
        b"EA" => Instruction::RectangleAbsolute,
        b"ER" => Instruction::RectangleRelative,
        b"EW" => Instruction::Wedge,
        b"PM" => Instruction::Polygon,
        b"EP" => Instruction::EdgePolygon,
        b"SC" => Instruction::Scale,
        b"IP" => Instruction::Corners,
        b"IR" => Instruction::CornersPercent,
        b"RO" => Instruction::Rotate,
        b"PS" => Instruction::PageSize,
        b"PG" | b"AF" | b"AH" => Instruction::Page(End::Out),
        b"FR" => Instruction::Page(End::Frame),
        b"EC" => Instruction::Page(End::CutOff),
        b"LB" => Instruction::Label,
        b"DT" => Instruction::Terminator,
        b"BL" => Instruction::Buffer,
        b"PB" => Instruction::PrintBuffer,
        b"WD" => Instruction::Display,
        b"CO" | b"MG" => Instruction::Comment,
        b"DI" | b"DR" => Instruction::Direction,
        b"UC" => Instruction::Letters("a drawn character"),
        b"CP" => Instruction::Letters("a move by characters"),
        b"FT" => Instruction::LeftOut("a fill pattern"),
        b"RA" | b"RR" => Instruction::LeftOut("a filled rectangle"),
        b"WG" => Instruction::LeftOut("a filled wedge"),
        b"FP" => Instruction::LeftOut("a filled polygon"),
        b"CS" | b"SS" => Instruction::LeftOut("a character set"),
        b"RP" => Instruction::LeftOut("more copies of the plot"),
        b"SM" => Instruction::Symbol,
        b"IW" => Instruction::LeftOut("a window that clips lines"),
        b"AC" | b"AD" | b"AP" | b"AS" | b"CA" | b"CF" | b"CM" | b"CR" | b"CT" | b"CV" | b"DC" | b"DP" | b"DV"
        | b"ES" | b"FI" | b"FN" | b"FS" | b"GC" | b"GM" | b"IM" | b"LA" | b"LM" | b"LO" | b"LT" | b"MC" | b"MT"
        | b"NP" | b"NR" | b"OA" | b"OC" | b"OD" | b"OE" | b"OF" | b"OH" | b"OI" | b"OO" | b"OP" | b"OS" | b"OT"
        | b"OW" | b"PC" | b"PP" | b"PT" | b"PW" | b"QL" | b"RF" | b"SA" | b"SB" | b"SD" | b"SI" | b"SL" | b"SR"
        | b"ST" | b"SV" | b"TD" | b"TL" | b"TR" | b"UL" | b"VA" | b"VN" | b"VS" | b"WU" | b"XT" | b"YT" => {
            Instruction::Housekeeping
        }
        _ => Instruction::Unknown,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_draws_and_is_left_out_is_told_from_what_does_not_draw() {
        assert_eq!(instruction(*b"PD"), Instruction::Down);
        assert_eq!(instruction(*b"VS"), Instruction::Housekeeping);
        assert!(matches!(instruction(*b"RA"), Instruction::LeftOut(_)));
        assert_eq!(instruction(*b"QQ"), Instruction::Unknown);
        assert!([*b"PD", *b"CI", *b"RR", *b"XT", *b"LB"].into_iter().all(serves_place));
        assert!(![*b"PU", *b"PA", *b"SP", *b"VS", *b"FT", *b"CP"].into_iter().any(serves_place));
    }
}
