#include "base/files/csv_files.h"

#include <algorithm>
#include <set>

#include "base/files/csv_rows.h"

namespace ols {
namespace {

using csv::for_each_row;
using csv::Header;
using csv::Row;

constexpr std::int64_t kGreatestUtime = 9'000'000'000'000'000;  // differences do not overflow

constexpr Header<6> kStations{
    {"station", "latitude_deg", "longitude_deg", "height_m", "position_sd_m", "pointing_sd_deg"},
    4};
constexpr Header<7> kBearings{
    {"utime_us", "station", "azimuth_deg", "elevation_deg", "sigma_deg", "belief", "target"}, 5};

constexpr Header<6> kLandmarks{
    {"object", "distance_m", "alpha_rad", "side", "estimated_m", "measured_m"}, 3};

constexpr Header<8> kSurvey{{"landmark", "height_m", "sd_m", "latitude_deg", "longitude_deg",
                             "zone", "easting_m", "northing_m"},
                            3};
constexpr Header<5> kSighted{{"landmark", "pan_deg", "tilt_deg", "x_px", "y_px"}, 3};
constexpr Header<4> kFlight{{"utime_us", "lat", "lon", "h"}, 4};

StationRow station_row(const Row<6>& row) {
  StationRow station;
  station.station = row.id(0);
  station.latitude_deg = row.number<double>(1, -90.0, 90.0);
  station.longitude_deg = row.number<double>(2, -180.0, 360.0);
  station.height_m = row.number<double>(3, -10e3, 100e3);
  station.position_sd_m = row.optional_number(4, 0.0, 1e6);
  station.pointing_sd_deg = row.optional_number(5, 0.0, 180.0);
  return station;
}

SurveyRow survey_row(const Row<8>& row) {
  SurveyRow point;
  point.landmark = row.id(0);
  point.height_m = row.number<double>(1, -1e3, 100e3);
  point.sd_m = row.number<double>(2, 0.0, 1e4);
  point.line = row.line();
  point.place = csv::place_of(row, 3, 5);
  return point;
}

SightedRow sighted_row(const Row<5>& row) {
  SightedRow sighted;
  sighted.landmark = row.id(0);
  sighted.pan_deg = row.number<double>(1, -360.0, 360.0);
  sighted.tilt_deg = row.number<double>(2, -180.0, 180.0);
  sighted.x_px = row.optional_number(3, -1e5, 1e5);
  sighted.y_px = row.optional_number(4, -1e5, 1e5);
  if (sighted.x_px.has_value() != sighted.y_px.has_value()) {
    row.fail(sighted.x_px ? 4 : 3, "is empty");
  }
  sighted.line = row.line();
  return sighted;
}

// Seconds or milliseconds would be read as microseconds of the 1970s, before there was a GPS to
// measure them.
std::int64_t utime_of(const Row<7>& row) {
  constexpr std::int64_t kGreatest = 9'000'000'000'000'000;  // differences do not overflow
  constexpr std::int64_t kLeast = 315'964'800'000'000;       // 1980-01-06
  const auto utime_us = row.number<std::int64_t>(0, 0, kGreatest);
  if (utime_us >= kLeast) return utime_us;
  const char* unit = utime_us >= kLeast / 1'000       ? "; these seem to be milliseconds"
                     : utime_us >= kLeast / 1'000'000 ? "; these seem to be seconds"
                                                      : "";
  row.fail(0, std::to_string(utime_us) +
                  " is before 1980: microseconds since 1970 (UTC) are needed" + unit);
}

BearingRow bearing_row(const Row<7>& row) {
  constexpr double kLeastSigmaDeg = 1e-7;
  BearingRow bearing;
  bearing.utime_us = utime_of(row);
  bearing.station = row.id(1);
  bearing.azimuth_deg = row.number<double>(2, -360.0, 360.0);
  bearing.elevation_deg = row.number<double>(3, -90.0, 90.0);
  bearing.sigma_deg = row.number<double>(4, kLeastSigmaDeg, 90.0);
  bearing.belief = row.optional_number(5, 0.0, 1.0).value_or(1.0);
  if (row.has_column(6)) bearing.target = row.has(6) ? row.id(6) : "1";
  return bearing;
}

}  // namespace

std::vector<StationRow> read_stations(const std::string& path) {
  std::vector<StationRow> stations;
  std::set<std::string> ids;
  for_each_row(path, kStations, [&](const Row<6>& row) {
    stations.push_back(station_row(row));
    if (!ids.insert(stations.back().station).second) {
      row.fail(0, "'" + stations.back().station + "' appears twice");
    }
  });
  if (stations.empty()) throw CsvError(path + ":2: row: the file has a header but no rows");
  return stations;
}

void for_each_bearing(const std::string& path, const std::vector<StationRow>& stations,
                      const std::function<void(const BearingRow&)>& take) {
  std::set<std::string> ids;
  for (const StationRow& station : stations) ids.insert(station.station);
  bool any = false;
  for_each_row(path, kBearings, [&](const Row<7>& row) {
    const BearingRow bearing = bearing_row(row);
    if (!ids.contains(bearing.station)) {
      row.fail(1, "'" + bearing.station + "' is not one of the stations");
    }
    any = true;
    take(bearing);
  });
  if (!any) throw CsvError(path + ":2: row: the file has a header but no rows");
}

std::vector<BearingRow> read_bearings(const std::string& path,
                                      const std::vector<StationRow>& stations) {
  std::vector<BearingRow> bearings;
  for_each_bearing(path, stations, [&](const BearingRow& row) { bearings.push_back(row); });
  return bearings;
}

std::vector<LandmarkRow> read_landmarks(const std::string& path) {
  constexpr double kRightAngle_rad = 1.57;
  std::vector<LandmarkRow> landmarks;
  for_each_row(path, kLandmarks, [&](const Row<6>& row) {
    LandmarkRow landmark;
    landmark.object = row.id(0);
    landmark.distance_m = row.number<double>(1, 1e-3, 1e7);
    landmark.alpha_rad = row.number<double>(2, 0.0, kRightAngle_rad);
    if (row.has(3)) landmark.side = row.number<int>(3, -1, 1);
    landmark.estimated_m = row.optional_number(4, 0.0, 1e7);
    landmark.measured_m = row.optional_number(5, 0.0, 1e7);
    landmarks.push_back(landmark);
  });
  if (landmarks.empty()) throw CsvError(path + ":2: row: the file has a header but no rows");
  return landmarks;
}

std::vector<SurveyRow> read_survey(const std::string& path) {
  std::vector<SurveyRow> points;
  std::set<std::string> names;
  for_each_row(path, kSurvey, [&](const Row<8>& row) {
    points.push_back(survey_row(row));
    if (!names.insert(points.back().landmark).second) {
      row.fail(0, "'" + points.back().landmark + "' appears twice");
    }
  });
  if (points.empty()) throw CsvError(path + ":2: row: the file has a header but no rows");
  return points;
}

std::vector<SightedRow> read_sighted(const std::string& path,
                                     const std::vector<SurveyRow>& survey) {
  std::vector<SightedRow> sightings;
  for_each_row(path, kSighted, [&](const Row<5>& row) {
    sightings.push_back(sighted_row(row));
    const std::string& name = sightings.back().landmark;
    if (std::ranges::find(survey, name, &SurveyRow::landmark) == survey.end()) {
      row.fail(0, "'" + name + "' is not one of the landmarks");
    }
  });
  if (sightings.empty()) throw CsvError(path + ":2: row: the file has a header but no rows");
  return sightings;
}

std::vector<FlightRow> read_flight(const std::string& path) {
  std::vector<FlightRow> flight;
  for_each_row(path, kFlight, [&](const Row<4>& row) {
    const FlightRow next{row.number<std::int64_t>(0, 0, kGreatestUtime),
                         row.number<double>(1, -90.0, 90.0), row.number<double>(2, -360.0, 360.0),
                         row.number<double>(3, -10e3, 100e3)};
    if (!flight.empty() && next.utime_us <= flight.back().utime_us) {
      row.fail(0, "is not later than in the row before");
    }
    flight.push_back(next);
  });
  if (flight.size() < 2) throw CsvError(path + ": at least two rows are needed");
  return flight;
}

}  // namespace ols
