// What a station needs from the mount that carries its camera: angles with their times and errors,
// and a way to command them. Angles are the mount's own [rad]; times are CLOCK_MONOTONIC [s].
//
// The mount may be absent, vanish and come back at any time. While it is absent it gives no
// samples, and its report says why. Nothing moves before the first goal or home(). Every method may
// be called from any thread. None waits for the device, and none throws.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "edge/device/device_report.h"
#include "edge/mount/angle_history.h"
#include "edge/mount/goal.h"
#include "edge/mount/limits.h"
#include "edge/mount/reference.h"

namespace ols::mount {

class Mount {
 public:
  Mount() = default;
  virtual ~Mount() = default;  // halts the mount
  Mount(const Mount&) = delete;
  Mount& operator=(const Mount&) = delete;

  // Sets the goal; nullopt means halt. The goal is dropped in an emergency, and whenever the mount
  // or its reference is lost.
  virtual void set_goal(const std::optional<Goal>& goal) = 0;
  // The angle samples since the last call, oldest first. There are none while the reference is
  // missing or doubted.
  virtual std::vector<AngleSample> take_samples() = 0;
  // nullopt while the mount is not ready.
  virtual std::optional<Limits> limits() const = 0;

  // Halts the mount at once, before anything else that is on its way to the device. Nothing moves
  // before clear_emergency(). This only assists a stop in hardware.
  virtual void emergency_halt() = 0;
  virtual void clear_emergency() = 0;

  virtual Reference reference() const = 0;
  // Finds the reference again; the mount may sweep its whole travel. It is ignored in an emergency.
  virtual void home() = 0;
  virtual void stop_homing() = 0;
  // Permits the mount to home on its own, if it is configured to do so. Initially it is not
  // permitted.
  virtual void allow_rehoming(bool allowed) = 0;
  // Number of homings ordered by this process; each may leave the angles with another zero.
  virtual std::uint64_t homings() const = 0;
  // A person confirms that the angles are right.
  virtual void reference_ok() = 0;
  // Restores the doubt that an earlier process saved.
  virtual void restore_doubt(const std::optional<ReferenceDoubt>& doubt) = 0;
  // The doubt to be saved for the next process.
  virtual std::optional<ReferenceDoubt> doubt_to_persist() const = 0;

  // Its name is "ptu" for every kind of mount, because that is the name in a station's status.
  virtual device::DeviceReport report() const = 0;
};

}  // namespace ols::mount
