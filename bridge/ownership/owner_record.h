// The record of a target's owner. The store keeps it as text. Pure.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace ols::bridge {

using Vector = std::array<double, 3>;

struct OwnerRecord {
  std::string owner;      // name and start of a fusion; empty: the target was released
  std::string successor;  // who should own a released target next; empty: anybody; "-": nobody, the
                          // record is a duplicate
  std::int64_t beat = 0;  // the number of records that this owner has written, for all its targets
  std::int64_t utime_us = 0;
  Vector position_m{}, velocity_m_s{};  // Earth-centred Earth-fixed, at utime_us
  double sd_m = 0.0;
};

std::string to_text(const OwnerRecord& record);
// nullopt if the text is not a record: anybody may have written to the store.
std::optional<OwnerRecord> parse_record(const std::string& text);

}  // namespace ols::bridge
