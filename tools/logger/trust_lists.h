// The site's trust lists on their way into a log: each belongs before the first message that was
// judged by it, however long that message waited to be written. One thread receives, one writes.
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
  // As a message; nothing: the recorder is no member of it, and nobody would believe its word.
  std::optional<std::vector<std::uint8_t>> telling{};
};

class TrustLists {
 public:
  std::int64_t newest() const;  // 0: none
  // A list with a higher number than all before it.
  void add(ReceivedList list);
  // What goes before a message that was judged by list `judged_by`, in order. `written`: the number
  // of the last one in this file; 0: none, and a file begins with the one that its first message
  // was judged by. Older ones are forgotten.
  std::vector<ReceivedList> due(std::int64_t judged_by, std::int64_t written);

 private:
  mutable std::mutex mutex_;
  std::vector<ReceivedList> lists_;  // by number
};

}  // namespace ols::logger
