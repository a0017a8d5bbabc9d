#include "tools/calibrate/observation_file.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <stdexcept>

#include "base/text/plain_text.h"
#include "geometry/angles.h"

namespace ols::calibration {
namespace {

using Json = nlohmann::json;

const std::set<std::string> kKeys{
    "kind",         "station",       "pose",         "utime_us",      "pan_counts", "tilt_counts",
    "pan_counts_s", "tilt_counts_s", "approach_pan", "approach_tilt", "x_px",       "y_px",
    "sd_px",        "reference",     "x_deg",        "y_deg",         "sd_deg",     "zero_sd_deg",
    "x2_px",        "y2_px",         "level_sd_deg", "distance_m",    "offset_m",   "offset_sd_m",
    "height_m",     "height_sd_m"};

// One line's object; every error names its place.
class Line {
 public:
  Line(const std::string& path, unsigned number, const std::string& text)
      : place_(path + ":" + std::to_string(number) + ": ") {
    // The parser keeps the last of two values of one key, and says nothing.
    std::set<std::string> seen;
    std::string twice;
    const auto watch = [&](int depth, Json::parse_event_t event, Json& parsed) {
      if (event != Json::parse_event_t::key || depth != 1) return true;
      if (!seen.insert(parsed.get<std::string>()).second) twice = parsed.get<std::string>();
      return true;
    };
    try {
      object_ = Json::parse(text, watch);
    } catch (const Json::exception&) {
      fail("line", "is not JSON");
    }
    if (!twice.empty()) fail(twice, "appears twice");
    if (!object_.is_object()) fail("line", "is not a JSON object");
    for (const auto& [key, value] : object_.items()) {
      if (!kKeys.contains(key)) fail(key, "is not known");
    }
  }

  [[noreturn]] void fail(const std::string& key, const std::string& what) const {
    throw std::runtime_error(place_ + plain_text(key) + ": " + plain_text(what));
  }
  bool has(const char* key) const { return object_.contains(key) && !object_[key].is_null(); }
  double number(const char* key, double least, double greatest) const {
    if (!has(key)) fail(key, "is missing");
    const Json& value = object_[key];
    if (!value.is_number()) fail(key, "is not a number");
    const auto number = value.get<double>();
    if (!(number >= least && number <= greatest)) {
      std::ostringstream why;
      why << number << " is outside " << least << " .. " << greatest;
      fail(key, why.str());
    }
    return number;
  }
  double number_or(const char* key, double fallback, double least, double greatest) const {
    return has(key) ? number(key, least, greatest) : fallback;
  }
  std::int64_t integer(const char* key) const {
    if (!has(key)) fail(key, "is missing");
    const Json& value = object_[key];
    // Below it a double holds each whole number.
    constexpr double kMost = 9e15;
    // Some programs write every number with a point: 1780000000000000.0 is whole, too.
    const double size =
        value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
    if (!(std::abs(size) <= kMost) || std::trunc(size) != size) {
      fail(key, "is not a whole number within 9e15");
    }
    return static_cast<std::int64_t>(size);
  }
  // A name, or a scene point's number.
  std::string text(const char* key) const {
    if (!has(key)) return "";
    const Json& value = object_[key];
    if (value.is_number_unsigned()) return std::to_string(value.get<std::uint64_t>());
    if (value.is_number_integer()) return std::to_string(value.get<std::int64_t>());
    if (!value.is_string()) fail(key, "is not a text");
    return value.get<std::string>();
  }

 private:
  std::string place_;
  Json object_;
};

AxisReading axis_of(const Line& line, const std::string& axis) {
  constexpr double kMostCounts = 1e7;
  AxisReading reading;
  reading.counts = line.number((axis + "_counts").c_str(), -kMostCounts, kMostCounts);
  reading.counts_per_s =
      line.number_or((axis + "_counts_s").c_str(), 0.0, -kMostCounts, kMostCounts);
  const std::string approach = "approach_" + axis;
  if (line.has(approach.c_str())) {
    reading.approach = static_cast<int>(line.number(approach.c_str(), -1.0, 1.0));
    if (reading.approach == 0) line.fail(approach, "must be 1 or -1");
  }
  return reading;
}

void read_pixel(const Line& line, Observation& one) {
  one.reading.pan = axis_of(line, "pan");
  one.reading.tilt = axis_of(line, "tilt");
  one.sides_stated = line.has("approach_pan") && line.has("approach_tilt");
  one.pixel = {line.number("x_px", -1e5, 1e5), line.number("y_px", -1e5, 1e5)};
  one.sd_px = line.number("sd_px", 1e-4, 1e3);
  one.reference = line.text("reference");
  const bool nameless = one.kind == Kind::kStar || one.kind == Kind::kSun;
  if (one.reference.empty() && !nameless) line.fail("reference", "is missing");
}

void read_level(const Line& line, Observation& one) {
  constexpr double kNewZero_deg = 41.0 / 3600.0;
  one.tilt_rad = {radians(line.number("x_deg", -45.0, 45.0)),
                  radians(line.number("y_deg", -45.0, 45.0))};
  one.tilt_sd_rad = radians(line.number("sd_deg", 1e-6, 45.0));
  one.zero_sd_rad = radians(line.number_or("zero_sd_deg", kNewZero_deg, 1e-6, 45.0));
}

// Reads what a person has stated of a rectification target.
void read_target(const Line& line, Observation& one) {
  constexpr double kLevel_deg = 30.0 / 3600.0, kCross_m = 0.003, kRuler_m = 0.001;
  TargetFacts& target = one.target;
  if (one.kind == Kind::kLevelLine) {
    constexpr double kLeastLine_px = 10.0;
    target.second_px = {line.number("x2_px", -1e5, 1e5), line.number("y2_px", -1e5, 1e5)};
    if ((target.second_px - one.pixel).norm() < kLeastLine_px) {
      line.fail("x2_px", "is nearer than 10 px to the first point of the line");
    }
    target.sd = radians(line.number_or("level_sd_deg", kLevel_deg, 1e-6, 45.0));
    return;
  }
  target.distance_m = line.number("distance_m", 0.5, 1e4);
  const bool is_cross = one.kind == Kind::kCross;
  target.offset_m = line.number(is_cross ? "offset_m" : "height_m", -1e3, 1e3);
  target.sd = is_cross ? line.number_or("offset_sd_m", kCross_m, 1e-6, 10.0)
                       : line.number_or("height_sd_m", kRuler_m, 1e-6, 10.0);
}

bool needs_time(Kind kind) {
  return kind == Kind::kStar || kind == Kind::kSun || kind == Kind::kAircraft ||
         kind == Kind::kDrone || kind == Kind::kTrack;
}

std::size_t station_of(const Line& line, const std::vector<std::string>& stations) {
  if (!line.has("station")) {
    if (stations.size() > 1) line.fail("station", "is missing: there are several");
    return 0;
  }
  const std::string id = line.text("station");
  const auto found = std::ranges::find(stations, id);
  if (found == stations.end()) line.fail("station", "'" + id + "' is not one of the stations");
  return static_cast<std::size_t>(found - stations.begin());
}

Observation observation_of(const Line& line, const std::vector<std::string>& stations) {
  constexpr std::int64_t kLeastUtime_us = 315'964'800'000'000;  // 1980: before, other units
  Observation one;
  const std::string word = line.text("kind");
  const auto kind = kind_of(word);
  if (!kind) line.fail("kind", word.empty() ? "is missing" : "'" + word + "' is not known");
  one.kind = *kind;
  one.station = station_of(line, stations);
  if (line.has("pose")) one.pose = line.integer("pose");
  if (line.has("utime_us")) one.utime_us = line.integer("utime_us");
  if (needs_time(one.kind) && one.utime_us < kLeastUtime_us) {
    line.fail("utime_us", line.has("utime_us")
                              ? "is before 1980: microseconds since 1970 (UTC) are needed"
                              : "is missing");
  }
  one.kind == Kind::kInclinometer ? read_level(line, one) : read_pixel(line, one);
  if (is_rectification_target(one.kind)) read_target(line, one);
  return one;
}

}  // namespace

std::vector<Observation> read_observations(const std::string& path,
                                           const std::vector<std::string>& stations) {
  std::ifstream file(path);
  file.peek();
  if (!file.is_open() || file.bad()) throw std::runtime_error(path + ": cannot be read");
  return read_observations(file, path, stations);
}

std::vector<Observation> read_observations(std::istream& file, const std::string& path,
                                           const std::vector<std::string>& stations) {
  std::vector<Observation> observations;
  std::string text;
  for (unsigned number = 1; std::getline(file, text); ++number) {
    if (text.find_first_not_of(" \t\r") == std::string::npos) continue;
    observations.push_back(observation_of(Line(path, number, text), stations));
    observations.back().line = number;
  }
  // A line that was cut off by an error could still be read as a shorter file.
  if (file.bad()) throw std::runtime_error(path + ": cannot be read to its end");
  if (observations.empty()) throw std::runtime_error(path + ": has no observation");
  return observations;
}

}  // namespace ols::calibration
