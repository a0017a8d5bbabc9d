// The highest elevation of the land up to a distance, along one azimuth, in few steps.
#pragma once

#include <optional>
#include <vector>

namespace ols::land {

// Between two steps elevation and distance are interpolated. Elevation and distance never descend,
// but either may stay the same: behind a crest the hidden land keeps the crest's elevation, and a
// wall rises at one distance.
struct Step {
  float elevation_rad = 0.0F;
  float distance_m = 0.0F;  // horizontal, in the camera's east-north-up frame
  float elevation_sd_rad = 0.0F;
};

// Omits steps that interpolation between the others reproduces to within a quarter of a cell in
// distance.
class StaircaseBuilder {
 public:
  explicit StaircaseBuilder(std::vector<Step>& steps) : steps_(steps) {}
  // `cell_m`: length of a cell at this distance. `corner`: the step is kept in any case.
  void add(double elevation_rad, double distance_m, double elevation_sd_rad, double cell_m,
           bool corner);
  void end();

 private:
  void keep(const Step& step);

  std::vector<Step>& steps_;
  // The last step kept; the last step added, if it was not kept.
  std::optional<Step> anchor_, candidate_;
  // Limits of the slope of distance over elevation, from the anchor.
  double least_slope_ = 0.0, greatest_slope_ = 0.0;
};

}  // namespace ols::land
