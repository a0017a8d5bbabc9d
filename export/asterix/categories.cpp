#include "export/asterix/categories.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "export/asterix/asterix_record.h"
#include "export/uncertainty.h"
#include "geometry/angles.h"

namespace ols::exports {
namespace {

constexpr double kFoot_m = 0.3048;
constexpr double kHeightUnit_m = 6.25 * kFoot_m;
constexpr double kClimbUnit_m_s = 6.25 * kFoot_m / 60.0;
constexpr double kSpeedUnit_m_s = 0.25;
constexpr double kAccuracyUnit_m = 0.5;
const double kPositionUnit_deg = 180.0 / std::exp2(25);
const double kAzimuthUnit_deg = 360.0 / std::exp2(16);
const double kElevationUnit_deg = 180.0 / std::exp2(16);
const double kDeviationUnit_deg = 45.0 / std::exp2(16);

std::string octet(unsigned value) { return std::string(1, static_cast<char>(value)); }

std::string source(int sac, int sic) {
  return octet(static_cast<unsigned>(sac)) + octet(static_cast<unsigned>(sic));
}

bool has_velocity(const Target& target) {
  return std::isfinite(target.velocity_enu_m_s[0] + target.velocity_enu_m_s[1]);
}

// I062/080: several sensors; the geometric height is the better one, and comes from triangulation.
std::string track_status(TrackState state) {
  constexpr unsigned kBetterGeometric = 0x20U, kTriangulation = 3U << 2U, kTentative = 0x02U;
  constexpr unsigned kMore = 0x01U, kLastMessage = 0x40U, kCoasted = 0x80U;
  const unsigned first = kBetterGeometric | kTriangulation;
  switch (state) {
    case TrackState::kTentative:
      return octet(first | kTentative);
    case TrackState::kEnded:
      return octet(first | kMore) + octet(kLastMessage);
    case TrackState::kCoasted:
      return octet(first | kMore) + octet(kMore) + octet(kMore) + octet(kCoasted);
    case TrackState::kConfirmed:
      break;
  }
  return octet(first);
}

// I062/500: deviations of east and north, their covariance as a root with its sign, of the height
// and of the velocity.
std::string accuracies(const Target& target) {
  const Covariance& c = target.covariance_m2;
  std::map<int, std::string> fields;
  if (std::isfinite(sd(c[0]) + sd(c[3]))) {
    fields[0] = asterix_deviation(sd(c[0]), kAccuracyUnit_m, 2) +
                asterix_deviation(sd(c[3]), kAccuracyUnit_m, 2);
    fields[1] = asterix_signed(std::copysign(std::sqrt(std::abs(c[1])), c[1]), kAccuracyUnit_m, 2);
  }
  if (std::isfinite(sd(c[5]))) fields[3] = asterix_deviation(sd(c[5]), kHeightUnit_m, 1);
  const Covariance& v = target.velocity_covariance_m2_s2;
  if (has_velocity(target) && std::isfinite(sd(v[0]) + sd(v[3]))) {
    fields[5] = asterix_deviation(sd(v[0]), kSpeedUnit_m_s, 1) +
                asterix_deviation(sd(v[3]), kSpeedUnit_m_s, 1);
  }
  return fields.empty() ? std::string() : asterix_compound(fields);
}

// I062/380, of which only the emitter category is filled. It has a code for drones and several for
// aircraft by weight, none for an aircraft of any kind or for a bird.
std::string emitter_category(ObjectClass object_class) {
  constexpr int kEmitterCategory = 21;
  constexpr unsigned kUnmanned = 13U;
  if (object_class != ObjectClass::kDrone) return {};
  return AsterixRecord().with(kEmitterCategory, octet(kUnmanned)).bytes();
}

}  // namespace

std::string cat062(const Target& target, std::uint16_t number, const AsterixSettings& settings) {
  AsterixRecord record;
  record.with(1, source(settings.sac, settings.sic))
      .with(4, asterix_time(target.utime_us))
      .with(5, asterix_signed(target.place.latitude_deg, kPositionUnit_deg, 4) +
                   asterix_signed(target.place.longitude_deg, kPositionUnit_deg, 4))
      .with(12, asterix_unsigned(number, 1.0, 2))
      .with(13, track_status(target.state))
      .with(18, asterix_signed(target.place.height_m, kHeightUnit_m, 2));
  const auto& [east, north, up] = target.velocity_enu_m_s;
  if (has_velocity(target)) {
    record.with(7,
                asterix_signed(east, kSpeedUnit_m_s, 2) + asterix_signed(north, kSpeedUnit_m_s, 2));
    if (std::isfinite(up)) record.with(20, asterix_signed(up, kClimbUnit_m_s, 2));
  }
  if (std::string known = accuracies(target); !known.empty()) record.with(27, known);
  if (std::string kind = emitter_category(target.object_class); !kind.empty())
    record.with(11, kind);
  return asterix_block(62, {record.bytes()});
}

std::string cat063(const Station& station, int sensor, const AsterixSettings& settings) {
  constexpr unsigned kDegraded = 1U << 6U, kMore = 0x01U, kBadTime = 0x08U;
  std::string state = octet(station.is_well ? 0U : kDegraded);
  if (!station.clock_is_good) {
    state = octet((station.is_well ? 0U : kDegraded) | kMore) + octet(kBadTime);
  }
  AsterixRecord record;
  record.with(1, source(settings.sac, settings.sic))
      .with(3, asterix_time(station.utime_us))
      .with(4, source(settings.sac, sensor))
      .with(5, state);
  return asterix_block(63, {record.bytes()});
}

std::string cat065(std::int64_t utime_us, const AsterixSettings& settings) {
  constexpr unsigned kStatusMessage = 1U, kOperational = 0U;
  AsterixRecord record;
  record.with(1, source(settings.sac, settings.sic))
      .with(2, octet(kStatusMessage))
      .with(4, asterix_time(utime_us))
      .with(6, octet(kOperational));
  return asterix_block(65, {record.bytes()});
}

std::string cat015(const Line& line, int sensor, const AsterixSettings& settings) {
  constexpr unsigned kMeasurementTrack = 2U << 1U, kEvent = 1U;
  // The standard deviation of the azimuth itself grows towards the zenith.
  const double azimuth_sd_deg =
      line.cross_sd_deg / std::max(1e-3, std::cos(radians(line.elevation_deg)));
  using Subfields = std::map<int, std::string>;
  Subfields azimuth{{0, asterix_unsigned(line.azimuth_deg, kAzimuthUnit_deg, 2)}};
  Subfields elevation{{0, asterix_signed(line.elevation_deg, kElevationUnit_deg, 2)}};
  // A deviation that is not known is left out: 0 would claim that there is no error.
  if (std::isfinite(azimuth_sd_deg))
    azimuth[2] = asterix_deviation(azimuth_sd_deg, kDeviationUnit_deg, 2);
  if (std::isfinite(line.elevation_sd_deg))
    elevation[2] = asterix_deviation(line.elevation_sd_deg, kDeviationUnit_deg, 2);
  AsterixRecord record;
  record.with(1, source(settings.sac, sensor))
      .with(2, octet(kMeasurementTrack | kEvent))
      .with(4, octet(0))
      .with(6, asterix_time(line.utime_us))
      .with(7, asterix_unsigned(static_cast<double>(line.track_id & 0xffff), 1.0, 2))
      .with(8, octet(0))
      .with(22, asterix_compound(azimuth))
      .with(23, asterix_compound(elevation));
  return asterix_block(15, {record.bytes()});
}

}  // namespace ols::exports
