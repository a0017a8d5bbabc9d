#include "edge/tracker/tracker_config.h"

#include "base/toml_config.h"

namespace ols {

TrackerConfig read_tracker_config(ConfigTable& table) {
  TrackerConfig c;
  const auto number = [&](const char* key, double& value, double least, double greatest) {
    value = table.number(key, value, least, greatest);
  };
  const auto integer = [&](const char* key, int& value, int least, int greatest) {
    value = static_cast<int>(table.integer(key, value, least, greatest));
  };
  const std::string mode = table.choice("mode", "full", {"paper", "full"});
  c.mode = mode == "paper" ? TrackerMode::kPaper : TrackerMode::kFull;
  ConfigTable& paper = table.table("paper");
  c.paper.position_sd_px = paper.number("position_sd_px", c.paper.position_sd_px, 0.01, 100.0);
  c.paper.velocity_sd_px_s =
      paper.number("velocity_sd_px_s", c.paper.velocity_sd_px_s, 0.0, 10000.0);
  c.paper.weight_power = paper.number("weight_power", c.paper.weight_power, 0.1, 10000.0);
  c.paper.size_sd_px = paper.number("size_sd_px", c.paper.size_sd_px, 0.0, 100.0);
  integer("particles", c.particles, 20, 20000);
  number("position_sd_px", c.position_sd_px, 0.01, 100.0);
  number("position_sd_fraction", c.position_sd_fraction, 0.0, 1.0);
  number("velocity_gain", c.velocity_gain, 0.0, 2.0);
  number("surprise_fraction", c.surprise_fraction, 0.0, 1.0);
  number("surprise_scale", c.surprise_scale, 1.0, 100.0);
  number("velocity_sd_px_s", c.velocity_sd_px_s, 0.0, 10000.0);
  number("size_sd_fraction", c.size_sd_fraction, 0.0, 0.5);
  number("size_prior_sd_fraction", c.size_prior_sd_fraction, 0.01, 10.0);
  number("initial_velocity_sd_px_s", c.initial_velocity_sd_px_s, 0.0, 10000.0);
  number("sharpness", c.sharpness, 0.1, 1000.0);
  number("correlation_sharpness", c.correlation_sharpness, 0.0, 1000.0);
  number("contrast_sharpness", c.contrast_sharpness, 0.0, 1000.0);
  number("learning_time_s", c.learning_time_s, 0.01, 1e6);
  integer("ego_motion_width_px", c.ego_motion_width_px, 80, 4096);
  integer("ego_motion_corners", c.ego_motion_corners, 8, 2000);
  integer("ego_motion_least_inliers", c.ego_motion_least_inliers, 4, 2000);
  number("ego_motion_least_inlier_fraction", c.ego_motion_least_inlier_fraction, 0.0, 1.0);
  number("unknown_motion_sd_px", c.unknown_motion_sd_px, 0.0, 1000.0);
  number("difference_fraction", c.difference_fraction, 0.0, 0.9);
  number("leap_most_px_s", c.leap_most_px_s, 0.0, 100000.0);
  number("search_fraction", c.search_fraction, 0.0, 1.0);
  number("search_growth_px_s", c.search_growth_px_s, 0.0, 10000.0);
  number("search_sd_most_px", c.search_sd_most_px, 1.0, 10000.0);
  number("reference_interval_s", c.reference_interval_s, 0.01, 60.0);
  number("pixel_sd_floor_px", c.pixel_sd_floor_px, 0.001, 10.0);
  return c;
}

}  // namespace ols
