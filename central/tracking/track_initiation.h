// Initiates tracks from unassociated bearings: where rays of different stations intersect, there
// may be an object. Pure.
//
// Each intersection is a hypothesis. Rays to different objects also intersect (ghosts). A
// hypothesis must therefore explain the recent bearings of its stations, not only the two rays that
// intersect: a filter is run over these bearings. If three stations agree, the hypothesis is
// accepted at once. If only two stations agree, they must agree for longer. In the meantime, the
// tracks of the true objects take their own bearings. The filter first uses the bearings of the two
// stations whose rays intersect. A third station that is wrong, or that follows another object, is
// then outside the gate and does no harm. Two stations alone initiate no track that is below the
// ground or hidden by it (behind_land.h).
//
// The cost of a search grows with the number of stations that have unassociated bearings. If there
// are many such stations, only some bearings cause a search, and the stations take turns. The cost
// per bearing is therefore bounded.
#pragma once

#include <cmath>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "central/measurement/time_span.h"
#include "central/tracking/ray_meetings.h"
#include "central/tracking/track.h"
#include "land/surface.h"

namespace ols::fusion {

struct InitiationConfig {
  double pool_s = 0.6;  // how long unassociated bearings are kept
  MeetingConfig meeting{};
  double explained = 0.6;  // smallest share of a station's frames that a hypothesis must explain
  double two_stations_s = 0.35;  // if only two stations agree, they must agree for this long
  int least_bearings = 6;
  int pool_of_a_station = 64;                   // largest number of bearings kept per station
  std::shared_ptr<const land::Surface> land{};  // null if no land is known
};

// A new track, and the evidence of its bearings about the stations' errors.
struct TrackStart {
  Track track;
  BiasModel evidence;
};

class TrackInitiation {
 public:
  TrackInitiation(const InitiationConfig& config, const FilterConfig& filter)
      : config_(config),
        filter_(filter),
        meetings_(config.meeting, filter.max_range_m),
        pool_(config.pool_s, config.pool_of_a_station) {}

  // Takes an unassociated bearing. Returns a new track, if any, and removes the track's bearings
  // from the pool. If many stations wait for a search, the track may consist of other bearings than
  // this one. accept_two_rays: two rays are enough to begin a track; their bearings then stay in
  // the pool.
  std::optional<TrackStart> add(const BearingMeasurement& measurement, const BiasModel& errors,
                                bool accept_two_rays);
  // Keeps a bearing without a search.
  void store(const BearingMeasurement& measurement) { pool_.store(measurement); }
  // Removes the bearings that a newly confirmed track explains.
  void give(const Track& track, const BiasModel& errors);
  void forget(const std::string& station) { pool_.forget(station); }
  void clear() { *this = TrackInitiation(config_, filter_); }
  // Whether two bearings of about the same time may belong to one object.
  bool may_meet(const BearingMeasurement& a, const BearingMeasurement& b,
                const BiasModel& errors) const {
    const double apart_s = std::abs(seconds(a.utime_us - b.utime_us));
    return apart_s <= config_.meeting.pair_s && meetings_.may_meet(a, b, errors);
  }
  const UnassociatedBearings& pool() const { return pool_; }
  // Why the last searched bearing began no track. kRaysMiss: rays intersect, but the bearings of
  // their stations do not agree. kTooFewRays: the bearings agree but more are needed, or there was
  // no other ray. Otherwise: why the bearing's ray and the last ray compared with it give no
  // position.
  Solution why_no_track() const { return failure_; }
  // Why there is no track at this instant. kTooFewRays or kBearingOnly if no station or only one
  // has recent unassociated bearings; otherwise why_no_track().
  Solution why_none(std::int64_t now_us) const;

 private:
  // A candidate track, and how well it explains the bearings.
  struct Hypothesis {
    TrackStart start;
    int bearings = 0;      // number of explained bearings of the agreeing stations
    double span_s = 0.0;   // time span of those bearings
    bool settled = false;  // the iteration of the filter has converged
    // Mean squared normalised residual over the frames of the agreeing stations; NaN if there are
    // none.
    double misfit = 0.0;
  };
  // How long two stations must agree: not at all, half of two_stations_s, or all of it.
  enum class Needed { kTwoRays, kHalf, kAll };
  std::optional<TrackStart> search(const BearingMeasurement& measurement, const BiasModel& errors,
                                   bool accept_two_rays);
  std::optional<BearingMeasurement> next_station_to_search(const BearingMeasurement& measurement);
  std::vector<const UnassociatedBearings::Station*> looking_at(const RayMeeting& start,
                                                               std::int64_t now_us) const;
  std::int64_t now_at(std::int64_t utime_us) const;
  std::optional<Hypothesis> run(const RayMeeting& start, std::int64_t now_us,
                                const BiasModel& errors) const;
  std::optional<Hypothesis> try_start(const BearingMeasurement& newest, const RayMeeting& start,
                                      const BiasModel& errors, Needed needed);
  bool has_better_hypothesis(const Hypothesis& begun, const BearingMeasurement& newest,
                             const BiasModel& errors);
  void take(const Track& track);

  InitiationConfig config_;
  FilterConfig filter_;
  RayMeetings meetings_;
  UnassociatedBearings pool_;
  Solution failure_ = Solution::kTooFewRays;
  // Stations that wait for a search, and the effort saved for the next search.
  std::deque<std::string> waiting_;
  std::size_t saved_ = 0;
  std::minstd_rand any_;  // gives the same sequence in every run
};

}  // namespace ols::fusion
