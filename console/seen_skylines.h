// Where the stations' pictures disagree with the land's skyline. Pure.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "console/entity_table.h"

namespace ols::console {

// A sector of a station's skyline.
struct ReceivedSkyline {
  std::string station;
  std::int64_t begun_us = 0;  // when this skyline began: another one replaces it
  int sector = 0;
  // Columns, and elevations [rad] in the pictures, that differ from the land's by more than their
  // errors.
  std::vector<std::pair<int, double>> differing{};
};

class SeenSkylines {
 public:
  void receive(const ReceivedSkyline& heard);
  // {differing: [[azimuth_deg, elevation_deg]]} clockwise from north; empty if nothing is known.
  Json of(const std::string& station) const;

 private:
  struct Known {
    std::int64_t begun_us = 0;
    std::map<int, std::vector<std::pair<int, double>>> sectors;
  };
  std::map<std::string, Known> known_;  // by station
};

}  // namespace ols::console
