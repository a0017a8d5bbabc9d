// The land around the site for browsers: skylines of the stations, heights of the ground, the land
// below a line of sight. Use it in one thread, which may compute for a second.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "console/land_task.h"
#include "console/web_api.h"
#include "land/terrain_folder.h"

namespace ols::console {

class SiteLand {
 public:
  // Without terrain: no land is known.
  explicit SiteLand(land::TerrainFolder folder) : folder_(std::move(folder)) {}

  // The answer to a browser; docs/console.md lists its fields.
  WebResponse answer(const LandTask& task);

  static constexpr int kHeightsAcross = 49;
  static constexpr double kMoved_m = 1.0;  // a camera that has moved further has another skyline

 private:
  struct Kept {
    Eigen::Vector3d camera_ecef = Eigen::Vector3d::Zero();
    std::string json;
  };
  Json about() const;
  Json ground(const LandTask& task) const;
  Json heights(const LandTask& task) const;
  Json profile(const LandTask& task) const;
  // Of a station's camera; computed once for each place.
  std::string skyline(const LandTask& task);

  land::TerrainFolder folder_;
  std::map<std::string, Kept> skylines_;  // by station
};

}  // namespace ols::console
