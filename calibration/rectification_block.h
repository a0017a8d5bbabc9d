// The paper's three rectification targets (section 4.2) as blocks of an adjustment.
//
//  - Level line: gives the roll of the image against the horizon. The line must be level, and
//    perpendicular to the line of sight to within some degrees.
//  - Cross: gives the direction of the camera relative to the plane perpendicular to the tilt axis.
//  - Ruler pair: gives the elevation of the camera. Two rulers stand at two distances, with their
//    zeros at the same height.
//
// Each sighting gives one equation. The equation is divided by the 1-sigma of the measured
// quantity.
#pragma once

#include <string>
#include <vector>

#include "calibration/block.h"

namespace ols::calibration {

struct TargetSighting {
  Sighting sighting;
  TargetFacts facts;
  std::string name;  // name of the target
};

// The lines of one board. The nuisance: the inclination of the board's lines, and the angle by
// which the board is turned from perpendicular to the line of sight. Lines above and below the
// camera's height determine this angle.
BlockPtr level_line_block(const PixelBlockConfig& config, std::vector<TargetSighting> sightings);
// The nuisance: the offset of the cross from its stated position.
BlockPtr cross_block(const PixelBlockConfig& config, std::vector<TargetSighting> sightings);
// The nuisance: the common height of the zeros above GROUND, and the error of each ruler's zero.
BlockPtr ruler_block(const PixelBlockConfig& config, std::vector<TargetSighting> sightings);

// The model of the camera on the unit's head alone: X (the line of sight) points east, and the tilt
// axis points north. Directions in this model depend only on the camera and its mounting.
StationModel head_alone(const StationModel& model);

}  // namespace ols::calibration
