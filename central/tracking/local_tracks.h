// The local tracks of each station (a bearing's track_id other than 0), and the object to which
// each belongs. Keeps only the last few tracks of each station, so that a station that keeps
// changing its ids cannot fill the memory. Pure.
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
    std::int64_t given_us = 0;   // time of the last bearing that its track took
    std::int64_t newest_us = 0;  // time of its last bearing
  };
  static constexpr std::size_t kOfAStation = 16;

  // The object of a bearing's station and track id; null if unknown.
  const Object* find(const BearingMeasurement& measurement) const;
  // As find(), but adds an entry if there is none. If the station has too many, the new entry
  // replaces the one whose last bearing is oldest.
  Object& at(const BearingMeasurement& measurement);
  // Notes that two identities belong to one object.
  void rename(std::int64_t from, std::int64_t to);
  void forget(const std::string& station) { stations_.erase(station); }
  std::size_t size(const std::string& station) const;

 private:
  std::map<std::string, std::map<std::int64_t, Object>> stations_;
};

}  // namespace ols::fusion
