// The store's record of a target's owner, as text. Pure.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace ols::bridge {

using Vector = std::array<double, 3>;

struct OwnerRecord {
  std::string owner;      // a fusion and its start; empty: released
  std::string successor;  // of a released target: the next owner; empty: any
  std::int64_t beat = 0;  // grows while the owner lives
  std::int64_t utime_us = 0;
  Vector position_m{}, velocity_m_s{};  // Earth-centred Earth-fixed, at utime_us
  double sd_m = 0.0;
};

std::string to_text(const OwnerRecord& record);
// nullopt if it is no record: anybody may have written there.
std::optional<OwnerRecord> parse_record(const std::string& text);

}  // namespace ols::bridge
