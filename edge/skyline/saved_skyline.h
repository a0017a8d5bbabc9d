// Saves a station's seen skyline, so that it survives a restart: converts it to the text of a file
// and back. Pure. The file has these lines:
//
//   ols-skyline 1
//   station ID
//   calibration ID
//   chain HEX                             (chain_hash(), 64 bits)
//   begun UTIME_us
//   camera X_m Y_m Z_m                    (ECEF)
//   COLUMN ELEVATION_deg SD_deg HIDES_FROM_m DISAGREES
//   ...                                   (ascending columns of 0.05 degrees, counted from north)
//   sum HEX                               (FNV-1a, 64 bits, of everything before this line)
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

#include "edge/skyline/skyline_watch.h"
#include "geometry/kinematic_chain.h"

namespace ols::skyline {

// Identifies the setup from which a skyline was seen. Skylines from different setups cannot be
// combined. The calibration's id is not enough, because an operator may change the configured
// heading and keep the calibration.
struct SkylineOwner {
  std::string station;
  std::int64_t calibration_id = 0;
  std::uint64_t chain = 0;  // chain_hash()

  bool operator==(const SkylineOwner&) const = default;
};

// A hash of heading, tilt, mounting and encoder zeros, each rounded to a microradian, and of the
// encoders' signs.
std::uint64_t chain_hash(const ChainParameters& chain);

struct SavedSkyline {
  SkylineOwner owner;
  HidingSkyline skyline;
};

std::string to_text(const SavedSkyline& saved);

// Returns the skyline, or an error message. The message names the wrong line, unless the checksum
// is wrong.
std::variant<SavedSkyline, std::string> saved_skyline_from(std::string_view text);

// The reason why a station with the setup `owner` cannot use `saved`; empty if it can.
std::string why_not_used(const SavedSkyline& saved, const SkylineOwner& owner);

}  // namespace ols::skyline
