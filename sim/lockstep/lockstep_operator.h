// The operator of one station in simulated time. The operator points the camera roughly at the
// target. Once the camera is at rest and the target is in its image, the operator designates the
// target.
#pragma once

#include <deque>
#include <optional>
#include <random>

#include "edge/station/station.h"
#include "sim/lockstep/fidelity.h"
#include "sim/lockstep/lockstep_mount.h"
#include "sim/world/renderer.h"
#include "sim/world/world.h"

namespace ols::sim {

// The source of all random numbers of one station.
struct LockstepNoise {
  explicit LockstepNoise(std::uint64_t seed) : generator(seed) {}
  double uniform() { return std::uniform_real_distribution<double>()(generator); }
  double gaussian() { return normal(generator); }

  std::mt19937_64 generator;
  std::normal_distribution<double> normal;
};

// The station's monotonic clock at an instant of true time.
double monotonic_s(double time_s);

class LockstepOperator {
 public:
  struct Seen {
    double stamp_s = 0.0;
    ExposureTruth exposure;
    ViewTruth view;
  };

  // All arguments but `fidelity` must outlive this object.
  LockstepOperator(const World& world, std::size_t index, const Fidelity& fidelity,
                   LockstepNoise& noise, const LockstepMount& mount, station::Station& station);

  void see(const Seen& seen);
  // The operator's action at this instant, once the PTU is ready.
  void act(double time_s);

  bool designated() const { return designated_; }
  bool leaves_alone() const { return leaves_alone_; }

 private:
  void point_roughly(double time_s);
  void designate_seen(double time_s);
  std::optional<cv::Rect2d> marked(const Seen& seen) const;
  bool stands_since(double from_s, double time_s) const;

  const World& world_;
  std::size_t index_;
  LockstepNoise& noise_;
  const LockstepMount& mount_;  // tells whether the mount moves, as a real image does
  station::Station& station_;
  std::optional<Misdesignation> wrong_;
  bool leaves_alone_;
  std::deque<Seen> seen_;  // of the last second
  PanTilt aiming_error_;
  double ready_s_ = -1.0, pointed_s_ = -1.0;
  bool designated_ = false;
};

}  // namespace ols::sim
