// Where a new track may begin: bearings that belong to no track yet, and the places where rays of
// different stations meet. Pure.
//
// Rays of different objects meet too (ghosts). A start therefore has to explain its stations'
// bearings over the last moments, not only the two that it was made of: the filter is run over
// them. Three stations that agree are believed at once; two have to agree for longer, by when the
// true objects have taken their own bearings. The two stations that make a start are heard first:
// then a third one that is wrong, or follows something else, is outside of the gate and spoils
// none.
//
// A search costs as much as there are stations with such bearings. Where they are many they take
// turns, so that what a bearing costs does not grow with their number.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "central/tracking/ray_meetings.h"
#include "central/tracking/track.h"

namespace ols::fusion {

struct InitiationConfig {
  double pool_s = 0.6;  // bearings without a track are kept for so long
  MeetingConfig meeting{};
  double explained = 0.6;        // least share of the stations' frames that a start must explain
  double two_stations_s = 0.35;  // of agreement, where only two stations agree
  int least_bearings = 6;
  int pool_of_a_station = 64;  // most bearings that are kept of one
};

// A new track, and what its bearings show of the stations on top of what was known.
struct TrackStart {
  Track track;
  BiasModel shown;
};

class TrackInitiation {
 public:
  TrackInitiation(const InitiationConfig& config, const FilterConfig& filter)
      : config_(config),
        filter_(filter),
        meetings_(config.meeting, filter.max_range_m),
        pool_(config.pool_s, config.pool_of_a_station) {}

  // Takes a bearing that belongs to no track. A new track, with the bearings that it explains taken
  // out of the pool: of this one or, where many stations wait for their turn, of another.
  // `accept_two_rays`: two rays are enough for now; the pool keeps them, for a better one.
  std::optional<TrackStart> add(const BearingMeasurement& sighting, const BiasModel& errors,
                                bool accept_two_rays);
  // Keeps a bearing without looking for a track.
  void store(const BearingMeasurement& sighting) { pool_.store(sighting); }
  // Takes out what a track explains that has just become sure.
  void give(const Track& track, const BiasModel& errors);
  void forget(const std::string& station) { pool_.forget(station); }
  void clear() { *this = TrackInitiation(config_, filter_); }
  const UnassociatedBearings& pool() const { return pool_; }
  // Why the last bearing began no track: what its ray did with the last other one, kRaysMiss where
  // rays meet but the bearings of their stations do not agree on it, kTooFewRays where they do and
  // only more of them is needed, and where there was no other ray.
  Solution why_no_track() const { return failure_; }
  // Why there is no track: by the stations whose bearings at this instant belong to none, and the
  // last failure where they are several.
  Solution why_none(std::int64_t now_us) const;

 private:
  // A start that was good enough, and what the run over its bearings has shown of the stations.
  struct Hypothesis {
    TrackStart start;
    int bearings = 0;      // that it explains, of the stations that agree on it
    double span_s = 0.0;   // of them
    bool settled = false;  // its equations are linear about where it is
    double misfit = 0.0;   // mean squared normalised residual of their frames; NaN without any
  };
  enum class Needed { kTwoRays, kHalf, kAll };  // for two stations' agreement: of its time
  std::optional<TrackStart> search(const BearingMeasurement& sighting, const BiasModel& errors,
                                   bool accept_two_rays);
  std::optional<BearingMeasurement> next_station_to_search(const BearingMeasurement& sighting);
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
  // Stations that wait for a search, and what has been saved up for the next one.
  std::deque<std::string> waiting_;
  std::size_t saved_ = 0;
  std::minstd_rand any_;  // the same in every run
};

}  // namespace ols::fusion
