// The fusion: bearings in, targets and slews out. Pure: its time is that of the messages, so the
// same bearings in the same order give the same targets to the last digit. It never waits: a target
// is made as soon as "now" has gone on by a period, from what each station has delivered. Where
// there are many targets or stations, what a period brings is spread over some bearings
// (fusion_epoch.cpp).
#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "central/clock_monitor.h"
#include "central/estimator.h"
#include "central/message_time.h"
#include "central/pointing_monitor.h"
#include "central/sighting_check.h"
#include "central/slew_planner.h"
#include "central/stray_monitor.h"
#include "central/track_keeper.h"

namespace ols {

struct FusionConfig {
  std::string estimator = "filter";  // of the targets; a name of make_estimator()
  double rate_hz = 15.0;             // targets a second, at most, of each object
  double min_belief = 0.5;           // bearings believed less are not used
  double stale_s = 1.0;              // older than "now" by more is refused
  double future_s = 0.5;             // newer than "now" by more is refused
  double flood_hz = 1000.0;          // more bearings of one station are refused
  int paper_targets = 8;             // the paper's estimate is made of the first so many: it costs
                                     // the square of a target's stations
  std::vector<std::string> stations{};  // nobody else's bearings are taken; empty: anybody's
  int max_stations = 1024;  // one more takes the place of the one that is silent longest;
                            // never of one that has delivered and still does
  double silence_s = 0.3;   // who is silent for longer does not count for "now"
  EstimatorConfig estimators{};
  KeeperConfig keeper{};
  SlewConfig slew{};
  ClockMonitorConfig clocks{};
  PointingConfig pointing{};
  StrayConfig strays{};
};

// A station that has a target in view which no other one sees: where it is known to lie.
struct BearingOnly {
  std::string station;
  std::int64_t track_id = 0;  // the station's own
  LineOfSight sight;          // at the epoch
  Eigen::Vector2d rate_rad_s = Eigen::Vector2d::Zero();
};

struct FusedTarget {
  std::int64_t utime_us = 0;   // the epoch
  std::int64_t target_id = 0;  // 0: no object yet. A line's becomes that of its position
  TrackState state = TrackState::kBorn;
  std::string estimator;  // its name
  Estimate estimate;
  std::vector<ContributingStation> stations;  // in the order of their ids
  std::optional<BearingOnly> bearing_only;    // instead of a position
};

struct FusionOutput {
  SightingRefusal refusal = SightingRefusal::kNone;  // what became of the bearing
  // Of one epoch: each confirmed object; where there is none, what there is in place of it; and the
  // lines of stations that follow what is no target (kBearingOnly). Of many, some; the next
  // bearings bring the others of the same epoch, in the order of their ids, the lines last.
  std::vector<FusedTarget> targets;
  std::vector<FusedTarget> targets_paper;  // the paper's estimate of the same objects
  std::vector<Slew> slews;
};

// A station's bias and clock as the filter has them; NaN where the geometry does not show them.
struct StationFinding {
  Eigen::Vector2d bias_rad = nan_vector().head<2>();  // cross-elevation, elevation
  Eigen::Vector2d bias_sd_rad = nan_vector().head<2>();
  double clock_s = std::numeric_limits<double>::quiet_NaN();
  double clock_sd_s = std::numeric_limits<double>::quiet_NaN();
};

struct StationHealth {
  std::string station;
  std::int64_t bearings = 0;  // taken
  double rate_hz = 0.0;
  double age_s = 0.0;           // "now" minus its newest stamp
  double residual = 0.0;        // lately, RMS normalised; NaN if none
  double clock_offset_s = 0.0;  // of its stamps from the median; NaN if none
  std::string quarantine{};     // why it is not used; empty: it is
  StationFinding finding{};
};

struct FusionHealth {
  std::int64_t now_us = 0;
  std::vector<StationHealth> stations;     // in the order of their ids
  std::map<std::string, double> counters;  // only go up
  std::vector<std::string> alarms;         // what is wrong now, in words
  std::string last_error;
};

class Fusion {
 public:
  // std::invalid_argument for an unknown estimator.
  explicit Fusion(const FusionConfig& config);

  // What a station's status tells: so that it can be slewed before its first bearing.
  void know_station(const std::string& station, const StationTraits& traits);
  // ... and whether it may be slewed: also of a station that has lost its place.
  void allow_slews(const std::string& station, bool allowed);
  // One bearing, in order of arrival.
  FusionOutput add(const Sighting& sighting);

  FusionHealth health() const;
  std::int64_t now_us() const { return time_.now_us(); }
  const TrackKeeper& keeper() const { return keeper_; }

 private:
  struct Exposure {
    std::int64_t utime_us = 0;
    AzimuthElevation direction;
    std::int64_t track_id = 0;
  };
  struct Station {
    StationTraits traits;
    std::vector<Exposure> lately;  // by utime, of a second
    std::int64_t bearings = 0;
    double rate_hz = 0.0;
    bool delivered = false;  // a bearing, if only one that was refused
    std::int64_t heard = 0;  // messages_ at its last message
    std::int64_t calibration_id = 0;
    std::int64_t boot_id = 0;
    std::int64_t follows = 0;  // the target that it saw last
    std::int64_t followed_us = 0;

    void stands_where(const LineOfSight& sight) {
      traits.camera_ecef = sight.origin_ecef;
      traits.camera_sd_enu_m = sight.origin_sd_enu_m;
    }
  };
  struct Object {
    std::unique_ptr<Estimator> main, paper;
  };

  bool belongs(const std::string& station) const;
  bool full(const std::string& station) const;
  std::map<std::string, Station>::iterator longest_silent();
  bool may_go(const std::string& name, const Station& station) const;
  bool make_room(const std::string& station);
  void evict(std::map<std::string, Station>::iterator station);
  SightingRefusal admit(const Sighting& sighting);
  bool clock_is_believed(const Sighting& sighting);
  static bool is_doubled(const Sighting& sighting, const std::vector<Exposure>& lately);
  SightingRefusal store(const Sighting& sighting, Station& station);
  void notice_changes(const Sighting& sighting, Station& station);
  SightingRefusal associate(const Sighting& sighting, Station& station);
  void note_stray(const Sighting& sighting, const Association& result);
  void refuse(SightingRefusal refusal, const Sighting& sighting);
  void notice_step_back();
  void begin_epoch(std::int64_t now_us);
  void give_up_what_is_old(std::int64_t now_us);
  void locate(std::int64_t now_us, FusionOutput& output);
  const Track* next_of(std::deque<std::int64_t>& waiting) const;
  FusedTarget locate(const Track& track, bool by_paper);
  void tell_lines(FusionOutput& output);
  static bool sees(const Station& station, std::int64_t now);
  std::vector<std::string> on_a_line(std::int64_t epoch_us) const;
  std::vector<const Sighting*> lines_of(const std::string& station, std::int64_t epoch_us) const;
  std::optional<BearingOnly> line_of(const Sighting& newest, std::int64_t epoch_us) const;
  void begin_slews(std::int64_t now_us);
  void plan(std::int64_t now_us, FusionOutput& output);
  std::map<std::string, double> counters() const;

  FusionConfig config_;
  MessageTime time_;
  ClockMonitor clocks_;
  PointingMonitor pointing_;
  StrayMonitor strays_;
  TrackKeeper keeper_;
  SlewPlanner planner_;
  std::map<std::int64_t, Object> objects_;  // by target id
  std::map<std::string, Station> stations_;
  std::int64_t messages_ = 0;
  std::map<std::string, double> counters_;
  std::string last_error_;
  struct Epoch {
    std::optional<std::int64_t> utime_us{};  // the last; nothing: there was none
    std::deque<std::int64_t> targets{};      // that are not told yet; then come the lines,
    bool lines_told = true;
    std::deque<std::int64_t> papers{};  // then the paper's estimates

    bool is_over() const { return lines_told && papers.empty(); }
  };
  Epoch epoch_;
  SlewRound slew_round_;
  std::optional<std::int64_t> slewed_us_;  // the last round began
  std::optional<std::string> slew_next_;   // the station that is next in it; nothing: it is over
};

}  // namespace ols
