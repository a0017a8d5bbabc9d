// Verifies a recording of the bus against the trust lists that were in force. Pure.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/trust/verifier.h"

namespace ols::key {

class LogCheck {
 public:
  // `lists`: of this site, at least one. The recording begins under the first that it tells
  // itself, or else the newest. Without the site's secret the tags are not checked: the
  // signatures prove more.
  explicit LogCheck(std::map<std::int64_t, trust::TrustList> lists);

  // One message as recorded.
  void add(std::string_view channel, trust::Bytes message, std::int64_t utime_us);

  struct Count {
    std::uint64_t good = 0;
    std::map<std::string, std::uint64_t> bad;  // by reason
  };
  // By channel.
  const std::map<std::string, Count>& channels() const { return channels_; }
  std::uint64_t bad() const;
  // A table for a person.
  std::string text() const;

 private:
  void follow_list(std::string_view channel, trust::Bytes message);

  std::map<std::int64_t, trust::TrustList> lists_;
  std::int64_t in_force_ = 0;
  trust::Verifier verifier_;
  std::map<std::string, Count> channels_;
};

// The number of the trust list that such a message tells; nothing for any other.
std::optional<std::int64_t> told_number(std::string_view channel, trust::Bytes message);

}  // namespace ols::key
