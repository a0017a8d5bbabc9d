// The local tracks of each station (a bearing's track_id other than 0), and the object to which
// each belongs. Keeps only the last 16 local tracks of each station: otherwise, a station that
// keeps changing its ids would fill the memory. Pure.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "central/measurement/bearing_measurement.h"

namespace ols::fusion {

class LocalTracks {
 public:
  struct Object {
    std::int64_t id = 0;         // id of the target or the bearing-only track; 0 if it has none yet
    std::int64_t since_us = 0;   // when it lost its identity, or appeared without one
    std::int64_t given_us = 0;   // time of its last bearing that a target took
    std::int64_t newest_us = 0;  // time of its last bearing
  };
  static constexpr std::size_t kOfAStation = 16;

  // The object to which the bearing's local track (station and track id) belongs; null if unknown.
  const Object* find(const BearingMeasurement& measurement) const;
  // As find(), but adds an entry if there is none. If the station already has kOfAStation entries,
  // the new entry replaces the one whose last bearing is oldest.
  Object& at(const BearingMeasurement& measurement);
  // Replaces the identity `from` by `to`: both were of one object.
  void rename(std::int64_t from, std::int64_t to);
  void forget(const std::string& station) { stations_.erase(station); }
  std::size_t size(const std::string& station) const;

 private:
  std::map<std::string, std::map<std::int64_t, Object>> stations_;
};

}  // namespace ols::fusion
