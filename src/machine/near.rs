//! Suggestion of a key for one that does not exist: users choose synonyms or mistype.

use super::keys::{KEYS, near_codes};

/// Synonyms of the words in keys. A cutter's length is its X, its width its Y.
const WORDS: &[(&str, &[&str])] = &[
    ("acc", &["acceleration"]),
    ("accel", &["acceleration"]),
    ("accuracy", &["tolerance"]),
    ("bed", &["table"]),
    ("blade", &["knife"]),
    ("charset", &["encoding"]),
    ("clockwise", &["reverse"]),
    ("codepage", &["encoding"]),
    ("cutter", &["knife"]),
    ("cycle", &["period"]),
    ("delay", &["dwell"]),
    ("deviation", &["tolerance"]),
    ("down", &["plunge"]),
    ("drop", &["plunge"]),
    ("eccentricity", &["radius"]),
    ("encoder", &["counts"]),
    ("end", &["park"]),
    ("feedrate", &["feed"]),
    ("height", &["y"]),
    ("hole", &["drill"]),
    ("interval", &["period"]),
    ("invert", &["reverse"]),
    ("inverted", &["reverse"]),
    ("length", &["x", "depth"]),
    ("limits", &["range"]),
    ("lower", &["plunge"]),
    ("machine", &["table"]),
    ("ngc", &["gcode"]),
    ("offset", &["radius"]),
    ("overcut", &["front"]),
    ("plt", &["hpgl"]),
    ("precision", &["tolerance"]),
    ("pulses", &["counts"]),
    ("raise", &["lift"]),
    ("rate", &["feed"]),
    ("repeats", &["copies"]),
    ("rotation", &["c", "rotate"]),
    ("sample", &["period"]),
    ("shrinkage", &["scale"]),
    ("speed", &["feed"]),
    ("start", &["home"]),
    ("steps", &["counts"]),
    ("theta", &["c"]),
    ("thickness", &["width"]),
    ("tick", &["period"]),
    ("time", &["dwell", "period"]),
    ("tool", &["knife"]),
    ("up", &["lift"]),
    ("velocity", &["speed", "feed"]),
    ("width", &["y"]),
];

/// Words that are only units: they distinguish keys only when nothing else does.
const OF_UNITS: &[&str] = &["mm", "ms", "s", "s2", "s3", "deg", "percent"];

/// Weights of a word in the last part of a name, in a table before it, and of a unit.
const WEIGHT_OF_LAST: f64 = 1.0;
const WEIGHT_OF_TABLE: f64 = 0.6;
const WEIGHT_OF_UNIT: f64 = 0.1;
/// Likeness of two synonyms.
const SAME_MEANING: f64 = 0.9;
/// Least likeness of two words that count as similar.
const LEAST_ALIKE: f64 = 0.7;
/// Least share of common words of two names that are compared by words.
const LEAST_SHARED: f64 = 0.3;

/// Key or table whose name is nearest to one that does not exist: by words, else by letters.
pub(super) fn nearest(name: &str) -> String {
    if let Some(code) = near_codes(name).and_then(|codes| codes.into_iter().next()) {
        return code;
    }
    let typed = words(name);
    let by_words = best(|other| shared(&typed, &words(other)), name);
    match by_words {
        (other, likeness) if likeness >= LEAST_SHARED => other.to_owned(),
        _ => best(|other| alike(name, other).max(alike(last(name), last(other))), name).0.to_owned(),
    }
}

/// Key or table most like a name, and its likeness; letters decide between equals.
fn best(likeness: impl Fn(&str) -> f64, name: &str) -> (&'static str, f64) {
    let sections = KEYS.iter().flat_map(|key| key.name.match_indices('.').map(|(dot, _)| &key.name[..dot]));
    // A key inside a table is not itself a table.
    let depth = |name: &str| name.split('.').count();
    let sections = sections.filter(|section| depth(section) == depth(name));
    let names = KEYS.iter().map(|key| key.name).chain(sections).map(|other| (other, likeness(other)));
    // `max_by` returns the last of equals, so reversing selects the first one of the table.
    let names = names.collect::<Vec<_>>().into_iter().rev();
    let best = names.max_by(|a, b| a.1.total_cmp(&b.1).then(alike(name, a.0).total_cmp(&alike(name, b.0))));
    best.unwrap_or_default()
}

fn alike(a: &str, b: &str) -> f64 {
    strsim::normalized_damerau_levenshtein(a, b)
}

fn last(name: &str) -> &str {
    name.rsplit('.').next().unwrap_or_default()
}

/// Words of a dotted name in lower case, each with its weight.
fn words(name: &str) -> Vec<(String, f64)> {
    let parts = name.split('.').count();
    let of_part = |(i, part): (usize, &str)| {
        let weight = if i + 1 == parts { WEIGHT_OF_LAST } else { WEIGHT_OF_TABLE };
        let words = part.split(['_', '-', ' ']).filter(|word| !word.is_empty()).map(str::to_lowercase);
        words.map(|word| (word, weight)).collect::<Vec<_>>()
    };
    let weighed = |(word, weight): (String, f64)| {
        let weight = if OF_UNITS.contains(&word.as_str()) { WEIGHT_OF_UNIT } else { weight };
        (word, weight)
    };
    name.split('.').enumerate().flat_map(of_part).map(weighed).collect()
}

/// Share of the words common to two names, 0 to 1.
fn shared(typed: &[(String, f64)], other: &[(String, f64)]) -> f64 {
    let best = |(word, weight): &(String, f64)| {
        let likeness = |(known, other): &(String, f64)| same(word, known) * weight.min(*other);
        other.iter().map(likeness).fold(0.0, f64::max)
    };
    let total = |words: &[(String, f64)]| words.iter().map(|(_, weight)| weight).sum::<f64>();
    2.0 * typed.iter().map(best).sum::<f64>() / (total(typed) + total(other)).max(WEIGHT_OF_UNIT)
}

/// Likeness of a typed word and a word of a key, 0 to 1.
fn same(typed: &str, known: &str) -> f64 {
    let means = |(word, others): &(&str, &[&str])| *word == typed && others.contains(&known);
    match alike(typed, known) {
        1.0 => 1.0,
        _ if WORDS.iter().any(means) => SAME_MEANING,
        likeness if likeness >= LEAST_ALIKE && typed.len() > 2 => likeness,
        _ => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(rows: &[(&str, &str)]) {
        let wrong: Vec<_> = rows.iter().filter(|(typed, meant)| nearest(typed) != *meant).collect();
        assert!(wrong.is_empty(), "{:#?}", wrong.iter().map(|(t, m)| (t, nearest(t), m)).collect::<Vec<_>>());
    }

    #[test]
    fn a_mistyped_key_has_its_nearest() {
        check(&[
            ("knife.widht_mm", "knife.width_mm"),
            ("knife.width", "knife.width_mm"),
            ("knive", "knife"),
            ("axis", "axes"),
            ("width_mm", "knife.width_mm"),
            ("knife.angle_deg", "corner.angle_deg"),
            ("axis.x.speed_mm_s", "axes.x.speed_mm_s"),
            ("codes.m19", "codes.M19"),
            ("time.period", "time.period_ms"),
            ("xyzzy.q", nearest("xyzzy.q").as_str()),
        ]);
    }

    #[test]
    fn a_key_in_other_words_is_found_by_them() {
        check(&[
            ("table.width", "table.y_mm"),
            ("table.width_mm", "table.y_mm"),
            ("table.length", "table.x_mm"),
            ("bed.length_mm", "table.x_mm"),
            ("blade.width", "knife.width_mm"),
            ("knife.speed", "knife.feed_mm_s"),
            ("knife.velocity_mm_s", "knife.feed_mm_s"),
            ("knife.accel", "axes.x.acceleration_mm_s2"),
            ("axes.x.accel", "axes.x.acceleration_mm_s2"),
            ("axes.c.velocity", "axes.c.speed_deg_s"),
            ("knife.plunge_time", "knife.plunge_ms"),
            ("knife.down_time", "knife.plunge_ms"),
            ("knife.lift_time_ms", "knife.lift_ms"),
            ("knife.offset_mm", "knife.radius_mm"),
            ("drill.time", "drill.dwell_ms"),
            ("notch.length", "notch.depth_mm"),
            ("tolerance", "path.tolerance_mm"),
            ("path.accuracy", "path.tolerance_mm"),
            ("time.cycle_ms", "time.period_ms"),
            ("c.inverted", "c.reverse"),
            ("c.limits", "c.range_deg"),
            ("labels.charset", "labels.encoding"),
            ("origin", "sheet.origin"),
            ("sheet.shrinkage", "sheet.scale_x"),
            ("sheet.rotation", "sheet.rotate_deg"),
            ("sheet.repeats", "sheet.copies"),
            ("overcut", "knife.front_overlap_mm"),
            ("encoder.x.per_mm", "counts.x.per_mm"),
        ]);
    }
}
