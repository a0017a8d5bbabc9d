// Divides the seen skyline into parts that fit into a message. Pure.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "edge/skyline/skyline_watch.h"
#include "land/seen_skyline.h"

namespace ols::skyline {

struct SkylinePart {
  std::int64_t begun_us = 0;  // HidingSkyline::begun_us; 0 if nothing has been seen
  Eigen::Vector3d camera_ecef = Eigen::Vector3d::Zero();
  bool heading_disagrees = false;
  int sector = 0;
  std::vector<land::SeenSkyline::Column> columns;  // all columns of this sector that have been seen
};

// Each call returns the next sector in which anything has been seen. After the last sector, the
// calls begin again with the first.
class SkylineParts {
 public:
  SkylinePart next(const HidingSkyline& skyline, bool heading_disagrees);

 private:
  int sector_ = 0;
};

}  // namespace ols::skyline
