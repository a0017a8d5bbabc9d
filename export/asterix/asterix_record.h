// An ASTERIX record, item by item. The field specification at its beginning lists the items: seven
// bits per octet, and one bit that says whether another octet follows (EUROCONTROL-SPEC-0149).
// Pure.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace ols::exports {

class AsterixRecord {
 public:
  // `frn`: the item's field reference number in its category's profile, from 1.
  AsterixRecord& with(int frn, std::string bytes);
  std::string bytes() const;

 private:
  std::map<int, std::string> items_;
};

// A value in units of `lsb`, most significant octet first. A value out of range becomes the nearest
// one in range.
std::string asterix_unsigned(double value, double lsb, int octets);
// The same for a standard deviation. It is rounded up, so that a small one does not become 0.
std::string asterix_deviation(double value, double lsb, int octets);
std::string asterix_signed(double value, double lsb, int octets);
// Time since midnight UTC in 1/128 s.
std::string asterix_time(std::int64_t utime_us);
// A compound item of these subfields. The key is the subfield's bit from the left, 0 to 6.
std::string asterix_compound(const std::map<int, std::string>& subfields);
// The contents of a datagram.
std::string asterix_block(int category, const std::vector<std::string>& records);

}  // namespace ols::exports
