// Gives targets their ASTERIX track numbers, of 16 bits each. Pure.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>

namespace ols::exports {

class TrackNumbers {
 public:
  // The number of a present target: the fusion's own number for it or, if another present target
  // has that, the next free number. A target therefore usually has the same number after a restart
  // of ols-export.
  std::uint16_t of(const std::string& uid, std::int64_t target_id);
  void release(const std::string& uid);

  static constexpr std::size_t kMost = 60'000;

 private:
  std::map<std::string, std::uint16_t> numbers_;
  std::set<std::uint16_t> taken_;
};

}  // namespace ols::exports
