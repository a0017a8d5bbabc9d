// A track manager for tests of the life cycle that all track managers share. The test begins the
// tracks and sets the criteria.
#pragma once

#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "central/tracking/track_manager.h"
#include "tests/unit/central/flight.h"

namespace ols::fusion::test {

class GivenTracks : public TrackManager {
 public:
  explicit GivenTracks(const TrackManagerConfig& config = {})
      : TrackManager(config, config.filter, true) {}

  using TrackManager::add;
  // Gives every bearing to the first track. Initiates no track.
  std::vector<Association> add(std::span<const BearingMeasurement> image, bool) override {
    std::vector<Association> all(image.size());
    for (std::size_t i = 0; i < image.size() && !tracks_.empty(); ++i)
      all[i] = give_to(tracks_.front(), image[i]);
    return all;
  }
  // Begins a tentative track of an object at rest at this point.
  Track& begin_at(const Eigen::Vector3d& p_enu, std::int64_t utime_us = kStart) {
    Track track(TrackFilter(
        {}, utime_us,
        {.p_ecef = site().to_ecef(p_enu), .position_sd_m = 30.0, .velocity_sd_m_s = 1.0}));
    track.last_two_station_us = track.initiated_us = utime_us;
    return begin(std::move(track));
  }
  Association give(std::size_t track, const BearingMeasurement& measurement) {
    return give_to(tracks_.at(track), measurement);
  }
  // A bearing that no track explains.
  void keep_unassociated(const BearingMeasurement& measurement) { initiation_.store(measurement); }
  // Replaces a track, and with it the filter.
  void exchange(std::size_t track, Track by) { replace(tracks_.at(track), std::move(by)); }
  using TrackManager::clear_tracks;

  bool worth_confirming = true, tentative_lost = false, lost = false;

 private:
  bool is_worth_confirming(const Track&) const override { return worth_confirming; }
  bool is_tentative_lost(double) const override { return tentative_lost; }
  bool is_lost(const Track&, double, std::int64_t) const override { return lost; }
};

// A bearing from the k-th station of the square to an object at this point.
inline BearingMeasurement sight_of(std::size_t k, const Eigen::Vector3d& p_enu,
                                   std::int64_t utime_us) {
  return measurement_of(
      ray_to(std::string(1, static_cast<char>('a' + k)), square()[k], p_enu, 1e-4), utime_us);
}

// Begins a track at this point and confirms it with ten frames of the four stations. Returns the
// time of the last frame.
inline std::int64_t confirm_at(GivenTracks& tracks, const Eigen::Vector3d& p_enu,
                               std::int64_t start_us = kStart) {
  tracks.begin_at(p_enu, start_us);
  const std::size_t track = tracks.tracks().size() - 1;
  std::int64_t utime_us = start_us;
  for (int i = 0; i < 10; ++i, utime_us += 20'000) {
    for (std::size_t k = 0; k < 4; ++k) tracks.give(track, sight_of(k, p_enu, utime_us));
  }
  return utime_us - 20'000;
}

}  // namespace ols::fusion::test
