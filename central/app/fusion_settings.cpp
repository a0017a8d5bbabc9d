#include "central/app/fusion_settings.h"

#include "base/config/config_common.h"

namespace ols::fusion {
namespace {

using config::Section;

Section alignment_section(AlignmentConfig& c) {
  return {"alignment",
          "Bearings brought to a common time, for least-squares and paper.",
          {config::number("window_s", c.window_s, {0.01, 10.0}, "s",
                          "Span of a station's bearings that are fitted."),
           config::number("max_age_s", c.max_age_s, {0.01, 10.0}, "s",
                          "A station whose newest bearing is older contributes no ray.")}};
}

Section paper_section(PaperConfig& c) {
  return {
      "paper",
      "The estimator of the paper's section 6.",
      {config::word("pairs", c.pairs,
                    {{"algorithm-1", PaperPairs::kAlgorithm1},
                     {"centroid", PaperPairs::kCentroid},
                     {"best-baseline", PaperPairs::kBestBaseline}},
                    "How the pairs of stations are combined."),
       config::flag("by_belief", c.by_belief, "Whether the less believed ray is turned further."),
       config::integer("moving_average", c.moving_average, 1, 1000, "",
                       "Estimates in the moving average; 1: none.")}};
}

Section motion_section(MotionConfig& c) {
  return {"motion",
          "How targets move.",
          {config::word_list("models", c.models,
                             {{"constant-velocity", Motion::kConstantVelocity},
                              {"coordinated-turn", Motion::kCoordinatedTurn},
                              {"acceleration", Motion::kAcceleration}},
                             "Motion models that are mixed."),
           config::number("acceleration_sd_m_s2", c.acceleration_sd_m_s2, {1e-3, 1e4}, "m/s^2",
                          "1-sigma of the acceleration of a target at rest."),
           config::number("acceleration_per_speed_s", c.acceleration_per_speed_s, {0.0, 10.0},
                          "1/s", "Further 1-sigma of the acceleration, per speed.")}};
}

Section station_errors_section(BiasModelConfig& c) {
  return {"station_errors",
          "The bias model of the stations.",
          {config::number("stated_time_s", c.stated_time_s, {0.1, 1e6}, "s",
                          "Correlation time of a pose's error within what the station states.")}};
}

Section tracks_section(TrackManagerConfig& c) {
  return {"tracks",
          "Track management.",
          {config::integer("max_tracks", c.max_tracks, 1, 10000, "",
                           "Maximum number of tracks, tentative ones included."),
           config::integer("confirm_stations", c.confirm_stations, 2, 100, "",
                           "Stations whose bearings confirm a track at once."),
           config::number("confirm_s", c.confirm_s, {0.0, 60.0}, "s",
                          "Minimum age of a track that only two stations confirm."),
           config::number("coast_s", c.coast_s, {0.05, 60.0}, "s",
                          "A track that no two stations have seen for this long is coasting."),
           config::number("drop_s", c.drop_s, {0.05, 600.0}, "s",
                          "A track that no two stations have seen for this long is dropped.")}};
}

Section slew_section(SlewConfig& c) {
  return {"slew",
          "Commands that point the stations at the targets.",
          {config::number("rate_hz", c.rate_hz, {0.1, 100.0}, "Hz", "Slews per second."),
           config::number("act_s", c.act_s, {0.0, kSlewLead_s}, "s",
                          "From the command to its effect, besides the station's latency."),
           config::number("lease_s", c.lease_s, {0.05, 5.0}, "s",
                          "A station without a newer slew halts after this time; at most its "
                          "slew_lease_max_s."),
           config::number("coast_s", c.coast_s, {0.0, 60.0}, "s",
                          "Slews continue for this long after a target's last bearings.")}};
}

Section clocks_section(ClockMonitorConfig& c) {
  return {"clocks",
          "Quarantine of stations with a wrong clock.",
          {config::number("error_limit_s", c.error_limit_s, {1e-6, 1e4}, "s",
                          "Maximum 1-sigma of its clock that a station may state."),
           config::number("offset_limit_s", c.offset_limit_s, {0.01, 60.0}, "s",
                          "Maximum offset of a station's stamps from the median."),
           config::number("usual_offset_s", c.usual_offset_s, {0.0, 60.0}, "s",
                          "Offset that frame phases and network delays explain.")}};
}

Section cues_section(CueConfig& c) {
  return {"cues",
          "Targets that others know of (docs/cues.md), to which stations may be led.",
          {config::word("allow", c.allow,
                        {{"never", CueAllowance::kNever},
                         {"ask", CueAllowance::kAsk},
                         {"all", CueAllowance::kAll}},
                        "never: cues are only shown; ask: stations are led to the cues that an "
                        "operator allows; all: to all cues that no operator forbids."),
           config::number("range_m", c.range_m, {100.0, 1e6}, "m",
                          "Cues farther than this from the nearest station are refused."),
           config::number("max_age_s", c.max_age_s, {0.5, 60.0}, "s",
                          "Cues whose position is older are refused."),
           config::number("most_sd_m", c.most_sd_m, {1.0, 1e5}, "m",
                          "Cues with a larger 1-sigma are refused."),
           config::number("acceleration_sd_m_s2", c.acceleration_sd_m_s2, {0.0, 100.0}, "m/s^2",
                          "1-sigma of a cue's acceleration: how fast it becomes uncertain."),
           config::integer("most", c.most, 1, 64, "", "Maximum number of cues at the same time.")}};
}

Section handover_section(HandoverConfig& c) {
  return {
      "handover",
      "Whether targets that only detectors have found lead stations (docs/fusion.md, section 8).",
      {config::word("mode", c.mode,
                    {{"off", HandoverMode::kOff},
                     {"propose", HandoverMode::kPropose},
                     {"automatic", HandoverMode::kAutomatic}},
                    "off: they lead none; propose: each waits for an operator; automatic: those "
                    "of `classes` lead at once."),
       config::word_list(
           "classes", c.classes,
           config::words_of(wire::kObjectClasses, &wire::ObjectClassRow::object_class),
           "Classes that lead at once where the mode is automatic; the others "
           "wait for an operator."),
       config::texts("staring", c.staring, "Stations that are never led anywhere."),
       config::number("seek_s", c.seek_s, {0.0, 60.0}, "s",
                      "A lost target is searched for this long, at its predicted position."),
       config::number("remember_s", c.remember_s, {0.0, 60.0}, "s",
                      "A target that is found again within this time, under another number, keeps "
                      "the operator's decision."),
       config::number("acceleration_sd_m_s2", c.acceleration_sd_m_s2, {0.0, 100.0}, "m/s^2",
                      "1-sigma of a lost target's acceleration: how fast its "
                      "predicted position becomes uncertain.")}};
}

Section land_section(FusionSettings& s) {
  return {"land",
          "The land around the site (docs/land.md).",
          {config::text("folder", s.land_folder,
                        "Folder that `ols-land import` has made; empty: no land is known."),
           config::texts("on_ground", s.fusion.land.on_ground,
                         "Stations whose designated objects stand on the ground: one of them "
                         "alone gives a position (docs/fusion.md, section 11).")},
          {},
          [&s](ConfigTable& table) {
            if (s.land_folder.empty() && !s.fusion.land.on_ground.empty()) {
              throw table.error("on_ground", "needs folder: no land is known");
            }
          }};
}

std::vector<config::Row> admission_rows(FusionConfig& c) {
  return {
      config::choice("estimator", c.estimator, {"filter", "least-squares", "paper"},
                     "How positions are estimated: docs/fusion.md."),
      config::number("rate_hz", c.rate_hz, {0.1, 1000.0}, "Hz",
                     "Maximum rate of positions of each target."),
      config::integer("paper_targets", c.paper_targets, 0, 1000, "",
                      "Targets for which the paper's estimate is published as well, on "
                      "OLS_TARGET_PAPER; 0: none."),
      config::number("min_belief", c.admission.min_belief, {0.0, 1.0}, "",
                     "Bearings with a lower belief are not used."),
      config::number("stale_s", c.admission.stale_s, {0.01, 60.0}, "s",
                     "Bearings that are older than the message time by more are refused."),
      config::number("future_s", c.admission.future_s, {0.01, 60.0}, "s",
                     "Bearings that are newer than the message time by more are refused."),
      config::texts("stations", c.admission.stations,
                    "Stations of this site: bearings of others are refused; empty: all are taken."),
      config::integer("max_stations", c.admission.max_stations, 2, 100000, "",
                      "Maximum number of stations; one more replaces a silent one."),
      config::number("stray_alarm_s", c.unassociated.alarm_s, {1.0, 3600.0}, "s",
                     "A station that follows an unknown object for this long raises an alarm."),
  };
}

}  // namespace

Section fusion_section(FusionSettings& s) {
  FusionConfig& fusion = s.fusion;
  Section root{
      "",
      "",
      {config::bus_url(s.lcm_url),
       config::number("status_interval_s", s.status_interval_s, {0.05, 60.0}, "s",
                      "Interval of the status messages."),
       config::number("slew_clock_tolerance_s", s.slew_clock_tolerance_s, {0.1, 60.0}, "s",
                      "Targets and slews further from this host's clock are withheld.")},
      {alignment_section(fusion.estimators.alignment), paper_section(fusion.estimators.paper),
       motion_section(fusion.tracks.filter.motion), station_errors_section(fusion.tracks.errors),
       tracks_section(fusion.tracks), slew_section(fusion.slew),
       clocks_section(fusion.admission.clocks), cues_section(fusion.cues),
       handover_section(fusion.handover), land_section(s), trust::trust_section(s.trust)}};
  std::ranges::move(admission_rows(fusion), std::back_inserter(root.rows));
  return root;
}

FusionSettings load_fusion_settings(const std::string& path) {
  return config::load(path, fusion_section);
}

}  // namespace ols::fusion
