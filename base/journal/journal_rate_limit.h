// Limits a program's journal entries: the beginning and end of each condition, without flooding.
// Pure.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/journal/journal_event.h"

namespace ols {

struct News {
  std::string key;  // entries with the same key are counted together
  JournalEvent event;
};

class JournalRateLimit {
 public:
  // The entries to write now: the first kBurst of a key within kWindow_s. Of the rest, only the
  // last is written, after the window, with the number of skipped entries. So the end of a
  // condition is always written. Call also when there is nothing new. `now_s`: monotonic.
  std::vector<JournalEvent> pass(const std::vector<News>& news, double now_s);

  static constexpr int kBurst = 4;
  static constexpr double kWindow_s = 60.0;

 private:
  struct Told {
    double since_s = 0.0;
    int lines = 0;
    std::optional<News> held;
    std::uint64_t left_out = 0;
  };
  std::map<std::string, Told> told_;
};

}  // namespace ols
