#include "console/unit_chain.h"

#include <algorithm>

#include "console/picture_bytes.h"

namespace ols::console {

void UnitChain::add(const Picture& unit, std::uint64_t number) {
  const bool is_full = units_.size() >= kMostUnits || bytes_ + unit.bytes.size() > kMostBytes;
  if (unit.is_key || is_full) {
    units_.clear();
    bytes_ = 0;
  }
  if (units_.empty() && !unit.is_key) return;
  units_.push_back({number, utime_us(unit), unit.is_key, unit.bytes});
  bytes_ += unit.bytes.size();
  header_ = unit.header;
}

std::string UnitChain::message_after(std::uint64_t had) const {
  const auto had_one =
      std::ranges::find_if(units_, [had](const Unit& unit) { return unit.number == had; });
  // If the number is of another chain, all from the key frame on.
  const auto first = had_one == units_.end() ? units_.begin() : std::next(had_one);
  Json header = header_, units = Json::array();
  std::string bytes;
  for (auto unit = first; unit != units_.end(); ++unit) {
    units.push_back({unit->utime_us, unit->bytes.size(), unit->is_key});
    bytes += unit->bytes;
  }
  header["codec"] = "h264";
  header["units"] = std::move(units);
  return message_bytes(header, bytes);
}

}  // namespace ols::console
