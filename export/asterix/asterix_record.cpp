#include "export/asterix/asterix_record.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ols::exports {
namespace {

constexpr int kItemsPerOctet = 7;

std::string big_endian(std::int64_t value, int octets) {
  std::string bytes;
  for (int i = octets - 1; i >= 0; --i) {
    bytes += static_cast<char>(static_cast<std::uint64_t>(value) >> (8 * i) & 0xffU);
  }
  return bytes;
}

std::string scaled(double value, double lsb, int octets, double least, double greatest) {
  const double units = std::isfinite(value) ? std::round(value / lsb) : 0.0;
  return big_endian(static_cast<std::int64_t>(std::clamp(units, least, greatest)), octets);
}

}  // namespace

AsterixRecord& AsterixRecord::with(int frn, std::string bytes) {
  items_[frn] = std::move(bytes);
  return *this;
}

std::string AsterixRecord::bytes() const {
  if (items_.empty()) return {};
  const int octets = (items_.rbegin()->first + kItemsPerOctet - 1) / kItemsPerOctet;
  std::string specification(static_cast<std::size_t>(octets), '\0');
  std::string content;
  for (const auto& [frn, item] : items_) {
    const int octet = (frn - 1) / kItemsPerOctet, bit = 7 - (frn - 1) % kItemsPerOctet;
    char& marks = specification[static_cast<std::size_t>(octet)];
    marks = static_cast<char>(marks | 1 << bit);
    content += item;
  }
  for (int i = 0; i + 1 < octets; ++i) {
    char& marks = specification[static_cast<std::size_t>(i)];
    marks = static_cast<char>(marks | 1);
  }
  return specification + content;
}

std::string asterix_unsigned(double value, double lsb, int octets) {
  return scaled(value, lsb, octets, 0.0, std::exp2(8 * octets) - 1.0);
}

std::string asterix_deviation(double value, double lsb, int octets) {
  return asterix_unsigned(std::ceil(value / lsb), 1.0, octets);
}

std::string asterix_signed(double value, double lsb, int octets) {
  const double limit = std::exp2(8 * octets - 1);
  return scaled(value, lsb, octets, -limit, limit - 1.0);
}

std::string asterix_time(std::int64_t utime_us) {
  constexpr std::int64_t kDay_us = 86'400'000'000;
  const std::int64_t of_day_us = ((utime_us % kDay_us) + kDay_us) % kDay_us;
  return big_endian(of_day_us * 128 / 1'000'000, 3);
}

std::string asterix_compound(const std::map<int, std::string>& subfields) {
  std::string bytes(1, '\0');
  for (const auto& [bit, field] : subfields) {
    bytes[0] = static_cast<char>(bytes[0] | 1 << (7 - bit));
    bytes += field;
  }
  return bytes;
}

std::string asterix_block(int category, const std::vector<std::string>& records) {
  std::string content;
  for (const std::string& record : records) content += record;
  return big_endian(category, 1) + big_endian(static_cast<std::int64_t>(content.size()) + 3, 2) +
         content;
}

}  // namespace ols::exports
