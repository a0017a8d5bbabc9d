// The mount of a simulated station's camera, in simulated time: a simulated PTU or ONVIF camera
// with the product's driver, or a fixed mount. A telescope mount is replaced by a PTU. Times are of
// the station's monotonic clock [s].
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "edge/mount/angle_history.h"
#include "edge/mount/goal.h"
#include "edge/mount/limits.h"
#include "edge/mount/reference.h"
#include "edge/mount/seen_path.h"
#include "sim/world/world.h"

namespace ols::sim {

class LockstepMount {
 public:
  virtual ~LockstepMount() = default;
  virtual void advance(double now_s) = 0;
  virtual std::vector<mount::AngleSample> take_samples() = 0;
  virtual void see(const mount::SeenTurn& /*turn*/) {}
  virtual void set_goal(const std::optional<mount::Goal>& goal) = 0;
  virtual mount::Reference reference() const = 0;
  virtual std::optional<mount::Limits> limits() const = 0;  // nullopt until the mount is ready
  // The shafts' angles as the unit counts them, at an instant from two seconds ago to now.
  virtual PanTilt angles_at(double time_s) const = 0;
  virtual std::map<std::string, double> counters() const = 0;
};

std::unique_ptr<LockstepMount> make_lockstep_mount(const World& world, std::size_t station,
                                                   std::uint64_t seed, double now_s);

}  // namespace ols::sim
