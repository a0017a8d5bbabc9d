// The queue of the site's trust lists for a log. Each list must be written before the first message
// that was verified with it, however long that message has waited in its own queue. One thread
// receives lists, another thread writes them.
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace ols::logger {

struct ReceivedList {
  std::int64_t number = 0;
  std::string text{};
  // The list as a message; nullopt if the recorder is not a member of the site, because nobody
  // would then believe the message.
  std::optional<std::vector<std::uint8_t>> telling{};
};

class TrustLists {
 public:
  std::int64_t newest() const;  // number of the newest list; 0: there is none
  // The number of `list` must be greater than that of all earlier lists.
  void add(ReceivedList list);
  // The lists that must be written before a message that was verified with list `judged_by`, in
  // order. `written`: the number of the last list in the current file; 0: the file has no list yet,
  // and begins with list `judged_by`. Discards older lists.
  std::vector<ReceivedList> due(std::int64_t judged_by, std::int64_t written);

 private:
  mutable std::mutex mutex_;
  std::vector<ReceivedList> lists_;  // by number
};

}  // namespace ols::logger
