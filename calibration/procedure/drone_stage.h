// A drone with RTK: it hovers at one point after the other, a person says when, the unit looks
// there and, once its positions reach beyond the picture, the drone is found in it; where it flies
// next is what helps most. Pure.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "calibration/procedure/pointing_dialog.h"
#include "calibration/procedure/sighting_planner.h"
#include "calibration/procedure/stage.h"
#include "calibration/procedure/sun_stage.h"

namespace ols::calibration {

struct DroneOptions {
  std::string name;  // as in the references
  int points = 40;
};

class DroneStage : public Stage {
 public:
  // What is known of the drone's positions by now; empty: nothing yet.
  using Positions = std::function<Trajectory()>;
  // `now`: [us] UTC. `adviser`: where the drone should fly next; may be empty. `may_go`: the unit's
  // travel and keep-out regions.
  DroneStage(const StationModel& model, DroneOptions options, Positions positions,
             SunKeepOut::UtcNow now, MayGo may_go, Adviser adviser = nullptr);

  std::optional<Order> next() override;
  void taken(const Taken& picture) override;
  void not_taken(const std::string& why) override;
  void answered(const Answer& answer) override;
  std::vector<Observation> observations() const override { return observations_; }
  double progress() const override;

 private:
  void ask(const std::string& trouble);
  // `now_us`: of the answer, also when the procedure is gone on with later.
  void sight(std::int64_t now_us);
  void judge();
  void confirm(const Taken& picture, const Eigen::Vector2d& pixel, double sd_px);
  std::string advice() const;
  std::vector<Place> places() const;

  StationModel model_;
  DroneOptions options_;
  Positions positions_;
  SunKeepOut::UtcNow now_;
  MayGo may_go_;
  Adviser adviser_;
  bool done_ = false;
  Question question_;             // where to fly
  std::optional<Shot> shot_;      // to be taken
  std::optional<Taken> picture_;  // until the positions reach beyond it
  PanTilt turned_;                // by the person, of this point
  PointingDialog dialog_;
  // The last sighting beside where the chain had it; nothing before the first.
  std::optional<Eigen::Vector2d> beside_px_;
  std::vector<Observation> observations_;
};

// Where a trajectory is at an instant: between its points straight, at most `beyond_us` after the
// last one where that is.
std::optional<Eigen::Vector3d> position_at(const Trajectory& trajectory, std::int64_t utime_us,
                                           std::int64_t beyond_us);

}  // namespace ols::calibration
