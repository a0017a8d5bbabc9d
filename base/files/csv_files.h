// The input files of the offline programs: stations.csv and bearings.csv, the paper's landmarks,
// surveyed landmarks and their sightings, and a flight for the simulator. Angles are in degrees, as
// in the files. The output is written by tools/offline/fix_writer.h.
//
// Columns are found by the header's names, in any order; unknown ones are ignored. Numbers must be
// plain decimal, finite and in range. Ids must be free of commas, quotes and control characters.
// Any bad row is an error.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

namespace ols {

// One line: "FILE:LINE: COLUMN: what is wrong"; the header is line 1.
class CsvError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct StationRow {
  std::string station;
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
  double height_m = 0.0;                  // above the WGS84 ellipsoid
  std::optional<double> position_sd_m;    // 1-sigma of each axis
  std::optional<double> pointing_sd_deg;  // 1-sigma of each axis
};

struct BearingRow {
  std::int64_t utime_us = 0;
  std::string station;
  double azimuth_deg = 0.0;  // clockwise from true north, -360..360 is accepted
  double elevation_deg = 0.0;
  double sigma_deg = 0.0;  // 1-sigma of each axis, white
  double belief = 1.0;     // 1 if the file has no such column
  std::string target;      // empty if the file has no such column; "1" if the cell is empty
};

// A landmark in front of the baseline between two cameras, as in the paper's Table 1.
struct LandmarkRow {
  std::string object;
  double distance_m = 0.0;
  double alpha_rad = 0.0;  // angle between the landmark's direction and the baseline's normal
  int side = 0;            // -1, 0 or 1 (geometry/precision_paper.h); 0 by default
  std::optional<double> estimated_m;
  std::optional<double> measured_m;
};

struct GeodeticCells {
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
};
struct UtmCells {
  int zone = 0;  // 1..60
  bool northern = true;
  double easting_m = 0.0;
  double northing_m = 0.0;
};

// A surveyed point.
struct SurveyRow {
  std::string landmark;
  std::variant<GeodeticCells, UtmCells> place;
  double height_m = 0.0;  // above the WGS84 ellipsoid
  double sd_m = 0.0;      // 1-sigma of each axis
  unsigned line = 0;      // of the file
};

// A sighting of a landmark in a station's image.
struct SightedRow {
  std::string landmark;
  double pan_deg = 0.0, tilt_deg = 0.0;  // as the PTU reports them
  std::optional<double> x_px, y_px;      // both or neither; neither: the landmark is on the optical
                                         // axis
  unsigned line = 0;                     // of the file
};

// A point of a recorded flight: one row of a trajectory file.
struct FlightRow {
  std::int64_t utime_us = 0;
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
  double height_m = 0.0;  // above the WGS84 ellipsoid
};

// At least one row. Station ids are unique.
std::vector<StationRow> read_stations(const std::string& path);
// Passes each row to `take`, in the order of the file, so that a file of a million rows need not
// fit into memory. There is at least one row, and each row's station is one of `stations`.
void for_each_bearing(const std::string& path, const std::vector<StationRow>& stations,
                      const std::function<void(const BearingRow&)>& take);
std::vector<BearingRow> read_bearings(const std::string& path,
                                      const std::vector<StationRow>& stations);
// At least one row.
std::vector<LandmarkRow> read_landmarks(const std::string& path);
// At least one row. Names are unique.
std::vector<SurveyRow> read_survey(const std::string& path);
// At least one row. Each row's landmark is one of `survey`.
std::vector<SightedRow> read_sighted(const std::string& path, const std::vector<SurveyRow>& survey);
// At least two rows. utime_us ascends.
std::vector<FlightRow> read_flight(const std::string& path);

}  // namespace ols
