// Converts the positions that a mount reports to angle samples with times and errors. Pure.
//
// An answer contains no time. The time of its position is assumed to be the middle between request
// and answer, minus `delay_s`. The scatter of this time within the round trip is learnt in motion:
// while the ordered rate is constant, three consecutive positions should lie on a straight line.
// Many mounts renew their position only a few times a second. If the ordered motion should have
// changed the position, but the report is the same as before, the report is old and is not used.
#pragma once

#include <array>
#include <deque>
#include <optional>
#include <vector>

#include "edge/device/reading_queue.h"
#include "edge/mount/angle_history.h"
#include "geometry/angles.h"

namespace ols::mount {

// The larger one of the two axes' differences [rad].
double distance(const PanTilt& a, const PanTilt& b);

class PositionIntake {
 public:
  struct Config {
    double delay_s = 0.05;         // age of a position at the middle between request and answer
    double delay_sd_s = 0.05;      // 1-sigma of delay_s
    double sd_rad = radians(0.1);  // 1-sigma of a position: repeatability
  };
  explicit PositionIntake(const Config& config) : config_(config) {}

  // Notes an order that the mount has accepted. `rate`: nullopt for a move to a position, because
  // its rate is not known.
  void ordered(const std::optional<PanTilt>& rate, double now_s);
  // Adds a reported position. `ordered_rad_s`: the ordered speed of the faster axis; 0 at rest.
  void add(const PanTilt& angles, double sent_s, double answered_s, double ordered_rad_s);
  void restart();
  std::vector<AngleSample> take() { return samples_.take(); }

  double round_trip_s() const { return round_trip_s_; }
  // The interval at which the mount renews its position while it moves; 0 if the interval is not
  // known yet.
  double interval_s() const;
  // 1-sigma of a position: the configured value or the scatter of the positions at rest, whichever
  // is larger.
  double sd_rad() const;

 private:
  struct RateOrder {
    double time_s;
    std::optional<PanTilt> rate;
  };
  // A position in motion. `spread_s`: 1-sigma of an instant that is uniformly distributed over the
  // round trip.
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
  std::deque<RateOrder> orders_;  // the orders of the last ten seconds, and the one before them
  std::array<Moved, 3> moved_in_row_{};
  // seen_spread_rad2_: mean squared distance of the positions from straight lines, minus the part
  // that sd_rad() explains. whole_spread_rad2_: the value to expect if the times were uniformly
  // distributed over the whole round trip.
  double seen_spread_rad2_ = 0.0, whole_spread_rad2_ = 0.0;
  std::optional<double> added_s_;  // time of the last sample
};

}  // namespace ols::mount
