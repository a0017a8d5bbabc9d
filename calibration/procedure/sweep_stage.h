// The stage of the automatic sweep: takes pictures all around, and finds points of the scenery in
// them. Pure.
#pragma once

#include <deque>

#include "calibration/pictures/scene_tracks.h"
#include "calibration/procedure/stage.h"

namespace ols::calibration {

class SweepStage : public Stage {
 public:
  // `geometry`: the station's geometry, as far as it is known.
  SweepStage(const StationGeometry& geometry, std::vector<Shot> shots);

  std::optional<Order> next() override;
  void taken(const Taken& picture) override;
  bool work() override;
  void not_taken(const std::string& why) override;
  void answered(const Answer&) override {}
  std::vector<Observation> observations() const override;
  double progress() const override;

 private:
  void step();

  std::vector<Shot> shots_;
  std::size_t at_ = 0;
  int missed_ = 0;
  SceneTracks tracks_;
  std::deque<Taken> waiting_;  // pictures in which the points have not been found yet
  std::vector<Taken> taken_;   // without their pixels
};

}  // namespace ols::calibration
