// The paper's three rectification targets (section 4.2) as blocks of an adjustment.
//
// level line   roll of the image against the horizon: a level line, perpendicular to the line of
// sight to some degrees cross        direction of the camera against the plane perpendicular to the
// tilt axis ruler pair   elevation of the camera: two rulers at two distances, with their zeros at
// the same height
//
// Each sighting is one equation, scaled by its deviation.
#pragma once

#include <string>
#include <vector>

#include "calibration/block.h"

namespace ols::calibration {

struct TargetSighting {
  Sighting sighting;
  TargetFacts facts;
  std::string name;  // of the target
};

// The lines of one board. The nuisance: the board's error of level, and its deviation from
// perpendicular to the line of sight. Lines above and below the camera's height determine that
// deviation.
BlockPtr level_line_block(const PixelBlockConfig& config, std::vector<TargetSighting> sightings);
// The nuisance: the cross's offset from its place.
BlockPtr cross_block(const PixelBlockConfig& config, std::vector<TargetSighting> sightings);
// The nuisance: the height of the zeros above GROUND, and each ruler's own error.
BlockPtr ruler_block(const PixelBlockConfig& config, std::vector<TargetSighting> sightings);

// The model of the camera alone on its head: X (the line of sight) east, the tilt axis north. Its
// directions depend only on the camera and its mounting.
StationModel head_alone(const StationModel& model);

}  // namespace ols::calibration
