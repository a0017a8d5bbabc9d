// ols-calibrate scenery: measures where the scenery stands, from what two stations see all around.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "base/process/progress.h"
#include "land/surface.h"
#include "tools/calibrate/command_report.h"
#include "tools/calibrate/station_views.h"
#include "tools/land/scenery_file.h"

namespace ols::calibration {

struct SceneryOptions {
  std::vector<std::string> stations;
  std::string land, output;
};

CLI::App* add_scenery(CLI::App& app, SceneryOptions& options);

// Measures with each pair of stations, and writes the file. Throws for bad input.
CommandReport write_scenery(const SceneryOptions& options, const TellSteps& tell);

// What two stations have measured.
struct MeasuredScenery {
  std::vector<land::SceneryRow> rows;
  // Points that are left out: whose range is too uncertain; that may be the ground.
  std::size_t uncertain = 0, ground = 0;
};

// What stands between 0.6 and 12 times the distance of both stations: nearer things look too
// different, and farther ranges are too uncertain. A point counts if its place is known better than
// half the width of its pillar in the land (kSceneryWide_rad), and if it stands higher than the
// ground by more than three sigmas of both heights. `tell`: see Progress; steps are sectors.
MeasuredScenery scenery_of(const StationViews& one, const StationViews& two,
                           const land::Surface& surface, const TellSteps& tell);

}  // namespace ols::calibration
