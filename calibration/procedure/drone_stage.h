// The stage of a calibration with a drone that records its positions by RTK. The drone hovers at
// one point after another, and a person reports when it hovers. The unit then turns to the drone
// and takes a picture. Once the recorded positions extend beyond the time of the picture, the drone
// is found in the picture. Then the stage proposes the most helpful next point. Pure.
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
  std::string name;  // the drone's name in the references
  int points = 40;
};

class DroneStage : public Stage {
 public:
  // Returns the drone's positions known so far; empty if there are none yet.
  using Positions = std::function<Trajectory()>;
  // `now`: [us] UTC. `adviser`: ranks the points to which the drone can fly next; may be empty.
  // `may_go`: whether the unit's travel limits and keep-out regions allow a direction.
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
  // `now_us`: when the person answered. If the procedure is resumed and its answers are replayed,
  // this time is that of the original answer.
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
  Question question_;             // asks the person to fly the drone to the next point
  std::optional<Shot> shot_;      // the picture to be taken next
  std::optional<Taken> picture_;  // kept until the positions extend beyond its time
  PanTilt turned_;                // how far the person has turned the unit at this point
  PointingDialog dialog_;
  // Offset of the last sighting from the kinematic chain's prediction; nullopt before the first.
  std::optional<Eigen::Vector2d> beside_px_;
  std::vector<Observation> observations_;
};

// The position at an instant, interpolated linearly between two recorded points. Up to `beyond_us`
// after the last point, returns that point. nullopt outside this time, and in gaps of the
// recording.
std::optional<Eigen::Vector3d> position_at(const Trajectory& trajectory, std::int64_t utime_us,
                                           std::int64_t beyond_us);

}  // namespace ols::calibration
