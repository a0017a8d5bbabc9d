// The CSV files of ols-calibrate: references and predictions. Conventions as in
// base/files/csv_files.h.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/files/csv_files.h"

namespace ols {

// A star's place in ICRS at epoch 2000.0, and its motion.
struct StarCells {
  double ra_deg = 0.0, dec_deg = 0.0;
  double pm_ra_mas_yr = 0.0;  // already multiplied by the cosine of the declination
  double pm_dec_mas_yr = 0.0;
  double parallax_mas = 0.0;
};

// A star (then `place` is not used), a surveyed point, or, with a time, one position of a
// trajectory.
struct ReferenceRow {
  std::string name;
  std::optional<StarCells> star;
  std::variant<GeodeticCells, UtmCells> place;
  double height_m = 0.0;  // above the WGS84 ellipsoid
  double sd_m = 0.0;
  std::optional<std::int64_t> utime_us;
  unsigned line = 0;
};

struct PredictRow {
  std::string station;  // empty if the file has no such column
  double pan_counts = 0.0, tilt_counts = 0.0;
  int approach_pan = 1, approach_tilt = 1;
  double x_px = 0.0, y_px = 0.0;
  std::int64_t utime_us = 0;
  unsigned line = 0;
};

// Reads at least one row. Only rows with a time may repeat a name; their times must ascend.
std::vector<ReferenceRow> read_references(const std::string& path);
// Reads at least one row.
std::vector<PredictRow> read_predictions(const std::string& path);

}  // namespace ols
