#include "calibration/adsb.h"

#include <algorithm>
#include <cmath>

#include "conditions/printed.h"
#include "geometry/angles.h"

namespace ols::calibration {
namespace {

constexpr std::size_t kMessageBytes = 14;
constexpr double kFoot_m = 0.3048;
constexpr std::int64_t kPairWithin_us = 10'000'000;
// The difference of the heights follows the weather, slowly.
constexpr std::int64_t kDifferenceWithin_us = 60'000'000;
constexpr double kZones = 15.0;  // of latitude, from the equator to a pole

// Bits of a payload, counted from 0.
std::uint32_t bits(std::span<const std::uint8_t> payload, std::size_t first, std::size_t count) {
  std::uint32_t value = 0;
  for (std::size_t i = first; i < first + count; ++i) {
    value = (value << 1U) | ((payload[i / 8] >> (7U - i % 8)) & 1U);
  }
  return value;
}

// Zones of longitude at a latitude.
double zones_of_longitude(double latitude_deg) {
  const double latitude = std::abs(latitude_deg);
  if (latitude > 87.0) return 1.0;
  if (latitude == 87.0) return 2.0;
  const double c = std::cos(radians(latitude));
  const double a = 1.0 - std::cos(kPi / (2.0 * kZones));
  return std::floor(2.0 * kPi / std::acos(std::clamp(1.0 - a / (c * c), -1.0, 1.0)));
}

double modulo(double value, double by) { return value - by * std::floor(value / by); }

struct Place {
  double latitude_deg = 0.0, longitude_deg = 0.0;
};

// The place of the half that was received last (globally unambiguous decoding).
template <class Half>
std::optional<Place> place_of(const Half& even, const Half& odd, bool last_is_odd) {
  const double j = std::floor(59.0 * even.latitude - 60.0 * odd.latitude + 0.5);
  double even_deg = 6.0 * (modulo(j, 60.0) + even.latitude);
  double odd_deg = 360.0 / 59.0 * (modulo(j, 59.0) + odd.latitude);
  if (even_deg >= 270.0) even_deg -= 360.0;
  if (odd_deg >= 270.0) odd_deg -= 360.0;
  if (std::abs(even_deg) > 90.0 || std::abs(odd_deg) > 90.0) return std::nullopt;
  const double zones = zones_of_longitude(even_deg);
  // A border of zones between the two: they cannot be compared.
  if (zones != zones_of_longitude(odd_deg)) return std::nullopt;
  const double m = std::floor(even.longitude * (zones - 1.0) - odd.longitude * zones + 0.5);
  const double count = std::max(1.0, last_is_odd ? zones - 1.0 : zones);
  const double share = last_is_odd ? odd.longitude : even.longitude;
  double longitude_deg = 360.0 / count * (modulo(m, count) + share);
  if (longitude_deg >= 180.0) longitude_deg -= 360.0;
  return Place{last_is_odd ? odd_deg : even_deg, longitude_deg};
}

}  // namespace

bool has_right_parity(std::span<const std::uint8_t> message) {
  constexpr std::uint32_t kGenerator = 0xFFF409;
  if (message.size() < 4) return false;
  std::uint32_t rest = 0;
  for (std::size_t i = 0; i + 3 < message.size(); ++i) {
    rest ^= static_cast<std::uint32_t>(message[i]) << 16U;
    for (int k = 0; k < 8; ++k) {
      rest = (rest & 0x800000U) != 0 ? (rest << 1U) ^ kGenerator : rest << 1U;
    }
    rest &= 0xFFFFFFU;
  }
  return rest == bits(message.last(3), 0, 24);
}

void AdsbDecoder::take_velocity(Aircraft& aircraft, std::span<const std::uint8_t> payload,
                                std::int64_t utime_us) const {
  const std::uint32_t difference = bits(payload, 49, 7);
  if (difference == 0) return;  // not known
  const double feet = 25.0 * (static_cast<double>(difference) - 1.0);
  aircraft.above_barometric_m = (bits(payload, 48, 1) == 1 ? -feet : feet) * kFoot_m;
  aircraft.difference_utime_us = utime_us;
}

std::optional<double> AdsbDecoder::height_m(const Aircraft& aircraft,
                                            std::span<const std::uint8_t> payload,
                                            std::int64_t utime_us) {
  const std::uint32_t type = bits(payload, 0, 5), code = bits(payload, 8, 12);
  if (type >= 20) return static_cast<double>(code);  // [m] above the ellipsoid
  // Steps of 25 feet; those of 100 are Gillham's code, which hardly any aircraft has left.
  if (code == 0 || (code & 0x10U) == 0) return std::nullopt;
  const bool known =
      aircraft.above_barometric_m && utime_us - aircraft.difference_utime_us < kDifferenceWithin_us;
  if (!known) {
    ++barometric_only_;
    return std::nullopt;
  }
  const double steps = static_cast<double>(((code & 0xFE0U) >> 1U) | (code & 0xFU));
  return (25.0 * steps - 1000.0) * kFoot_m + *aircraft.above_barometric_m;
}

std::optional<AircraftPosition> AdsbDecoder::take(std::span<const std::uint8_t> message,
                                                  std::int64_t utime_us) {
  constexpr std::uint8_t kExtendedSquitter = 17;
  if (message.size() != kMessageBytes || message[0] >> 3U != kExtendedSquitter ||
      !has_right_parity(message)) {
    return std::nullopt;
  }
  const std::uint32_t icao = bits(message, 8, 24);
  const auto payload = message.subspan(4, 7);
  const std::uint32_t type = bits(payload, 0, 5);
  Aircraft& aircraft = aircraft_[icao];
  if (type == 19) take_velocity(aircraft, payload, utime_us);
  const bool airborne = (type >= 9 && type <= 18) || (type >= 20 && type <= 22);
  if (!airborne) return std::nullopt;
  constexpr double kShare = 1.0 / 131072.0;
  const std::size_t odd = bits(payload, 21, 1);
  aircraft.halves[odd] =
      Half{utime_us, kShare * bits(payload, 22, 17), kShare * bits(payload, 39, 17)};
  const std::optional<Half>& other = aircraft.halves[1 - odd];
  if (!other || std::abs(utime_us - other->utime_us) > kPairWithin_us) return std::nullopt;
  const auto place = place_of(*aircraft.halves[0], *aircraft.halves[1], odd == 1);
  if (!place) return std::nullopt;
  const auto height = height_m(aircraft, payload, utime_us);
  if (!height) return std::nullopt;
  return AircraftPosition{printed("%06x", static_cast<unsigned>(icao)), utime_us,
                          place->latitude_deg, place->longitude_deg, *height};
}

}  // namespace ols::calibration
