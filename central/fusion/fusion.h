// The fusion: takes bearings, and returns targets and slews. Pure: the only clock is the time
// stamps of the messages. The same bearings in the same order therefore give the same targets to
// the last digit. The fusion does not wait for slow stations: it computes targets once a period has
// passed and enough stations have delivered (epoch_rule.h). With many targets or stations, the work
// of a period is spread over several bearings.
//
// Admission decides which bearings are used. The tracks decide to which target each bearing
// belongs. The schedules decide what is published, and when.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "central/admission/admission.h"
#include "central/admission/image_assembly.h"
#include "central/admission/pointing_monitor.h"
#include "central/admission/unassociated_monitor.h"
#include "central/estimators/estimator.h"
#include "central/fusion/fused_target.h"
#include "central/fusion/fusion_health.h"
#include "central/fusion/occlusion_schedule.h"
#include "central/fusion/slew_schedule.h"
#include "central/fusion/target_schedule.h"
#include "central/ground/land_use.h"
#include "central/tracking/live_tracks.h"

namespace ols::fusion {

struct FusionConfig {
  std::string estimator = "filter";  // estimator of the targets: a name for make_estimator()
  double rate_hz = 15.0;             // each target is published at most this often
  // Largest number of targets for which the paper's estimate is also computed; 0 for none.
  int paper_targets = 8;
  AdmissionConfig admission{};
  EstimatorConfig estimators{};
  TrackManagerConfig tracks{};
  SlewConfig slew{};
  PointingConfig pointing{};
  UnassociatedConfig unassociated{};
  CueConfig cues{};
  HandoverConfig handover{};
  LandUse land{};
};

class Fusion {
 public:
  // Throws std::invalid_argument for an unknown estimator.
  explicit Fusion(const FusionConfig& config);

  // Takes a station's status, so that the station can be slewed before its first bearing.
  void know_station(const std::string& station, const StationTraits& traits);
  // Takes a part of the skyline that a station has seen. Ignored if the station is not known yet:
  // stations send their skylines repeatedly.
  void know_skyline(const SkylineSector& sector);
  // Notes whether a station may be slewed. For stations whose status contains no position; the
  // others use know_station().
  void allow_slews(const std::string& station, bool allowed);
  // Processes one bearing. Call in the order in which the bearings arrive.
  FusionOutput add(const BearingMeasurement& measurement);

  // Takes a target reported from outside. A cue may cause slews, but it changes no target.
  // present_us: this host's UTC; in a replay, the message's time.
  std::vector<Slew> add(const Cue& cue, std::int64_t present_us);
  // Takes an operator's decision on a cue, or on a target by its number (target_named()). Returns
  // false if there is no cue or target of this name, or if the site uses neither cues nor
  // hand-over.
  bool allow_cue(const std::string& id, bool allow);
  // Sets the policy for targets that only detectors have found: it decides which of them lead
  // stations.
  void set_handover(HandoverMode mode) { handover_.set_mode(mode); }
  HandoverMode handover() const { return handover_.mode(); }
  void end_silent_cues(std::int64_t present_us) { cues_.end_silent(present_us); }

  // present_us: the time for which the positions of cues are given.
  FusionHealth health(std::int64_t present_us = 0) const;
  std::int64_t now_us() const { return admission_.time().now_us(); }
  const LiveTracks& tracks() const { return tracks_; }

 private:
  // Associates an admitted bearing, and returns why it was not used. kNone while the bearing waits
  // for the other bearings of its image.
  BearingRefusal take(const BearingMeasurement& measurement, std::vector<ImageBearings>& used);
  std::vector<BearingRefusal> associate(const ImageBearings& image);
  void add_land_alarms(std::vector<Alarm>& alarms) const;
  void note_unassociated(const BearingMeasurement& measurement, const Association& result);
  void forget(const std::string& station);
  void forget_what_changed(const BearingMeasurement& measurement, const Admitted& admitted);
  void begin_time_line();
  std::vector<Slew> slews_at(std::int64_t now_us);
  void note_refusal(BearingRefusal refusal, const BearingMeasurement& measurement,
                    const Admitted& admitted);

  FusionConfig config_;
  Admission admission_;
  ImageAssembly images_;
  PointingMonitor pointing_;
  UnassociatedMonitor unassociated_;
  LiveTracks tracks_;
  TargetSchedule targets_;
  SlewSchedule slews_;
  OcclusionSchedule occlusions_;
  CueRegistry cues_;
  HandoverPolicy handover_;
  FusionLog log_;
};

}  // namespace ols::fusion
