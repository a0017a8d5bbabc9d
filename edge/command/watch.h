// Decides where a station looks while nothing else uses its unit. The station looks at the middle
// of its field of regard. If the field is larger than the picture, the station steps through the
// field picture by picture, and stays at each for a while. If the detector sees an object there,
// the station stays longer, so that other stations can be led along the line of sight to the
// object. Pure.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "conditions/alarm.h"
#include "edge/frames/pointing_model.h"
#include "edge/mount/goal.h"

namespace ols::station {

// The centres of the pictures that cover the field, row by row, alternately forwards and backwards.
// Neighbouring pictures overlap by a tenth. `view_rad`: width and height of a picture.
std::vector<AzimuthElevation> pictures_of(const WatchConfig& config,
                                          const Eigen::Vector2d& view_rad);

class Watch {
 public:
  // Time at a picture with an object, unless WatchConfig::stay_s is longer.
  static constexpr double kLongest_s = 10.0;

  explicit Watch(const WatchConfig& config) : config_(config) {}

  // Call in every cycle of the control loop. `free`: nothing else uses the unit. `sees`: the
  // detector sees an object now. Returns the unit's goal; nullopt if the station does not watch, or
  // can look at none of the pictures.
  std::optional<mount::Goal> step(double now_s, bool free, bool sees,
                                  const PointingModel& pointing);
  // The alarm that the unit cannot look at some pictures of the field; empty if it can look at all
  // of them.
  Alarm alarm() const;

 private:
  void judge(double now_s, const std::vector<AzimuthElevation>& pictures,
             const PointingModel& pointing);
  bool is_over(double now_s, bool sees) const;
  void go_on();

  WatchConfig config_;
  std::size_t picture_ = 0;
  std::optional<double> stands_since_s_;
  double judged_s_ = -1e9;
  int beyond_reach_ = 0, all_ = 0;  // numbers of the field's pictures: out of reach; all
};

}  // namespace ols::station
