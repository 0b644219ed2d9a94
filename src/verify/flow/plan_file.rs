//! Plan as read back: the heads and their stations.

use super::ground::Ground;
use super::rules;
use crate::ir::verdict::WorstByRule;
use crate::units::columns::Unread;

/// Values of a plan that the verification needs.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Plan {
    /// Speed of the conveyor, mm/s.
    pub(super) speed: f64,
    /// Row of heads, from 1, and station, mm, of each head.
    pub(super) heads: Vec<(u64, f64)>,
}

/// Rounding of stations, mm.
const STATION: f64 = 1e-6;

/// Reads a plan.
pub(super) fn read(text: &str) -> Result<Plan, Unread> {
    let lacks = |what: &str| Unread::Row(format!("plan.json has no {what}"));
    let plan: serde_json::Value =
        serde_json::from_str(text).map_err(|error| Unread::Row(format!("plan.json is no JSON: {error}")))?;
    let speed = plan["speed_mm_s"].as_f64().filter(|speed| *speed > 0.0).ok_or_else(|| lacks("`speed_mm_s`"))?;
    let heads = plan["heads"].as_array().ok_or_else(|| lacks("`heads`"))?;
    let head = |head: &serde_json::Value| {
        let row = head["row"].as_u64().ok_or_else(|| lacks("`row` of a head"))?;
        let station = head["station_mm"].as_f64().ok_or_else(|| lacks("`station_mm` of a head"))?;
        Ok((row, station))
    };
    Ok(Plan { speed, heads: heads.iter().map(head).collect::<Result<_, Unread>>()? })
}

/// Verifies a plan against the profile.
pub(super) fn judge(plan: &Plan, ground: &Ground, worst: &mut WorstByRule) {
    let flow = &ground.profile.flow;
    let too_many = plan.heads.len().saturating_sub(flow.heads as usize);
    let no_row = plan.heads.iter().filter(|(row, _)| *row < 1 || *row > u64::from(flow.rows)).count();
    let too_fast = usize::from(plan.speed > flow.max_speed_mm_s);
    worst.see_under(&rules::PLAN, (too_many + no_row + too_fast) as f64, 0.0, None);
    for &(row, station) in &plan.heads {
        worst.see_under(&rules::STATION, (station - ground.station(row)).abs(), STATION, None);
    }
}
