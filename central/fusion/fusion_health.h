// The fusion's report on itself.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "central/admission/admission.h"
#include "central/admission/pointing_monitor.h"
#include "central/admission/unassociated_monitor.h"
#include "central/cues/cue_registry.h"
#include "central/handover/handover_policy.h"
#include "central/tracking/track_manager.h"
#include "conditions/alarm.h"

namespace ols::fusion {

// The filter's estimate of a station's bias and clock; NaN if they are not observable.
struct StationBiasReport {
  Eigen::Vector2d bias_rad = nan_vector().head<2>();  // cross-elevation, elevation
  Eigen::Vector2d bias_sd_rad = nan_vector().head<2>();
  Eigen::Vector2d stated_sd_rad = nan_vector().head<2>();  // 1-sigma of the bias, stated by the
                                                           // station
  double clock_s = std::numeric_limits<double>::quiet_NaN();
  double clock_sd_s = std::numeric_limits<double>::quiet_NaN();
};

struct StationHealth {
  std::string station;
  std::int64_t bearings = 0;  // number of admitted bearings
  double rate_hz = 0.0;
  double age_s = 0.0;           // message time now, minus its newest stamp
  double residual = 0.0;        // recent RMS of the normalised residuals; NaN if there are none
  double clock_offset_s = 0.0;  // its stamps minus the median of all stations; NaN if unknown
  Alarm quarantine{};           // why its bearings are not used; empty if they are used
  StationBiasReport finding{};
  StatedCalibration calibration{};
};

struct FusionHealth {
  std::int64_t now_us = 0;
  std::vector<StationHealth> stations;     // sorted by id
  std::map<std::string, double> counters;  // never decrease
  std::vector<Alarm> alarms;               // current ones
  std::string last_error;
  std::vector<CueHealth> cues{};  // sorted by id
  HandoverMode handover = HandoverMode::kOff;
};

FusionHealth health_of(const Admission& admission, const PointingMonitor& pointing,
                       const UnassociatedMonitor& unassociated, const TrackManager& tracks,
                       const FusionLog& log);

}  // namespace ols::fusion
