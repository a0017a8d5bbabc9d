// Decodes the positions that aircraft broadcast with their transponders: ADS-B, extended squitter
// (ICAO Annex 10 Volume IV; RTCA DO-260B; J. Sun, The 1090 Megahertz Riddle).
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>

namespace ols::calibration {

struct AircraftPosition {
  std::string icao;           // six hexadecimal digits
  std::int64_t utime_us = 0;  // UTC of the reception
  double latitude_deg = 0.0, longitude_deg = 0.0;
  double height_m = 0.0;  // above the WGS84 ellipsoid
};

// Whether the last three bytes of a message are the parity of the other bytes.
bool has_right_parity(std::span<const std::uint8_t> message);

class AdsbDecoder {
 public:
  // Takes a message of 14 bytes. Returns a position if this message completes one. A position needs
  // an even and an odd message within ten seconds, and the height above the ellipsoid. An aircraft
  // broadcasts either this height itself, or its barometric height and the difference between the
  // two.
  std::optional<AircraftPosition> take(std::span<const std::uint8_t> message,
                                       std::int64_t utime_us);

  // The number of positions lost because an aircraft broadcast only its barometric height.
  int barometric_only() const { return barometric_only_; }

 private:
  // One half of a position (compact position reporting).
  struct Half {
    std::int64_t utime_us = 0;
    double latitude = 0.0, longitude = 0.0;  // place within the zone, 0..1
  };
  struct Aircraft {
    std::array<std::optional<Half>, 2> halves;  // even, odd
    std::optional<double> above_barometric_m;   // ellipsoidal minus barometric height
    std::int64_t difference_utime_us = 0;
  };
  void take_velocity(Aircraft& aircraft, std::span<const std::uint8_t> payload,
                     std::int64_t utime_us) const;
  std::optional<double> height_m(const Aircraft& aircraft, std::span<const std::uint8_t> payload,
                                 std::int64_t utime_us);

  std::map<std::uint32_t, Aircraft> aircraft_;
  int barometric_only_ = 0;
};

}  // namespace ols::calibration
