// The site's trust lists on their way into a log. Each must be written before the first message
// that was judged by it, however long that message waited. One thread receives, another writes.
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
  // as a message; nullopt if the recorder is not a member: nobody would believe the message
  std::optional<std::vector<std::uint8_t>> telling{};
};

class TrustLists {
 public:
  std::int64_t newest() const;  // number of the newest list; 0: there is none
  // `list` must have a higher number than all before.
  void add(ReceivedList list);
  // The lists that must precede a message judged by list `judged_by`, in order. `written`: the
  // number of the last list in this file; 0: there is none, so the file begins with the list that
  // judged its first message. Older lists are dropped.
  std::vector<ReceivedList> due(std::int64_t judged_by, std::int64_t written);

 private:
  mutable std::mutex mutex_;
  std::vector<ReceivedList> lists_;  // by number
};

}  // namespace ols::logger
