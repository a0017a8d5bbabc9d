// Writes ASTERIX data blocks of four categories, with items as in EUROCONTROL's specifications:
// CAT062 (edition 1.20) for targets, CAT063 (1.6) for stations' statuses, CAT065 (1.5) for the
// status of this service, CAT015 (1.2) for lines of sight. Pure.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "export/records.h"

namespace ols::exports {

struct AsterixSettings {
  int sac = 0;  // system area code, from EUROCONTROL's list
  int sic = 1;  // this system's identification code
  // The stations get the identification codes sic + 1, sic + 2, ... in this order. Stations that
  // are not listed are not sent.
  std::vector<std::string> stations;
};

// The height is above the ellipsoid (item I062/130); accuracies are in item I062/500; the source of
// the position is "triangulation". `number`: the track number.
std::string cat062(const Target& target, std::uint16_t number, const AsterixSettings& settings);
// `sensor`: the station's identification code (sic).
std::string cat063(const Station& station, int sensor, const AsterixSettings& settings);
std::string cat065(std::int64_t utime_us, const AsterixSettings& settings);
std::string cat015(const Line& line, int sensor, const AsterixSettings& settings);

}  // namespace ols::exports
