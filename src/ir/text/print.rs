//! Printing.

use std::fmt::{self, Display, Formatter, Write as _};

use super::{ADVANCE_BY, ENDS, EVENTS, FORMS, JOINTS, KINDS, ORIENTATION_MODES, SHAPES, SIDES};
use crate::geom::Point;
use crate::ir::list::{FULL_SPEED, Joint, Range, Segment};
use crate::ir::marker::{CommonEdge, Cut, Label, Marker, NearEdge, NotchKind, OutlineNotch, Piece};
use crate::ir::toolpath::{Edge, End, Event, Overcut, PlungeCut, Pose, Run, Side, Step, Toolpath};
use crate::source::Span;
use crate::units::number::exact;

/// The text of a marker; [`read_marker`](super::read_marker) reads it back.
pub fn print_marker(marker: &Marker) -> String {
    let mut out = String::new();
    let moved = if marker.moved_on > 0 { format!(" moved-on {}", marker.moved_on) } else { String::new() };
    line(&mut out, format_args!("marker unit-mm {}{moved}", exact(marker.unit)));
    for piece in &marker.pieces {
        print_piece(&mut out, marker, piece);
    }
    for event in &marker.closing {
        line(&mut out, format_args!("closing {}{}", event_words(event.kind), At(event.span)));
    }
    for cut in &marker.cuts {
        print_cut(&mut out, marker, cut);
    }
    for CommonEdge { pieces, range, shift } in &marker.common {
        let [cut, spared] = pieces.map(|piece| piece + 1);
        line(&mut out, format_args!("common cut {cut} spared {spared} shift-mm {}", exact(*shift)));
        print_segments(&mut out, marker, *range);
    }
    for [from, to] in &marker.junctions {
        line(&mut out, format_args!("junction {} to {}", Xy(*from), Xy(*to)));
    }
    for NearEdge { piece, ends: [from, to] } in &marker.near {
        line(&mut out, format_args!("near piece {} {} to {}", piece + 1, Xy(*from), Xy(*to)));
    }
    out
}

fn print_piece(out: &mut String, marker: &Marker, piece: &Piece) {
    line(out, format_args!("piece {}{}{}", piece.number, OfCopy(piece.copy), At(piece.span)));
    for event in &piece.events {
        line(out, format_args!("event {}{}", event_words(event.kind), At(event.span)));
    }
    if let Some(feed) = piece.feed {
        line(out, format_args!("feed-mm-s {}", exact(feed)));
    }
    if let Some([from, to]) = piece.section {
        line(out, format_args!("section {} to {}", exact(from), exact(to)));
    }
    for drill in &piece.drills {
        line(out, format_args!("drill {} tool {}{}", Xy(drill.at), drill.tool, At(drill.span)));
    }
    for notch in &piece.notches {
        let (root, tip) = (Xy(notch.root), Xy(notch.tip));
        push(out, format_args!("slit {root} to {tip}{}{}", At(notch.span), Percent(notch.percent)));
        match notch.kind {
            NotchKind::Slit => out.push('\n'),
            NotchKind::T(bar) => line(out, format_args!(" bar {} to {}{}", Xy(bar.from), Xy(bar.to), At(bar.span))),
        }
    }
    for contour in &piece.contours {
        line(out, format_args!("contour {}", if contour.closed { "closed" } else { "open" }));
        print_segments(out, marker, contour.range);
    }
    for notch in &piece.outline_notches {
        print_outline_notch(out, notch);
    }
    for label in &piece.labels {
        print_label(out, label);
    }
    for field in &piece.fields {
        line(out, format_args!("field {}{}", char::from(field.letter), At(field.span)));
    }
}

fn print_outline_notch(out: &mut String, notch: &OutlineNotch) {
    let form = FORMS.iter().find(|row| row.1 == notch.form).map_or("", |row| row.0);
    let way = if notch.outwards { " out" } else { "" };
    let [before, tip, after] = [notch.mouth[0], notch.tip, notch.mouth[1]].map(Xy);
    push(out, format_args!("notch {form}{way} {before} to {tip} to {after}"));
    line(out, format_args!(" segments {}{}", notch.segments, At(notch.span)));
}

fn print_cut(out: &mut String, marker: &Marker, cut: &Cut) {
    let Cut { kind, piece, sides, range } = cut;
    let side = |side: Option<u32>| side.map_or("-".to_owned(), |part| (part + 1).to_string());
    let [left, right] = sides.map(side);
    push(out, format_args!("cut {} piece {} sides {left} {right}", word(&KINDS, *kind), piece + 1));
    let contours = &marker.pieces[*piece as usize].contours;
    if let Some(contour) = contours.iter().position(|contour| contour.range == *range) {
        line(out, format_args!(" contour {}", contour + 1));
    } else {
        out.push('\n');
        print_segments(out, marker, *range);
    }
}

fn print_segments(out: &mut String, marker: &Marker, range: Range) {
    let mut end = None;
    for (_, segment) in marker.list.walk(range) {
        print_segment(out, &segment, end);
        end = Some(segment.to);
    }
}

fn print_segment(out: &mut String, segment: &Segment, end: Option<Point>) {
    out.push_str("  ");
    if end != Some(segment.from) {
        push(out, format_args!("from {} ", Xy(segment.from)));
    }
    push(out, format_args!("to {}{}", Xy(segment.to), At(segment.span)));
    line(out, format_args!("{}{}", Percent(segment.percent), Asked(segment.joint)));
}

fn print_label(out: &mut String, label: &Label) {
    out.push_str("label");
    if let Some(at) = label.at {
        push(out, format_args!(" at {}", Xy(at)));
    }
    if let Some(heading) = label.heading {
        push(out, format_args!(" heading-rad {}", exact(heading.radians())));
    }
    push(out, format_args!("{}", At(label.span)));
    if let Some(mirrored) = label.mirrored {
        push(out, format_args!(" mirrored{}", At(mirrored)));
    }
    out.push('\n');
}

/// The text of a sound toolpath; [`read_toolpath`](super::read_toolpath) reads it back.
pub fn print_toolpath(toolpath: &Toolpath) -> String {
    let mut out = String::new();
    let Toolpath { piece, part, tolerance, entry, steps } = toolpath;
    push(&mut out, format_args!("toolpath piece {piece}"));
    if *part > 0 {
        push(&mut out, format_args!(" part {part}"));
    }
    line(&mut out, format_args!(" tolerance-mm {} entry {}", exact(*tolerance), Placed(*entry)));
    for step in steps {
        match step {
            Step::Run(run) => print_run(&mut out, run),
            Step::PlungeCut(plunge_cut) => print_plunge_cut(&mut out, plunge_cut),
            Step::Turn(air) => line(&mut out, format_args!("turn {} to {}", Placed(air.from), Placed(air.to))),
            Step::Travel(air) => line(&mut out, format_args!("travel {} to {}", Placed(air.from), Placed(air.to))),
            Step::Drill(drill) => {
                line(&mut out, format_args!("drill {} tool {}{}", Xy(drill.at), drill.tool, At(drill.span)));
            }
            Step::Event(event) => line(&mut out, format_args!("event {}", event_words(*event))),
        }
    }
    out
}

fn print_run(out: &mut String, run: &Run) {
    let greatest = run.feeds.iter().copied().fold(0.0, f64::max);
    let feed = if greatest == f64::INFINITY { "off".to_owned() } else { exact(greatest) };
    let (shape, orientation) = (word(&SHAPES, run.shape), word(&ORIENTATION_MODES, run.orientation));
    push(
        out,
        format_args!("run {shape} {orientation} front {} heel {} feed {feed}", exact(run.front), exact(run.heel)),
    );
    line(out, format_args!("{}{}", turned(run.turned), backwards(run.edge)));
    print_ends(out, run.ends);
    line(out, format_args!("  start {}", Placed(run.start)));
    line(out, format_args!("  end {}", Placed(run.end)));
    for (i, &point) in run.points.iter().enumerate() {
        // The first point has no chord before it, so neither span nor speed.
        let chord = i.checked_sub(1);
        let span = chord.map_or(Span::default(), |chord| run.spans[chord]);
        push(out, format_args!("  point {}{}", Xy(point), At(span)));
        if let Some(feed) = chord.map(|chord| run.feeds[chord]).filter(|&feed| feed < greatest) {
            push(out, format_args!(" feed {}", exact(feed)));
        }
        let is_junction = chord.is_some_and(|chord| run.junctions.get(chord) == Some(&true));
        push(out, format_args!("{}", if is_junction { " junction" } else { "" }));
        line(out, format_args!("{}", Asked(run.joints[i])));
    }
}

fn turned(is_turned: bool) -> &'static str {
    if is_turned { " turned" } else { "" }
}

fn backwards(edge: Edge) -> &'static str {
    if edge == Edge::Back { " backwards" } else { "" }
}

fn print_plunge_cut(out: &mut String, plunge_cut: &PlungeCut) {
    let along = Xy(Point::from(plunge_cut.along));
    push(out, format_args!("stab along {along} front {} heel {}", exact(plunge_cut.front), exact(plunge_cut.heel)));
    push(out, format_args!("{}{}", turned(plunge_cut.turned), backwards(plunge_cut.edge)));
    if plunge_cut.overcut != [Overcut::default(); 2] {
        out.push_str(" harm");
        for length in plunge_cut.overcut.iter().flat_map(|overcut| [overcut.own, overcut.other]) {
            push(out, format_args!(" {}", exact(length)));
        }
    }
    out.push('\n');
    print_ends(out, plunge_cut.ends);
    line(out, format_args!("  pose {}", Placed(plunge_cut.pose)));
    let spans = std::iter::once(Span::default()).chain(plunge_cut.spans.iter().copied());
    for (&point, span) in plunge_cut.points.iter().zip(spans) {
        line(out, format_args!("  point {}{}", Xy(point), At(span)));
    }
}

fn print_ends(out: &mut String, ends: [End; 2]) {
    let [first, second] = ends.map(|end| word(&ENDS, End { side: Side::Waste, ..end }));
    line(out, format_args!("  ends {first} {second}"));
    if ends.iter().any(|end| end.side != Side::Waste) {
        let [first, second] = ends.map(|end| word(&SIDES, end.side));
        line(out, format_args!("  sides {first} {second}"));
    }
}

fn word<T: PartialEq + Copy>(table: &[(&'static str, T)], value: T) -> &'static str {
    table.iter().find(|row| row.1 == value).expect("the tables list every value").0
}

fn push(out: &mut String, text: fmt::Arguments<'_>) {
    out.write_fmt(text).expect("a string takes all that is written");
}

fn line(out: &mut String, text: fmt::Arguments<'_>) {
    push(out, text);
    out.push('\n');
}

struct Xy(Point);

impl Display for Xy {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", exact(self.0.x), exact(self.0.y))
    }
}

struct Placed(Pose);

impl Display for Placed {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{} c-rad {}", Xy(self.0.centre), exact(self.0.c.0))
    }
}

/// A span after a blank; empty for the span of no block.
struct At(Span);

impl Display for At {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Span { start, end, block } = self.0;
        if self.0 == Span::default() { Ok(()) } else { write!(f, " @{start}..{end}#{block}") }
    }
}

/// A copy after a blank; empty if there is only one.
struct OfCopy(u32);

impl Display for OfCopy {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        if self.0 == 0 { Ok(()) } else { write!(f, " copy {}", self.0) }
    }
}

/// A speed after a blank; empty for full speed.
struct Percent(u8);

impl Display for Percent {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        if self.0 == FULL_SPEED { Ok(()) } else { write!(f, " percent {}", self.0) }
    }
}

/// The words of a joint, each after a blank.
struct Asked(Joint);

impl Display for Asked {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let mut joint = self.0;
        JOINTS.iter().filter(|(_, flag)| *flag(&mut joint)).try_for_each(|(word, _)| write!(f, " {word}"))
    }
}

/// Words of an event.
fn event_words(event: Event) -> String {
    match event {
        Event::AdvanceBy(mm) => format!("{ADVANCE_BY} {mm}"),
        Event::Stop | Event::Advance => word(&EVENTS, event).to_owned(),
    }
}
