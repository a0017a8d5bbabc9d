#include "base/csv_files.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <memory>
#include <set>
#include <sstream>
#include <string_view>
#include <tuple>

#include "base/fix_writer.h"

// Rows are few enough for one thread.
#define CSV_IO_NO_THREAD
#include <libfccp/csv.h>

namespace ols {
namespace {

// The column names of a file: required ones first.
template <std::size_t kColumns>
struct Header {
  std::array<const char*, kColumns> names;
  std::size_t required;
};

// One row: its place, for errors, and its cells by column; null where the file has no such column.
template <std::size_t kColumns>
class Row {
 public:
  Row(const std::string& path, unsigned line, const Header<kColumns>& header,
      const std::array<const char*, kColumns>& cells)
      : path_(path), line_(line), header_(header), cells_(cells) {}

  [[noreturn]] void fail(std::size_t column, const std::string& what) const {
    throw CsvError(path_ + ":" + std::to_string(line_) + ": " + header_.names[column] + ": " +
                   what);
  }
  unsigned line() const { return line_; }
  bool has_column(std::size_t column) const { return cells_[column] != nullptr; }
  bool has(std::size_t column) const {
    return cells_[column] != nullptr && *cells_[column] != '\0';
  }
  std::string text(std::size_t column) const {
    if (!has(column)) fail(column, "is empty");
    return cells_[column];
  }
  // Ids are written to other files as they are.
  std::string id(std::size_t column) const {
    const std::string cell = text(column);
    const bool plain = std::ranges::none_of(
        cell, [](unsigned char c) { return c == ',' || c == '"' || c < 0x20 || c == 0x7f; });
    if (!plain) fail(column, "has a comma, a quote or a control character");
    return cell;
  }
  template <class Number>
  Number number(std::size_t column, Number least, Number greatest) const {
    const std::string cell = text(column);
    const char* end = cell.data() + cell.size();
    Number value{};
    const auto [rest, error] = std::from_chars(cell.data(), end, value);
    if (error != std::errc() || rest != end) fail(column, "'" + cell + "' is not a number");
    if (!(value >= least && value <= greatest)) {
      std::ostringstream range;
      range << cell << " is outside " << least << " .. " << greatest;
      fail(column, range.str());
    }
    return value;
  }
  std::optional<double> optional_number(std::size_t column, double least, double greatest) const {
    if (!has(column)) return std::nullopt;
    return number<double>(column, least, greatest);
  }

 private:
  const std::string& path_;
  unsigned line_;
  const Header<kColumns>& header_;
  const std::array<const char*, kColumns>& cells_;
};

template <std::size_t kColumns>
using Reader = io::CSVReader<kColumns, io::trim_chars<' ', '\t'>, io::double_quote_escape<',', '"'>,
                             io::throw_on_overflow, io::empty_line_comment>;

// The column separator that a spreadsheet has used instead of a comma.
std::string other_separator(const std::string& path) {
  std::string header;
  std::getline(std::ifstream(path, std::ios::binary), header);
  if (header.find(',') != std::string::npos) return "";
  if (header.find(';') != std::string::npos) return "semicolons";
  return header.find('\t') != std::string::npos ? "tabs" : "";
}

template <std::size_t kColumns>
void read_header(Reader<kColumns>& reader, const std::string& path,
                 const Header<kColumns>& header) {
  std::apply(
      [&](auto... names) {
        reader.read_header(io::ignore_extra_column | io::ignore_missing_column, names...);
      },
      header.names);
  for (std::size_t i = 0; i < header.required; ++i) {
    if (reader.has_column(header.names[i])) continue;
    const std::string separator = other_separator(path);
    if (!separator.empty()) {
      throw CsvError(path + ":1: header: columns are separated by " + separator +
                     ", commas are needed");
    }
    throw CsvError(path + ":1: " + header.names[i] + ": the column is missing");
  }
}

// A file, its last line ended: the library reads past the end of one that is not.
class EndedLines : public io::ByteSourceBase {
 public:
  explicit EndedLines(const std::string& path) : path_(path), file_(path, std::ios::binary) {
    file_.peek();  // opening a folder succeeds; reading fails here
    if (!file_.is_open() || file_.bad()) throw CsvError(path + ": cannot be read");
    file_.clear();
  }
  int read(char* buffer, int size) override {
    file_.read(buffer, size);
    if (file_.bad()) throw CsvError(path_ + ": cannot be read");
    auto count = static_cast<int>(file_.gcount());
    if (count > 0) {
      last_ = buffer[count - 1];
    } else if (last_ != '\n' && size > 0) {
      buffer[count++] = last_ = '\n';
    }
    return count;
  }

 private:
  std::string path_;
  std::ifstream file_;
  char last_ = '\n';
};

// Passes each row to `take`; translates the library's errors.
template <std::size_t kColumns, class Take>
void for_each_row(const std::string& path, const Header<kColumns>& header, Take take) {
  try {
    Reader<kColumns> reader(path, std::make_unique<EndedLines>(path));
    read_header<kColumns>(reader, path, header);
    std::array<const char*, kColumns> cells{};
    const auto next = [&](auto&... cell) { return reader.read_row(cell...); };
    while (std::apply(next, cells)) {
      take(Row<kColumns>(path, reader.get_file_line(), header, cells));
    }
  } catch (const io::error::header_missing&) {
    throw CsvError(path + ":1: header: is missing");
  } catch (const io::error::with_file_line& error) {
    throw CsvError(path + ":" + std::to_string(error.file_line) +
                   ": row: too few or too many columns, or a quote that stays open");
  } catch (const io::error::base& error) {
    throw CsvError(path + ":1: header: " + error.what());
  }
}

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

// "33N": the zone and its hemisphere, not a band of latitude.
UtmCells utm_of(const Row<8>& row) {
  UtmCells utm;
  const std::string zone = row.text(5);
  const auto [rest, error] = std::from_chars(zone.data(), zone.data() + zone.size(), utm.zone);
  const std::string hemisphere(rest, zone.data() + zone.size());
  if (error != std::errc() || utm.zone < 1 || utm.zone > 60 ||
      (hemisphere != "N" && hemisphere != "S")) {
    row.fail(5, "'" + zone + "' is not a zone 1 .. 60 and its hemisphere N or S, as 33N");
  }
  utm.northern = hemisphere == "N";
  utm.easting_m = row.number<double>(6, 0.0, 1e6);
  utm.northing_m = row.number<double>(7, 0.0, 1e7);
  return utm;
}

SurveyRow survey_row(const Row<8>& row) {
  SurveyRow point;
  point.landmark = row.id(0);
  point.height_m = row.number<double>(1, -1e3, 100e3);
  point.sd_m = row.number<double>(2, 0.0, 1e4);
  point.line = row.line();
  const bool utm = row.has(5) || row.has(6) || row.has(7);
  if (utm && (row.has(3) || row.has(4)))
    row.fail(5, "must be empty: latitude and longitude are given");
  if (utm) {
    point.place = utm_of(row);
  } else {
    point.place =
        GeodeticCells{row.number<double>(3, -90.0, 90.0), row.number<double>(4, -180.0, 360.0)};
  }
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

// Seconds or milliseconds of any year to come would be microseconds of the 1970s, before there
// was a GPS to measure them.
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

void write_fixes(const std::string& path, const std::vector<FixRow>& fixes) {
  FixWriter writer(path);
  for (const FixRow& fix : fixes) writer.add(fix);
  writer.commit();
}

}  // namespace ols
