// What a calibrated station sees all around: the pictures of its sweep, with the directions that
// its calibration gives them.
#pragma once

#include <string>
#include <vector>

#include "geometry/wgs84.h"
#include "land/scenery/picture_panorama.h"
#include "land/scenery/scene_panorama.h"

namespace ols::calibration {

struct StationViews {
  std::string station;
  std::vector<scenery::ScenePicture> pictures;
  LocalFrame camera;  // at the mean of the camera's centres in the pictures
  double rad_per_px = 0.0;
  scenery::PoseSd sd;  // of the directions and of the camera's centre
};

// Reads the calibration in use. `config`: path of the station's configuration, which must state
// where the station keeps its calibrations. Throws std::runtime_error, ConfigError, CsvError or
// std::invalid_argument; each message names the file.
StationViews read_views(const std::string& config);

}  // namespace ols::calibration
