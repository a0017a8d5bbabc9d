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

using Lists = std::map<std::int64_t, trust::TrustList>;  // of one site, by number

// The number of the list that such a message tells: one of `lists`, told by a member of that very
// list. Stations tell none: theirs are the keys that may be stolen. Nothing for any other message.
std::optional<std::int64_t> told_number(const Lists& lists, std::string_view channel,
                                        trust::Bytes message);

class LogCheck {
 public:
  // `lists` must have `first`, under which the recording begins: the first that it tells. Without
  // the site's secret the tags are not checked: the signatures prove more.
  LogCheck(Lists lists, std::int64_t first);

  // One message as recorded.
  void add(std::string_view channel, trust::Bytes message, std::int64_t utime_us);

  struct Count {
    std::uint64_t good = 0;
    std::map<std::string, std::uint64_t> bad;  // by reason
  };
  // By channel.
  const std::map<std::string, Count>& channels() const { return channels_; }
  std::uint64_t bad() const;
  // The numbers of the lists that were in force, in their order.
  const std::vector<std::int64_t>& in_force() const { return in_force_; }
  // A table for a person.
  std::string text() const;

 private:
  std::optional<trust::Distrust> judge(std::string_view channel, trust::Bytes message,
                                       std::int64_t utime_us);
  bool follow_list(std::string_view channel, trust::Bytes message, bool believed);

  Lists lists_;
  std::vector<std::int64_t> in_force_;
  trust::Verifier verifier_;
  std::map<std::string, Count> channels_;
};

}  // namespace ols::key
