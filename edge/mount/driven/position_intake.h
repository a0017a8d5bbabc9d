// Converts the positions that a mount reports to angles with their times and errors. Pure.
//
// An answer contains no time. Its position is taken to hold `delay_s` before the middle between
// request and answer. How far that instant scatters within the round trip is learnt in motion:
// three positions in a row should lie on a straight line while the ordered rate is constant. Many
// mounts renew their position only a few times a second. A position that is still the same although
// the ordered motion should have changed it is old, and is not used.
#pragma once

#include <array>
#include <deque>
#include <optional>
#include <vector>

#include "edge/device/reading_queue.h"
#include "edge/mount/angle_history.h"
#include "geometry/angles.h"

namespace ols::mount {

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

  // An accepted order; nullopt: a move to a place, whose rate is not known.
  void ordered(const std::optional<PanTilt>& rate, double now_s);
  // `ordered_rad_s`: the ordered speed of the faster axis; 0 at rest.
  void add(const PanTilt& angles, double sent_s, double answered_s, double ordered_rad_s);
  void restart();
  std::vector<AngleSample> take() { return samples_.take(); }

  double round_trip_s() const { return round_trip_s_; }
  // The time between two positions that differ, in motion; 0 if it is not known yet.
  double interval_s() const;
  // 1-sigma of a position: the configured value, or the scatter of positions at rest if that is
  // larger.
  double sd_rad() const;

 private:
  struct RateOrder {
    double time_s;
    std::optional<PanTilt> rate;
  };
  // A position in motion. `spread_s`: the 1-sigma of an instant anywhere in its round trip.
  struct Moved {
    double time_s, spread_s;
    PanTilt angles;
  };

  void measure_rest(const PanTilt& angles, double now_s, double ordered_rad_s);
  std::optional<PanTilt> ordered_change(double since_s) const;
  void learn_spread(const Moved& newest);

  Config config_;
  device::ReadingQueue<AngleSample> samples_;
  std::optional<PanTilt> last_;
  double last_s_ = 0.0, changed_s_ = 0.0;
  double round_trip_s_ = 0.0, poll_s_ = 0.0, old_share_ = 0.0;
  bool moved_ = false;
  double rests_since_s_ = 0.0;
  PanTilt rest_mean_;
  double rest_variance_rad2_ = 0.0;
  int rest_count_ = 0;
  std::deque<RateOrder> orders_;  // the last ones, and the one in force before them
  std::array<Moved, 3> moved_in_row_{};
  // Means of the squared distances from straight lines beyond what sd_rad() explains, and of what
  // the round trips would explain.
  double seen_spread_rad2_ = 0.0, whole_spread_rad2_ = 0.0;
  std::optional<double> added_s_;  // time of the last sample
};

}  // namespace ols::mount
