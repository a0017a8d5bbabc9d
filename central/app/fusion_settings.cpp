#include "central/app/fusion_settings.h"

#include <algorithm>

#include "base/lcm_url.h"
#include "base/toml_config.h"

namespace ols {
namespace {

void read_alignment(ConfigTable& table, AlignmentConfig& config) {
  config.window_s = table.number("window_s", config.window_s, 0.01, 10.0);
  config.max_age_s = table.number("max_age_s", config.max_age_s, 0.01, 10.0);
  config.rate_sd_rad_s = table.number("rate_sd_rad_s", config.rate_sd_rad_s, 1e-6, 100.0);
  config.acceleration_sd_m_s2 =
      table.number("acceleration_sd_m_s2", config.acceleration_sd_m_s2, 1e-3, 1e4);
  config.range_unknown_m = table.number("range_unknown_m", config.range_unknown_m, 1.0, 1e6);
}

void read_least_squares(ConfigTable& table, LeastSquaresConfig& config) {
  config.gate_sigma = table.number("gate_sigma", config.gate_sigma, 1.0, 10.0);
  config.huber_sigma = table.number("huber_sigma", config.huber_sigma, 0.5, 10.0);
  config.range_sd_limit = table.number("range_sd_limit", config.range_sd_limit, 1e-3, 1.0);
  config.max_range_m = table.number("max_range_m", config.max_range_m, 1.0, 1e7);
}

void read_paper(ConfigTable& table, PaperConfig& config) {
  const std::string pairs =
      table.choice("pairs", "algorithm-1", {"algorithm-1", "centroid", "best-baseline"});
  if (pairs == "centroid") config.pairs = PaperPairs::kCentroid;
  if (pairs == "best-baseline") config.pairs = PaperPairs::kBestBaseline;
  config.by_belief = table.boolean("by_belief", config.by_belief);
  config.moving_average =
      static_cast<int>(table.integer("moving_average", config.moving_average, 1, 1000));
}

// One at least, each once.
std::vector<Motion> read_models(ConfigTable& table, const std::vector<Motion>& all) {
  std::vector<std::string> names;
  for (const Motion motion : all) names.emplace_back(to_string(motion));
  std::vector<Motion> models;
  for (const std::string& name : table.texts("models", names)) {
    const auto known = std::ranges::find(names, name);
    if (known == names.end()) throw table.error("models", "there is no model " + name);
    const Motion motion = all[static_cast<std::size_t>(known - names.begin())];
    if (std::ranges::find(models, motion) != models.end()) {
      throw table.error("models", name + " is there twice");
    }
    models.push_back(motion);
  }
  if (models.empty()) throw table.error("models", "one at least is wanted");
  return models;
}

void read_motion(ConfigTable& table, MotionConfig& config) {
  config.models = read_models(table, config.models);
  config.acceleration_sd_m_s2 =
      table.number("acceleration_sd_m_s2", config.acceleration_sd_m_s2, 1e-3, 1e4);
  config.acceleration_per_speed_s =
      table.number("acceleration_per_speed_s", config.acceleration_per_speed_s, 0.0, 10.0);
  config.acceleration_time_s =
      table.number("acceleration_time_s", config.acceleration_time_s, 0.01, 100.0);
  config.cruise_sd_m_s2 = table.number("cruise_sd_m_s2", config.cruise_sd_m_s2, 1e-6, 1e4);
  config.cruise_per_speed_s =
      table.number("cruise_per_speed_s", config.cruise_per_speed_s, 0.0, 10.0);
}

void read_station_errors(ConfigTable& table, StationErrorsConfig& config) {
  config.stated_time_s = table.number("stated_time_s", config.stated_time_s, 0.1, 1e6);
  config.untold_time_s = table.number("untold_time_s", config.untold_time_s, 0.1, 1e6);
  config.memory_s = table.number("memory_s", config.memory_s, 0.1, 1e6);
  config.untold_over_noise =
      table.number("untold_over_noise", config.untold_over_noise, 0.0, 100.0);
  config.clock_time_s = table.number("clock_time_s", config.clock_time_s, 0.1, 1e6);
  config.colour_time_s = table.number("colour_time_s", config.colour_time_s, 0.0, 10.0);
  config.colour_memory = table.number("colour_memory", config.colour_memory, 1.0, 1e6);
  config.noise_memory = table.number("noise_memory", config.noise_memory, 1.0, 1e6);
  config.least_noise = table.number("least_noise", config.least_noise, 1e-3, 1.0);
  config.greatest_noise = table.number("greatest_noise", config.greatest_noise, 1.0, 1e4);
}

void read_tracks(ConfigTable& table, KeeperConfig& config) {
  config.max_tracks = static_cast<int>(table.integer("max_tracks", config.max_tracks, 1, 10000));
  config.confirm_stations =
      static_cast<int>(table.integer("confirm_stations", config.confirm_stations, 2, 100));
  config.confirm_s = table.number("confirm_s", config.confirm_s, 0.0, 60.0);
  config.coast_s = table.number("coast_s", config.coast_s, 0.05, 60.0);
  config.drop_s = table.number("drop_s", config.drop_s, 0.05, 600.0);
}

void read_clocks(ConfigTable& table, ClockMonitorConfig& config) {
  config.error_limit_s = table.number("error_limit_s", config.error_limit_s, 1e-6, 1e4);
  config.offset_limit_s = table.number("offset_limit_s", config.offset_limit_s, 0.01, 60.0);
  config.usual_offset_s = table.number("usual_offset_s", config.usual_offset_s, 0.0, 60.0);
  config.release_s = table.number("release_s", config.release_s, 0.0, 1e4);
}

void read_slew(ConfigTable& table, SlewConfig& config) {
  config.rate_hz = table.number("rate_hz", config.rate_hz, 0.1, 100.0);
  config.act_s = table.number("act_s", config.act_s, 0.0, kSlewLead_s);
  config.lease_s = table.number("lease_s", config.lease_s, 0.05, 5.0);
  config.coast_s = table.number("coast_s", config.coast_s, 0.0, 60.0);
  config.rate_limit_rad_s =
      table.number("rate_limit_rad_s", config.rate_limit_rad_s, 0.01, kSlewRateLimit_rad_s);
}

}  // namespace

FusionSettings load_fusion_settings(const std::string& path) {
  ConfigFile file(path);
  ConfigTable& root = file.root();
  FusionSettings settings;
  settings.lcm_url = read_lcm_url(root, "lcm_url", settings.lcm_url);
  settings.status_interval_s =
      root.number("status_interval_s", settings.status_interval_s, 0.05, 60.0);
  settings.slew_clock_tolerance_s =
      root.number("slew_clock_tolerance_s", settings.slew_clock_tolerance_s, 0.1, 60.0);
  FusionConfig& fusion = settings.fusion;
  fusion.rate_hz = root.number("rate_hz", fusion.rate_hz, 0.1, 1000.0);
  fusion.admission.min_belief = root.number("min_belief", fusion.admission.min_belief, 0.0, 1.0);
  fusion.admission.stale_s = root.number("stale_s", fusion.admission.stale_s, 0.01, 60.0);
  fusion.admission.future_s = root.number("future_s", fusion.admission.future_s, 0.01, 60.0);
  fusion.admission.flood_hz = root.number("flood_hz", fusion.admission.flood_hz, 1.0, 1e6);
  fusion.admission.stations = root.texts("stations", fusion.admission.stations);
  fusion.admission.max_stations =
      static_cast<int>(root.integer("max_stations", fusion.admission.max_stations, 2, 100000));
  fusion.estimator =
      root.choice("estimator", fusion.estimator, {"filter", "least-squares", "paper"});
  fusion.strays.alarm_s = root.number("stray_alarm_s", fusion.strays.alarm_s, 1.0, 3600.0);
  read_alignment(root.table("alignment"), fusion.estimators.alignment);
  read_least_squares(root.table("least_squares"), fusion.estimators.least_squares);
  read_paper(root.table("paper"), fusion.estimators.paper);
  read_motion(root.table("motion"), fusion.keeper.filter.motion);
  read_station_errors(root.table("station_errors"), fusion.keeper.errors);
  read_tracks(root.table("tracks"), fusion.keeper);
  read_slew(root.table("slew"), fusion.slew);
  read_clocks(root.table("clocks"), fusion.admission.clocks);
  file.finish();
  return settings;
}

}  // namespace ols
