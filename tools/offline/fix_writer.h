// Writes fixes.csv row by row: even a million rows need little memory.
#pragma once

#include <cstdint>
#include <string>

#include "base/files/atomic_file.h"

namespace ols {

struct FixRow {
  std::int64_t utime_us = 0;
  std::string target;
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
  double height_m = 0.0;
  double east_sd_m = 0.0;
  double north_sd_m = 0.0;
  double up_sd_m = 0.0;
  int stations_used = 0;
  int stations_set_aside = 0;
  double crossing_angle_deg = 0.0;
  double residual = 0.0;  // RMS of the normalised residuals; NaN is written as an empty cell
};

class FixWriter {
 public:
  // An old file stays unchanged until commit(), and also after an error (std::system_error).
  explicit FixWriter(const std::string& path);
  void add(const FixRow& fix);
  void commit();

 private:
  AtomicFile file_;
};

}  // namespace ols
