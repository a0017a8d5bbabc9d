// Manages the calibration of a running station, and checks whether the station has moved since it
// was calibrated.
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
  using UtcNow = std::function<std::int64_t()>;  // UTC [us]; used for the position of the sun
  explicit CalibrationSupervisor(const StationSettings& configured, UtcNow now = clock_utime_us);

  const StationSettings& settings() const { return in_use_.settings(); }
  // True if this call has dropped the calibration, because it belongs to other devices; settings()
  // has then changed.
  bool refuses(const std::vector<device::DeviceReport>& devices);
  // Likewise, for the size of a count [rad] that the unit reports.
  bool refuses(const PanTilt& count_rad);

  // True if this call has adopted a newly accepted calibration; settings() has then changed.
  // `idle`: there is no target, operator or slew that the jump of the angles would disturb.
  bool adopts(double now_s, bool idle, const std::vector<device::DeviceReport>& devices,
              const PanTilt& count_rad);

  void set_limits(const mount::Limits& limits);
  // Call in every cycle of the control loop. While the station is free, returns the unit's goal for
  // a check of the reference views, if one is under way.
  std::optional<mount::Goal> step(const ViewTour::Situation& situation);
  void see(const camera::Frame& frame);
  // Requests a check if the unit has homed since the last call. `homings`: number of homings so
  // far.
  void note_homings(std::uint64_t homings);

  // The 1-sigma that bearings must add from now on; nullopt if it has not changed since the last
  // call.
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
  // Declared before in_use_, because it must note the folder's state before in_use_ reads the
  // folder. If the folder changes in between, next_ finds another calibration.
  CalibrationFolderWatch next_;
  ActiveCalibration in_use_;
  // Null if no calibration is in use, or no checks are configured.
  std::unique_ptr<ReferenceViews> views_;
  int doubt_revision_ = 0;
  std::uint64_t homings_ = 0;
};

}  // namespace ols::station
