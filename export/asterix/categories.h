// The records of the categories in use, with items as in EUROCONTROL's specifications: CAT062
// (edition 1.20) system tracks, CAT063 (1.6) sensor status, CAT065 (1.5) service status, CAT015
// (1.2) bearings. Pure.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "export/records.h"

namespace ols::exports {

struct AsterixSettings {
  int sac = 0;  // system area code, from EUROCONTROL's list
  int sic = 1;  // this system's identification code
  // The stations' identification codes follow ours, in this order. Stations not listed are not
  // sent.
  std::vector<std::string> stations;
};

// Heights above the ellipsoid (I062/130); accuracies as I062/500, source "triangulation".
std::string cat062(const Target& target, std::uint16_t number, const AsterixSettings& settings);
// `sensor`: the station's identification code.
std::string cat063(const Station& station, int sensor, const AsterixSettings& settings);
std::string cat065(std::int64_t utime_us, const AsterixSettings& settings);
std::string cat015(const Line& line, int sensor, const AsterixSettings& settings);

}  // namespace ols::exports
