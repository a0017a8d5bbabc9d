#include "central/fusion_settings.h"

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

void read_residuals(ConfigTable& table, ResidualConfig& config) {
  config.memory_s = table.number("memory_s", config.memory_s, 0.1, 1e5);
  config.independence_s = table.number("independence_s", config.independence_s, 1e-3, 1e4);
  config.common_weight = table.number("common_weight", config.common_weight, 0.0, 1e6);
  config.prior_weight = table.number("prior_weight", config.prior_weight, 0.1, 1e6);
  config.systematic_margin = table.number("systematic_margin", config.systematic_margin, 1.0, 1e6);
  config.clip = table.number("clip", config.clip, 1.0, 1e6);
}

void read_clocks(ConfigTable& table, ClockMonitorConfig& config) {
  config.error_limit_s = table.number("error_limit_s", config.error_limit_s, 1e-6, 1e4);
  config.offset_limit_s = table.number("offset_limit_s", config.offset_limit_s, 0.01, 60.0);
  config.usual_offset_s = table.number("usual_offset_s", config.usual_offset_s, 0.0, 60.0);
  config.release_s = table.number("release_s", config.release_s, 0.0, 1e4);
}

void read_slew(ConfigTable& table, SlewConfig& config) {
  config.rate_hz = table.number("rate_hz", config.rate_hz, 0.1, 100.0);
  config.lead_s = table.number("lead_s", config.lead_s, 0.0, 5.0);
  config.lease_s = table.number("lease_s", config.lease_s, 0.05, 5.0);
  config.coast_s = table.number("coast_s", config.coast_s, 0.0, 60.0);
  config.acceleration_sd_m_s2 =
      table.number("acceleration_sd_m_s2", config.acceleration_sd_m_s2, 1e-3, 1e4);
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
  fusion.min_belief = root.number("min_belief", fusion.min_belief, 0.0, 1.0);
  fusion.stale_s = root.number("stale_s", fusion.stale_s, 0.01, 60.0);
  fusion.future_s = root.number("future_s", fusion.future_s, 0.01, 60.0);
  fusion.paper_average =
      static_cast<int>(root.integer("paper_average", fusion.paper_average, 1, 1000));
  read_alignment(root.table("alignment"), fusion.alignment);
  read_least_squares(root.table("least_squares"), fusion.least_squares);
  read_residuals(root.table("residuals"), fusion.residuals);
  read_slew(root.table("slew"), fusion.slew);
  read_clocks(root.table("clocks"), fusion.clocks);
  file.finish();
  return settings;
}

}  // namespace ols
