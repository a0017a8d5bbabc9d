// The land around the site, for browsers: heights of the ground, and the land below a line of
// sight. Use it in one thread only; the thread must be one that may wait for a disk.
#pragma once

#include "console/land_task.h"
#include "console/web_api.h"
#include "land/terrain_folder.h"

namespace ols::console {

class SiteLand {
 public:
  // `folder` without terrain: there is no land model.
  explicit SiteLand(land::TerrainFolder folder) : folder_(std::move(folder)) {}

  // The answer to a browser; docs/console.md lists its fields.
  WebResponse answer(const LandTask& task);

  static constexpr int kHeightsAcross = 49;

 private:
  Json about() const;
  Json ground(const LandTask& task) const;
  Json heights(const LandTask& task) const;
  Json profile(const LandTask& task) const;

  land::TerrainFolder folder_;
};

}  // namespace ols::console
