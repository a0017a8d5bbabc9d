#include "cue/sbs_line.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <sstream>

namespace ols {

SbsLine::SbsLine(const std::string& line) {
  std::istringstream rest(line);
  for (std::string cell; std::getline(rest, cell, ',');) cells_.push_back(cell);
}

const std::string& SbsLine::text(Cell cell) const {
  static const std::string kNone;
  return cell < cells_.size() ? cells_[cell] : kNone;
}

std::optional<double> SbsLine::number(Cell cell) const {
  const std::string& digits = text(cell);
  double value = 0.0;
  const auto [end, bad] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const bool is_whole = bad == std::errc() && end == digits.data() + digits.size();
  return is_whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::optional<std::string> SbsLine::icao() const {
  std::string address = text(kAddress);
  const bool is_hex = address.size() == 6 && std::ranges::all_of(address, [](unsigned char c) {
                        return std::isxdigit(c) != 0;
                      });
  if (!is_hex) return std::nullopt;
  std::ranges::transform(address, address.begin(), [](unsigned char c) { return std::tolower(c); });
  return address;
}

}  // namespace ols
