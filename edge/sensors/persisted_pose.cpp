#include "edge/sensors/persisted_pose.h"

#include <cinttypes>
#include <locale>
#include <sstream>

#include "base/files/fnv1a.h"
#include "conditions/printed.h"
#include "geometry/angles.h"

namespace ols::sensors {
namespace {

constexpr std::string_view kHead = "ols-pose 1\n";
constexpr std::string_view kSum = "sum ";

std::string checksum_of(std::string_view text) { return printed("%016" PRIx64, fnv1a(text)); }

bool within(double value, double min, double max) { return value >= min && value <= max; }

// The numbers of a line and its time; false unless the line has exactly these.
bool read_numbers(const std::string& line, double* values, int count, std::int64_t& utime_us) {
  std::istringstream stream(line);
  stream.imbue(std::locale::classic());
  for (int i = 0; i < count; ++i) {
    if (!(stream >> values[i])) return false;
  }
  std::string more;
  return stream >> utime_us && utime_us >= 0 && !(stream >> more);
}

std::optional<PersistedPose::Position> read_position(const std::string& line) {
  constexpr double kMaxSd_m = 1e6;
  double v[6] = {};
  PersistedPose::Position position;
  if (!read_numbers(line, v, 6, position.utime_us)) return std::nullopt;
  if (!within(v[0], -90.0, 90.0) || !within(v[1], -360.0, 360.0) || !within(v[2], -1e5, 1e5)) {
    return std::nullopt;
  }
  position.ground = {radians(v[0]), radians(v[1]), v[2]};
  for (int i = 0; i < 3; ++i) {
    if (!(v[3 + i] > 0.0 && v[3 + i] < kMaxSd_m)) return std::nullopt;
    position.sd_enu_m[i] = v[3 + i];
  }
  return position;
}

std::optional<PersistedPose::Tilt> read_tilt(const std::string& line) {
  constexpr double kMax_deg = 90.0;
  double v[3] = {};
  PersistedPose::Tilt tilt;
  if (!read_numbers(line, v, 3, tilt.utime_us)) return std::nullopt;
  if (!within(v[0], -kMax_deg, kMax_deg) || !within(v[1], -kMax_deg, kMax_deg) ||
      !(v[2] > 0.0 && v[2] <= kMax_deg)) {
    return std::nullopt;
  }
  tilt.tilt_rad = {radians(v[0]), radians(v[1])};
  tilt.sd_rad = radians(v[2]);
  return tilt;
}

}  // namespace

std::string to_text(const PersistedPose& pose) {
  std::string text(kHead);
  if (const auto& p = pose.position) {
    text +=
        printed("position %.12f %.12f %.6f %.6g %.6g %.6g %" PRId64 "\n",
                degrees(p->ground.latitude_rad), degrees(p->ground.longitude_rad),
                p->ground.height_m, p->sd_enu_m.x(), p->sd_enu_m.y(), p->sd_enu_m.z(), p->utime_us);
  }
  if (const auto& t = pose.tilt) {
    text += printed("tilt %.9f %.9f %.6g %" PRId64 "\n", degrees(t->tilt_rad.x()),
                    degrees(t->tilt_rad.y()), degrees(t->sd_rad), t->utime_us);
  }
  return text + std::string(kSum) + checksum_of(text) + "\n";
}

std::variant<PersistedPose, std::string> persisted_pose_from(std::string_view text) {
  if (!text.starts_with(kHead)) return std::string("line 1: is not a saved pose");
  const std::size_t end = text.rfind(kSum);
  if (end == std::string_view::npos || text[end - 1] != '\n' ||
      text.substr(end) != std::string(kSum) + checksum_of(text.substr(0, end)) + "\n") {
    return std::string("is damaged: wrong checksum");
  }
  PersistedPose pose;
  std::istringstream lines(std::string(text.substr(kHead.size(), end - kHead.size())));
  std::string line;
  for (int number = 2; std::getline(lines, line); ++number) {
    bool good = false;
    if (line.starts_with("position ") && !pose.position) {
      good = (pose.position = read_position(line.substr(9))).has_value();
    } else if (line.starts_with("tilt ") && !pose.tilt) {
      good = (pose.tilt = read_tilt(line.substr(5))).has_value();
    }
    if (!good) return "line " + std::to_string(number) + ": is neither a position nor a tilt";
  }
  return pose;
}

}  // namespace ols::sensors
