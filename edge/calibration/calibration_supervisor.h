// The calibration of a running station. Also checks whether the station has moved since it was
// calibrated.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/process/clocks.h"
#include "conditions/alarm.h"
#include "edge/calibration/active_calibration.h"
#include "edge/calibration/calibration_folder_watch.h"
#include "edge/calibration/reference_views.h"

namespace ols::station {

class CalibrationSupervisor {
 public:
  using UtcNow = std::function<std::int64_t()>;  // [us] used for the position of the sun
  explicit CalibrationSupervisor(const StationSettings& configured, UtcNow now = clock_utime_us);

  const StationSettings& settings() const { return in_use_.settings(); }
  // True if the calibration was dropped just now because it belongs to other devices; settings()
  // has changed.
  bool refuses(const std::vector<device::DeviceReport>& devices);
  // As above, for the size of a count [rad] that the unit reports.
  bool refuses(const PanTilt& count_rad);

  // True if a newly accepted calibration was adopted just now; settings() has changed. `idle`:
  // nothing (target, operator, slew) would be disturbed by the jump in the angles.
  bool adopts(double now_s, bool idle, const std::vector<device::DeviceReport>& devices,
              const PanTilt& count_rad);

  void set_limits(const mount::Limits& limits);
  // Call in every turn. While the station is free, returns the goal of a check of the reference
  // views.
  std::optional<mount::Goal> step(const ViewTour::Situation& situation);
  void see(const camera::Frame& frame);
  // Requests a check soon if the unit has homed.
  void note_homings(std::uint64_t homings);

  // The error that bearings must add from now on; nullopt if it has not changed.
  struct Doubt {
    double heading_rad = 0.0, tilt_rad = 0.0;
  };
  std::optional<Doubt> take_doubt();

  CalibrationStatus status() const;
  std::vector<Alarm> alarms() const;
  std::map<std::string, double> counters() const;

 private:
  void begin();

  UtcNow now_;
  // Declared first, because a change while the folder is read counts as another calibration.
  CalibrationFolderWatch next_;
  ActiveCalibration in_use_;
  // Null if no calibration is in use, or no checks are configured.
  std::unique_ptr<ReferenceViews> views_;
  int doubt_revision_ = 0;
  std::uint64_t homings_ = 0;
};

}  // namespace ols::station
