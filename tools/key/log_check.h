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

// The number of the trust list that a message publishes, if it is one of `lists` and its sender a
// member of that list; otherwise nullopt. Stations publish none: their keys are the ones that may
// be stolen.
std::optional<std::int64_t> told_number(const Lists& lists, std::string_view channel,
                                        trust::Bytes message);

class LogCheck {
 public:
  // `lists` must contain the list of number `first`, the first one in the recording. Without the
  // site's secret the tags are not checked; the signatures prove more.
  LogCheck(Lists lists, std::int64_t first);

  // One recorded message.
  void add(std::string_view channel, trust::Bytes message, std::int64_t utime_us);

  struct Count {
    std::uint64_t good = 0;
    std::map<std::string, std::uint64_t> bad;  // by reason
  };
  // By channel.
  const std::map<std::string, Count>& channels() const { return channels_; }
  std::uint64_t bad() const;
  // The numbers of the lists that were in force, in order.
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
