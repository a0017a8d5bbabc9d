// The paper's three rectification targets (section 4.2) as blocks of an adjustment.
//
//   level line   how the image is rolled against the horizon: a line that is level, square to the
//                line of sight to some degrees
//   cross        the direction of the camera against the plane that is square to the tilt axis
//   ruler pair   its elevation: the marks of two rulers, one behind the other, with level zeros
//
// Each sighting is one equation, scaled to its deviation.
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

// The lines of one board: its error of level and how far it is from square to the line of sight
// are the nuisance. Lines above and below the camera's height tell the latter.
BlockPtr level_line_block(const PixelBlockConfig& config, std::vector<TargetSighting> sightings);
// The nuisance: the cross is beside its place.
BlockPtr cross_block(const PixelBlockConfig& config, std::vector<TargetSighting> sightings);
// The nuisance: the height of the zeros over GROUND, and each ruler's own error.
BlockPtr ruler_block(const PixelBlockConfig& config, std::vector<TargetSighting> sightings);

// The model of the camera on its head alone: X (the line of sight) east, the tilt axis north. Its
// directions depend on the camera and its mounting only.
StationModel head_alone(const StationModel& model);

}  // namespace ols::calibration
