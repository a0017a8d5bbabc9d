// Decides where a station looks while nothing else uses its unit. The station looks at the middle
// of its field of regard. If the field is larger than the picture, the station steps through the
// field picture by picture, and stays at each for a while. If the detector sees an object there,
// the station stays longer, so that other stations can be led along its line of sight. Pure.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "conditions/alarm.h"
#include "edge/frames/pointing_model.h"
#include "edge/mount/goal.h"

namespace ols::station {

// The centres of the pictures that cover the field, row by row, to and fro. Neighbouring pictures
// overlap by a tenth. `view_rad`: width and height of the picture.
std::vector<AzimuthElevation> pictures_of(const WatchConfig& config,
                                          const Eigen::Vector2d& view_rad);

class Watch {
 public:
  static constexpr double kLongest_s = 10.0;  // largest time at one picture, whatever is seen there

  explicit Watch(const WatchConfig& config) : config_(config) {}

  // Call in every turn. `free`: nothing else uses the unit. `sees`: the detector sees an object
  // now. Returns the unit's goal; nullopt if the station is not watching, or cannot look there.
  std::optional<mount::Goal> step(double now_s, bool free, bool sees,
                                  const PointingModel& pointing);
  // Raised while some pictures of the field are beyond the unit's reach.
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
  int beyond_reach_ = 0, all_ = 0;  // pictures of the field
};

}  // namespace ols::station
