// Where the stations' pictures disagree with the skyline of the land model. Pure.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "console/entity_table.h"

namespace ols::console {

// A sector of a station's seen skyline.
struct ReceivedSkyline {
  std::string station;
  std::int64_t begun_us = 0;  // when the station began this skyline; a sector with another value
                              // begins a new one
  int sector = 0;
  // Columns in which the pictures differ from the land model by more than their errors, each with
  // the elevation [rad] in the pictures.
  std::vector<std::pair<int, double>> differing{};
};

class SeenSkylines {
 public:
  void receive(const ReceivedSkyline& heard);
  // {differing: [[azimuth_deg, elevation_deg]]}, azimuths clockwise from north; the list is empty
  // if nothing is known.
  Json of(const std::string& station) const;

 private:
  struct Known {
    std::int64_t begun_us = 0;
    std::map<int, std::vector<std::pair<int, double>>> sectors;
  };
  std::map<std::string, Known> known_;  // by station
};

}  // namespace ols::console
