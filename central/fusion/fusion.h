// The fusion: bearings in, targets and slews out. Pure: its time is that of the messages, so the
// same bearings in the same order give the same targets to the last digit. It never waits: targets
// are computed as soon as "now" has advanced by a period, from what each station has delivered.
// With many targets or stations, the work of a period is spread over several bearings.
//
// Admission decides which bearings are used, the tracks which target each belongs to, the schedules
// what is published when.
#pragma once

#include <cstdint>
#include <string>

#include "central/admission/admission.h"
#include "central/admission/pointing_monitor.h"
#include "central/admission/unassociated_monitor.h"
#include "central/estimators/estimator.h"
#include "central/fusion/fused_target.h"
#include "central/fusion/fusion_health.h"
#include "central/fusion/slew_schedule.h"
#include "central/fusion/target_schedule.h"
#include "central/tracking/live_tracks.h"

namespace ols::fusion {

struct FusionConfig {
  std::string estimator = "filter";  // of the targets; a name of make_estimator()
  double rate_hz = 15.0;             // max targets per second, of each object
  int paper_targets = 8;  // of this many targets the paper's estimate is made as well; 0: of none
  AdmissionConfig admission{};
  EstimatorConfig estimators{};
  TrackManagerConfig keeper{};
  SlewConfig slew{};
  PointingConfig pointing{};
  UnassociatedConfig unassociated{};
};

class Fusion {
 public:
  // Throws std::invalid_argument for an unknown estimator.
  explicit Fusion(const FusionConfig& config);

  // Takes a station's status, so that it can be slewed before its first bearing.
  void know_station(const std::string& station, const StationTraits& traits);
  // The same for a station without a position: only whether it may be slewed.
  void allow_slews(const std::string& station, bool allowed);
  // Processes one bearing, in order of arrival.
  FusionOutput add(const BearingMeasurement& measurement);

  FusionHealth health() const;
  std::int64_t now_us() const { return admission_.time().now_us(); }
  const TrackManager& tracks() const { return tracks_; }

 private:
  BearingRefusal associate(const BearingMeasurement& measurement, KnownStation& station);
  void note_unassociated(const BearingMeasurement& measurement, const Association& result);
  void forget(const std::string& station);
  void forget_what_changed(const BearingMeasurement& measurement, const Admitted& admitted);
  void begin_time_line();
  void note_refusal(BearingRefusal refusal, const BearingMeasurement& measurement);

  FusionConfig config_;
  Admission admission_;
  PointingMonitor pointing_;
  UnassociatedMonitor unassociated_;
  LiveTracks tracks_;
  TargetSchedule targets_;
  SlewSchedule slews_;
  FusionLog log_;
};

}  // namespace ols::fusion
