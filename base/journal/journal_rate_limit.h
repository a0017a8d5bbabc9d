// Limits how often a program writes the beginning and the end of a condition into the journal, so
// that a condition that comes and goes does not flood the journal. Pure.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/journal/journal_event.h"

namespace ols {

struct News {
  std::string key;  // the limit is for all entries with the same key
  JournalEvent event;
};

class JournalRateLimit {
 public:
  // Returns the entries to write now. Of each key, the first kBurst entries within kWindow_s are
  // written at once. Of the later ones only the last is written, when the window ends, with the
  // number of those skipped. The end of a condition is therefore always written. Call also when
  // there is nothing new. `now_s`: monotonic.
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
