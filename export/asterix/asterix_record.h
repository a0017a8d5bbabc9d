// An ASTERIX record, made of items. Its beginning, the field specification, has one bit for each
// possible item: seven in each octet, and an eighth bit that says whether another octet follows
// (EUROCONTROL-SPEC-0149). Pure.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace ols::exports {

class AsterixRecord {
 public:
  // Adds an item. `frn`: its field reference number in the profile of the category, from 1.
  AsterixRecord& with(int frn, std::string bytes);
  std::string bytes() const;

 private:
  std::map<int, std::string> items_;
};

// Encodes a value in units of `lsb`, most significant octet first. A value out of range becomes the
// nearest value in range.
std::string asterix_unsigned(double value, double lsb, int octets);
// The same for a standard deviation, which is rounded up, so that a small one does not become 0.
std::string asterix_deviation(double value, double lsb, int octets);
std::string asterix_signed(double value, double lsb, int octets);
// The time since midnight UTC, in units of 1/128 s.
std::string asterix_time(std::int64_t utime_us);
// A compound item with these subfields. The key of a subfield is the number of its bit, from the
// left, 0 to 6.
std::string asterix_compound(const std::map<int, std::string>& subfields);
// A data block, which is the content of a datagram: category, length and records.
std::string asterix_block(int category, const std::vector<std::string>& records);

}  // namespace ols::exports
