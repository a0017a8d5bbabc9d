// A record of ASTERIX, item by item: which are there stands in front of it in the field
// specification, seven bits an octet and one that says whether another follows
// (EUROCONTROL-SPEC-0149). Pure.
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

// A value in units of `lsb`, most significant octet first; what does not fit becomes the nearest
// that does.
std::string asterix_unsigned(double value, double lsb, int octets);
// The same of a standard deviation: the next greater value, so that no small one becomes 0.
std::string asterix_deviation(double value, double lsb, int octets);
std::string asterix_signed(double value, double lsb, int octets);
// Time since midnight UTC in 1/128 s.
std::string asterix_time(std::int64_t utime_us);
// A compound item: the subfields that are there, by their bit from the left, from 0 to 6.
std::string asterix_compound(const std::map<int, std::string>& subfields);
// What goes into a datagram.
std::string asterix_block(int category, const std::vector<std::string>& records);

}  // namespace ols::exports
