// The interface of all kinds of mounts that carry a station's camera. A mount reports its angles
// with times and errors, and obeys goals. Angles are the mount's own [rad]; times are
// CLOCK_MONOTONIC [s].
//
// The mount may be absent at the start, disappear and return at any time. While it is absent, there
// are no samples, and report() states the reason. The mount does not move before the first goal or
// home(). Every method may be called from any thread. None waits for the device, and none throws.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "edge/device/device_report.h"
#include "edge/mount/angle_history.h"
#include "edge/mount/goal.h"
#include "edge/mount/limits.h"
#include "edge/mount/reference.h"
#include "edge/mount/seen_path.h"

namespace ols::mount {

class Mount {
 public:
  Mount() = default;
  virtual ~Mount() = default;  // halts the mount
  Mount(const Mount&) = delete;
  Mount& operator=(const Mount&) = delete;

  // Sets the goal; nullopt means halt. The goal is dropped in an emergency, and when the mount or
  // its reference is lost.
  virtual void set_goal(const std::optional<Goal>& goal) = 0;
  // The angle samples since the last call, oldest first. There are none while the reference is
  // missing or doubted.
  virtual std::vector<AngleSample> take_samples() = 0;
  // Takes a turn of the camera between two pictures, by the pictures alone. A mount that other
  // programs can also turn judges by it whether it moves without an order. The others ignore it.
  virtual void see(const SeenTurn& /*turn*/) {}
  // The range in which the mount can point; nullopt while the mount is not ready.
  virtual std::optional<Limits> limits() const = 0;

  // Halts the mount at once; this order overtakes all others. The mount does not move again before
  // clear_emergency(). This halt is only an addition to a stop by hardware.
  virtual void emergency_halt() = 0;
  virtual void clear_emergency() = 0;

  virtual Reference reference() const = 0;
  // Starts homing, which finds the reference again. The mount may sweep its whole travel. Ignored
  // in an emergency.
  virtual void home() = 0;
  virtual void stop_homing() = 0;
  // Sets whether the mount may start homing by itself, if it is configured to do so. Initially it
  // may not.
  virtual void allow_rehoming(bool allowed) = 0;
  // Number of homings that this process has ordered. Each may change the zero of the angles.
  virtual std::uint64_t homings() const = 0;
  // A person confirms that the angles are right.
  virtual void reference_ok() = 0;
  // Restores the doubt about the reference that an earlier process has saved.
  virtual void restore_doubt(const std::optional<ReferenceDoubt>& doubt) = 0;
  // The doubt about the reference to save for the next process; nullopt if there is none.
  virtual std::optional<ReferenceDoubt> doubt_to_persist() const = 0;

  // The `name` in the report is "ptu" for every kind of mount, because a station's status uses this
  // name.
  virtual device::DeviceReport report() const = 0;
};

}  // namespace ols::mount
