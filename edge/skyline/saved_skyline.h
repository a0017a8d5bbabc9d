// A station's seen skyline as it is saved over a restart, and its text in a file. Pure.
//
//   ols-skyline 1
//   station ID
//   calibration ID
//   chain HEX                             (chain_hash(), 64 bits)
//   begun UTIME_us
//   camera X_m Y_m Z_m                    (ECEF)
//   COLUMN ELEVATION_deg SD_deg HIDES_FROM_m DISAGREES
//   ...                                   (ascending columns, each of 0.05 degrees from north)
//   sum HEX                               (FNV-1a, 64 bits, of everything before this line)
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

#include "edge/skyline/skyline_watch.h"
#include "geometry/kinematic_chain.h"

namespace ols::skyline {

// Identifies the setup in which a skyline was seen. Directions can be compared only if they are
// from the same setup. The calibration's id is not enough, because an operator may change the
// configured heading and keep the calibration.
struct SkylineOwner {
  std::string station;
  std::int64_t calibration_id = 0;
  std::uint64_t chain = 0;  // chain_hash()

  bool operator==(const SkylineOwner&) const = default;
};

// A hash of heading, tilt, mounting and encoders, each to the microradian.
std::uint64_t chain_hash(const ChainParameters& chain);

struct SavedSkyline {
  SkylineOwner owner;
  HidingSkyline skyline;
};

std::string to_text(const SavedSkyline& saved);

// Returns the skyline in the text, or an error that names the line.
std::variant<SavedSkyline, std::string> saved_skyline_from(std::string_view text);

// The reason why `owner` cannot use `saved`; empty if it can.
std::string why_not_used(const SavedSkyline& saved, const SkylineOwner& owner);

}  // namespace ols::skyline
