//! Machine and knife that the figures of a run refer to, as text and as JSON.

use std::fmt::Write as _;

use serde::Serialize;

use super::explain::wrapped;
use crate::machine::{Axis, Job, MachineProfile, Planner, Sheet, Tool, ToolKind};
use crate::units::number::short;

/// Maximum columns of the text of a line.
const WIDTH: usize = 66;

/// Machine and knife. Fields are keys of the JSON output.
#[derive(Debug, Serialize)]
pub(super) struct Setup {
    profile: Profile,
    knife: Knife,
    /// Position of the marker on the table; absent if it is that of the file.
    #[serde(skip_serializing_if = "Option::is_none")]
    sheet: Option<Sheet>,
    /// Map by registration marks; absent without marks.
    #[serde(skip_serializing_if = "Option::is_none")]
    map: Option<Map>,
}

/// A map by registration marks.
#[derive(Debug, Serialize)]
struct Map {
    marks: usize,
    /// Maximum distance of a mark from its position by the map of the other marks.
    worst_mm: f64,
    turned_deg: f64,
    skewed_deg: f64,
    stretch: [f64; 2],
}

/// Origin of the values.
#[derive(Debug, Serialize)]
pub(super) struct Profile {
    /// File name without its directory; null for the default machine.
    file: Option<String>,
    /// Digest of the values in effect, as in the provenance of a program.
    sha256: String,
    /// Keys changed by `--set`.
    set: Vec<String>,
}

impl Profile {
    /// The profile of a job.
    pub(super) fn of(job: &Job) -> Self {
        Self {
            file: job.origin.file.clone(),
            sha256: job.profile.digest(),
            set: job.origin.set.keys().cloned().collect(),
        }
    }
}

/// The blade.
#[derive(Debug, Serialize)]
struct Knife {
    width_mm: f64,
    /// Distance from the C axis back to the heel.
    back_mm: f64,
    /// Distance from the C axis forward to the tip.
    radius_mm: f64,
    /// "told", or "assumed" if only a width was given.
    axis: &'static str,
}

impl Setup {
    /// The machine and knife of a job.
    pub(super) fn of(job: &Job) -> Self {
        let MachineProfile { knife, .. } = job.profile.effective();
        let axis = match job.origin.axis() {
            Axis::Told => "told",
            Axis::Assumed => "assumed",
        };
        let back = knife.back_mm.unwrap_or_default();
        Self {
            profile: Profile::of(job),
            knife: Knife { width_mm: knife.width_mm, back_mm: back, radius_mm: rounded(knife.width_mm - back), axis },
            sheet: Some(&job.profile.sheet).filter(|sheet| !sheet.is_plain()).cloned(),
            map: job.marks.as_ref().map(|marks| Map {
                marks: marks.count(),
                worst_mm: rounded(marks.farthest().1),
                turned_deg: rounded(marks.map().turned_deg()),
                skewed_deg: rounded(marks.map().skewed_deg()),
                stretch: marks.map().stretch().map(rounded),
            }),
        }
    }
}

/// The value rounded to 1e-9, which hides errors of computation.
fn rounded(value: f64) -> f64 {
    (value * 1e9).round() / 1e9
}

/// Lines on the machine, its knife and the position of the marker, for the summary of a program.
pub(super) fn text(job: &Job) -> String {
    let mut out = String::from("\n");
    let mut line = |label: &str, text: &str| {
        // Writing into a `String` cannot fail.
        let _ = writeln!(out, "  {label:10} {}", wrapped(text, WIDTH).replace('\n', "\n             "));
    };
    let origin = &job.origin;
    let without = if origin.file.is_none() { "; no -p was given" } else { "" };
    line("machine", &format!("{}{without}", origin.described()));
    match job.profile.tool.kind {
        ToolKind::Knife => line("knife", &knife(job)),
        ToolKind::Spray => line("tool", &head(&job.profile.tool)),
        kind @ (ToolKind::Wheel | ToolKind::Pen | ToolKind::Router) => {
            line("tool", &format!("{}, on the line, along its tangent", kind.name()));
        }
    }
    out + &sheet(job)
}

/// Description of a head at a distance.
fn head(tool: &Tool) -> String {
    let planner = match tool.planner {
        Planner::Optimal => "optimal",
        Planner::Quintic => "quintic",
    };
    format!(
        "{} head {} mm outside the edge, its jet {} mm/s along it, {} mm/s round corners; planner {planner}",
        tool.kind.name(),
        short(tool.distance_mm),
        short(tool.edge_speed_mm_s),
        short(tool.corner_speed_mm_s)
    )
}

/// Description of the blade and of the position of the C axis.
fn knife(job: &Job) -> String {
    let (knife, origin) = (&job.profile.knife, &job.origin);
    let place = format!("{} mm wide, C axis {} mm behind the tip", short(knife.width_mm), short(knife.radius()));
    let why = match origin.axis() {
        Axis::Told => String::new(),
        Axis::Assumed => format!(
            "; neither knife.back_mm nor knife.radius_mm is given: so it was put {} mm before the heel",
            short(knife.back())
        ),
    };
    format!("{place}{why}")
}

/// Lines on the position of the marker on the table; empty if it is that of the file.
pub(super) fn sheet(job: &Job) -> String {
    let sheet = Some(&job.profile.sheet).filter(|sheet| !sheet.is_plain()).map(|sheet| ("sheet", sheet.to_string()));
    let map = job.marks.as_ref().map(|marks| ("map", marks.to_string()));
    let line = |(label, text): (&str, String)| {
        format!("  {label:10} {}\n", wrapped(&text, WIDTH).replace('\n', "\n             "))
    };
    sheet.into_iter().chain(map).map(line).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::load_given;
    use crate::source::Source;

    fn job(file: &str, sets: &[&str]) -> Job {
        let sets: Vec<String> = sets.iter().map(ToString::to_string).collect();
        let source = Source::new("left.toml", file.as_bytes().to_vec()).expect("small");
        let (profile, origin) = load_given(Some(&source).filter(|_| !file.is_empty()), &sets).expect("legal");
        Job { profile, origin, ..Job::default() }
    }

    #[test]
    fn the_summary_names_machine_and_knife_and_says_where_the_axis_was_put() {
        let all = [
            text(&job("", &[])),
            text(&job("knife.width_mm = 7.2", &[])),
            text(&job("knife.width_mm = 7.2", &["knife.back_mm=5", "path.tolerance_mm=0.1"])),
            text(&job("", &["knife.width_mm=0.25 in"])),
        ];
        let all = all.concat();
        assert!(all.lines().all(|line| line.chars().count() <= 80), "{all}");
        insta::assert_snapshot!(all, @r"

          machine    default machine; no -p was given
          knife      6.6 mm wide, C axis 0.25 mm behind the tip

          machine    left.toml
          knife      7.2 mm wide, C axis 0.85 mm behind the tip; neither knife.back_mm
                     nor knife.radius_mm is given: so it was put 6.35 mm before the
                     heel

          machine    left.toml, with knife.back_mm, path.tolerance_mm set
          knife      7.2 mm wide, C axis 2.2 mm behind the tip

          machine    default machine, with knife.width_mm set; no -p was given
          knife      6.35 mm wide, C axis 0 mm behind the tip; neither knife.back_mm
                     nor knife.radius_mm is given: so it was put 6.35 mm before the
                     heel
        ");
    }

    #[test]
    fn the_same_as_json() {
        let setup = serde_json::to_value(Setup::of(&job("knife.width_mm = 7.2", &["time.period_ms=2"]))).expect("JSON");
        let knife = r#"{"axis":"assumed","back_mm":6.35,"radius_mm":0.85,"width_mm":7.2}"#;
        assert_eq!(setup["knife"].to_string(), knife);
        assert_eq!(
            (&setup["profile"]["file"], &setup["profile"]["set"][0]),
            (&"left.toml".into(), &"time.period_ms".into())
        );
        let setup = serde_json::to_value(Setup::of(&Job::default())).expect("JSON");
        assert!(setup["profile"]["file"].is_null() && setup["knife"]["axis"] == "told");
    }
}
