// The highest elevation of the land up to each distance, along one azimuth, stored in few steps.
#pragma once

#include <optional>
#include <vector>

namespace ols::land {

// Between two steps, elevation and distance are interpolated. From step to step neither of them
// descends, but one may stay the same: hidden land behind a crest gets the crest's elevation, and a
// wall rises at a single distance.
struct Step {
  float elevation_rad = 0.0F;
  float distance_m = 0.0F;  // horizontal, in the camera's east-north-up frame
  float elevation_sd_rad = 0.0F;
};

// Takes many steps and omits those that interpolation between the others reproduces, to within a
// quarter of a cell in distance.
class StaircaseBuilder {
 public:
  explicit StaircaseBuilder(std::vector<Step>& steps) : steps_(steps) {}
  // `cell_m`: length of a cell at this distance. `corner`: if true, the step is kept in any case.
  void add(double elevation_rad, double distance_m, double elevation_sd_rad, double cell_m,
           bool corner);
  void end();

 private:
  void keep(const Step& step);

  std::vector<Step>& steps_;
  // The step kept last; the step added last, if it has not been kept.
  std::optional<Step> anchor_, candidate_;
  // Limits of the slope from the anchor to the next step, distance over elevation.
  double least_slope_ = 0.0, greatest_slope_ = 0.0;
};

}  // namespace ols::land
