// Converts the positions that a camera reports to angles with their times and errors. Pure.
//
// An answer contains no time. Its position is taken to hold `delay_s` before the middle between
// request and answer. Many cameras renew their position only a few times a second. A position that
// is still the same although the ordered motion should have changed it is old, and is not used.
#pragma once

#include <optional>
#include <vector>

#include "edge/device/reading_queue.h"
#include "edge/mount/angle_history.h"
#include "geometry/angles.h"

namespace ols::onvif {

// The larger of the differences of the two axes [rad].
double distance(const PanTilt& a, const PanTilt& b);

class PositionIntake {
 public:
  struct Config {
    double delay_s = 0.05;         // age of a position in the middle between request and answer
    double delay_sd_s = 0.05;      // 1-sigma of delay_s
    double sd_rad = radians(0.1);  // 1-sigma of a position: repeatability
  };
  explicit PositionIntake(const Config& config) : config_(config) {}

  // `ordered_rad_s`: the ordered speed of the faster axis; 0 at rest.
  void add(const PanTilt& angles, double sent_s, double answered_s, double ordered_rad_s);
  void restart();
  std::vector<mount::AngleSample> take() { return samples_.take(); }

  double round_trip_s() const { return round_trip_s_; }
  // The time between two positions that differ, in motion; 0 if it is not known yet.
  double interval_s() const;
  // 1-sigma of a position: the configured value, or the scatter of positions at rest if that is
  // larger.
  double sd_rad() const;

 private:
  void measure_rest(const PanTilt& angles, double now_s, double ordered_rad_s);

  Config config_;
  device::ReadingQueue<mount::AngleSample> samples_;
  std::optional<PanTilt> last_;
  double last_s_ = 0.0, changed_s_ = 0.0;
  double round_trip_s_ = 0.0, poll_s_ = 0.0, old_share_ = 0.0;
  bool moved_ = false;
  double rests_since_s_ = 0.0;
  PanTilt rest_mean_;
  double rest_variance_rad2_ = 0.0;
  int rest_count_ = 0;
};

}  // namespace ols::onvif
