// The stage that takes pictures of the night sky all around, and finds the stars in them. The
// observed stars have no names yet: they are identified before the adjustment (name_stars.h). Pure.
#pragma once

#include <numbers>

#include "calibration/procedure/stage.h"

namespace ols::calibration {

struct StarPlanOptions {
  int pictures = 24;
  double pan_min_rad = -2.6, pan_max_rad = 2.6;
  double lowest_rad = 0.21;  // 12 degrees; below 10 degrees, the refraction is too uncertain
  double highest_rad = 0.5;
  // The shaft angle of one turn of the worm, for pan and for tilt.
  double worm_turn_rad = 2.0 * std::numbers::pi / 70.0;
};

// Plans pictures all around, alternately low and high, with all directions of approach, and at
// evenly distributed phases of the worms. Throws std::invalid_argument if the unit cannot reach the
// lowest elevation.
std::vector<Shot> plan_stars(const StarPlanOptions& options);

class StarStage : public Stage {
 public:
  explicit StarStage(std::vector<Shot> shots) : shots_(std::move(shots)) {}

  std::optional<Order> next() override;
  void taken(const Taken& picture) override;
  void not_taken(const std::string& why) override;
  void answered(const Answer&) override {}
  std::vector<Observation> observations() const override { return observations_; }
  double progress() const override;

 private:
  void step();

  std::vector<Shot> shots_;
  std::size_t at_ = 0;
  int empty_ = 0;  // number of pictures without a star
  std::vector<Observation> observations_;
};

}  // namespace ols::calibration
