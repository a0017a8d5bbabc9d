// The highest elevation of the land up to a distance, along one azimuth, in few steps.
#pragma once

#include <optional>
#include <vector>

namespace ols::land {

// Between two steps elevation and distance are interpolated. Both ascend, never strictly: the land
// hides what follows a crest at the crest's own elevation, and a wall rises at one distance.
struct Step {
  float elevation_rad = 0.0F;
  float distance_m = 0.0F;  // horizontal, in the camera's east-north-up frame
  float elevation_sd_rad = 0.0F;
};

// Leaves out steps that interpolation between others gives to a quarter of a cell in distance.
class StaircaseBuilder {
 public:
  explicit StaircaseBuilder(std::vector<Step>& steps) : steps_(steps) {}
  // `cell_m`: length of a cell there. `corner`: is kept in any case.
  void add(double elevation_rad, double distance_m, double elevation_sd_rad, double cell_m,
           bool corner);
  void end();

 private:
  void keep(const Step& step);

  std::vector<Step>& steps_;
  std::optional<Step> anchor_, candidate_;  // the last one kept; the last one added, if not kept
  double least_slope_ = 0.0, greatest_slope_ = 0.0;  // of distance by elevation, from the anchor
};

}  // namespace ols::land
