// The fusion: bearings in, targets and slews out. Pure: its time is that of the messages, so the
// same bearings in the same order give the same targets to the last digit. It never waits: a target
// is made as soon as "now" has gone on by a period, from what each station has delivered.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "central/alignment.h"
#include "central/clock_monitor.h"
#include "central/least_squares.h"
#include "central/message_time.h"
#include "central/paper_triangulation.h"
#include "central/residual_monitor.h"
#include "central/sighting.h"
#include "central/slew_planner.h"

namespace ols {

struct FusionConfig {
  double rate_hz = 15.0;    // targets a second, at most
  double min_belief = 0.5;  // bearings believed less are not used
  double stale_s = 1.0;     // older than "now" by more is refused
  double future_s = 0.5;    // newer than "now" by more is refused
  int paper_average = 10;   // h of the paper's moving average
  int max_stations = 64;    // one more takes the place of the one that is silent longest; never of
                            // one that has delivered and still does
  AlignmentConfig alignment{};
  LeastSquaresConfig least_squares{};
  PaperConfig paper{};
  ResidualConfig residuals{};
  SlewConfig slew{};
  ClockMonitorConfig clocks{};
};

// Why a bearing was not used; to_string() is the name of its counter.
enum class SightingRefusal {
  kNone,
  kNotFinite,
  kOutOfRange,
  kCovariance,  // out of range, or white not well conditioned, or systematic not semidefinite
  kStale,
  kFuture,
  kDuplicate,
  kQuarantine,  // the station's clock cannot be believed
  kTooMany,     // more stations than there are places
  kLowBelief,
};
const char* to_string(SightingRefusal refusal);

// What can be judged of a bearing by itself.
SightingRefusal check(const Sighting& sighting);

struct ContributingStation {
  std::string station;
  bool used = false;
  double weight = 0.0;
  double age_s = 0.0;
};

struct FusedTarget {
  std::int64_t utime_us = 0;  // the epoch
  std::int64_t target_id = 0;
  std::string estimator;  // "least-squares" or "paper"
  Estimate estimate;
  std::vector<ContributingStation> stations;  // in the order of their ids
};

struct FusionOutput {
  SightingRefusal refusal = SightingRefusal::kNone;  // what became of the bearing
  std::optional<FusedTarget> target;                 // joint least squares
  std::optional<FusedTarget> target_paper;  // Algorithm 1 and moving average, the same epoch
  std::vector<Slew> slews;
};

struct StationHealth {
  std::string station;
  std::int64_t bearings = 0;  // taken
  double rate_hz = 0.0;
  double age_s = 0.0;           // "now" minus its newest stamp
  double residual = 0.0;        // lately, RMS normalised; NaN if none
  double clock_offset_s = 0.0;  // of its stamps from the median; NaN if none
  std::string quarantine;       // why it is not used; empty: it is
};

struct FusionHealth {
  std::int64_t now_us = 0;
  std::vector<StationHealth> stations;     // in the order of their ids
  std::map<std::string, double> counters;  // only go up
  std::string last_error;
};

class Fusion {
 public:
  explicit Fusion(const FusionConfig& config);

  // A station that has sent no bearing yet, from its status: so that it can be slewed.
  void know_station(const std::string& station, const Eigen::Vector3d& camera_ecef);
  // One bearing, in order of arrival.
  FusionOutput add(const Sighting& sighting);

  FusionHealth health() const;
  std::int64_t now_us() const { return time_.now_us(); }

 private:
  struct Station {
    Eigen::Vector3d camera_ecef = Eigen::Vector3d::Zero();
    std::vector<Sighting> sightings;  // by utime
    std::int64_t bearings = 0;
    double rate_hz = 0.0;
    bool delivered = false;  // a bearing, if only one that was refused
    std::int64_t heard = 0;  // messages_ at its last message
  };

  bool full(const std::string& station) const;
  std::map<std::string, Station>::iterator longest_silent();
  bool may_go(const std::string& name, const Station& station) const;
  bool make_room(const std::string& station);
  void evict(std::map<std::string, Station>::iterator station);
  SightingRefusal admit(const Sighting& sighting);
  bool clock_is_believed(const Sighting& sighting);
  SightingRefusal store(const Sighting& sighting);
  void refuse(SightingRefusal refusal, const Sighting& sighting);
  void notice_step_back();
  std::vector<Ray> rays_at(std::int64_t epoch_us) const;
  void locate(std::int64_t epoch_us, FusionOutput& output);
  void plan(std::int64_t now_us, FusionOutput& output);

  FusionConfig config_;
  MessageTime time_;
  ResidualMonitor monitor_;
  ClockMonitor clocks_;
  MovingAverage average_;
  std::map<std::string, Station> stations_;
  std::int64_t messages_ = 0;
  std::map<std::string, double> counters_;
  std::string last_error_;
  std::optional<std::int64_t> last_epoch_us_;
  std::optional<std::int64_t> last_slew_us_;
  std::optional<std::int64_t> last_average_us_;
  std::optional<FusedTarget> last_target_;  // the last one with a position
};

}  // namespace ols
