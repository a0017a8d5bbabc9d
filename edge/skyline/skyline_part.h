// The seen skyline in parts that fit into a message. Pure.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "edge/skyline/skyline_watch.h"
#include "land/seen_skyline.h"

namespace ols::skyline {

struct SkylinePart {
  std::int64_t begun_us = 0;  // as in HidingSkyline; 0: nothing is seen
  Eigen::Vector3d camera_ecef = Eigen::Vector3d::Zero();
  bool heading_disagrees = false;
  int sector = 0;
  std::vector<land::SeenSkyline::Column> columns;  // all that are seen in this sector
};

// Returns the sectors in which anything has been seen, one after the other.
class SkylineParts {
 public:
  SkylinePart next(const HidingSkyline& skyline, bool heading_disagrees);

 private:
  int sector_ = 0;
};

}  // namespace ols::skyline
