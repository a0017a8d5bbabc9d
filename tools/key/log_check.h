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

// The number of the trust list that a message publishes. Nullopt if this list is not one of
// `lists`, or the sender is not a member of it. Also nullopt if the sender is a station: stations
// publish no lists, and a station's key is the most likely to be stolen.
std::optional<std::int64_t> told_number(const Lists& lists, std::string_view channel,
                                        trust::Bytes message);

class LogCheck {
 public:
  // `lists` must contain the list with number `first`, which is the first one in the recording.
  // Tags are not checked, because that needs the site's secret; the signatures prove more.
  LogCheck(Lists lists, std::int64_t first);

  // Takes one recorded message.
  void add(std::string_view channel, trust::Bytes message, std::int64_t utime_us);

  struct Count {
    std::uint64_t good = 0;
    std::map<std::string, std::uint64_t> bad;  // by reason
  };
  // The numbers of good and bad messages, by channel.
  const std::map<std::string, Count>& channels() const { return channels_; }
  std::uint64_t bad() const;
  // The numbers of the trust lists that were in force, in order.
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
