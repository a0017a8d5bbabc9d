// Options shared by the subcommands of ols-precision: the stations' errors and the target.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "base/files/csv_files.h"
#include "geometry/precision.h"

namespace ols::offline {

// The errors of the stations' measurements where stations.csv does not state them.
struct MeasurementOptions {
  double pixel_sd_px = 0.5;
  double pixel_um = 3.75;
  double focal_length_mm = 50.0;
  double heading_sd_deg = 0.02;
  double tilt_sd_deg = 0.01;
  double mounting_sd_deg = 0.01;
  double position_sd_m = 0.02;
  double clock_sd_ms = 0.5;
  double speed_m_s = 0.0;
  double exposures = 1.0;
};

void add_measurement_options(CLI::App& app, MeasurementOptions& options);

// A station with these options. The row's position_sd_m replaces the option for the position; its
// pointing_sd_deg replaces the options for heading, tilt and mounting together.
PlannedStation planned_station(const StationRow& row, const MeasurementOptions& options);
std::vector<PlannedStation> planned_stations(const std::vector<StationRow>& rows,
                                             const MeasurementOptions& options);
PlannedStation planned_station(const Geodetic& place, const MeasurementOptions& options);

// A target that flies at the options' speed in an unknown direction.
PlannedTarget planned_target(const Geodetic& place, const MeasurementOptions& options);

}  // namespace ols::offline
