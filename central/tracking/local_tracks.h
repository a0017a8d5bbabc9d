// What each station follows by its own names (a bearing's track_id other than 0), and which
// objects those are. Of one station the last few: one that names everything anew takes no more
// memory than any other. Pure.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "central/measurement/bearing_measurement.h"

namespace ols::fusion {

class LocalTracks {
 public:
  struct Object {
    std::int64_t id = 0;         // the target's or the line's; 0: none yet
    std::int64_t since_us = 0;   // without one
    std::int64_t given_us = 0;   // the last bearing that its track took
    std::int64_t newest_us = 0;  // the last one at all
  };
  static constexpr std::size_t kOfAStation = 16;

  // By a bearing's station and name; null: nothing is known of it.
  const Object* find(const BearingMeasurement& sighting) const;
  // New where nothing is known; it takes the place of the one that was not heard of for longest.
  Object& at(const BearingMeasurement& sighting);
  // Two identities are one object.
  void rename(std::int64_t from, std::int64_t to);
  void forget(const std::string& station) { stations_.erase(station); }
  std::size_t size(const std::string& station) const;

 private:
  std::map<std::string, std::map<std::int64_t, Object>> stations_;
};

}  // namespace ols::fusion
