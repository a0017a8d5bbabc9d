// Keeps the marks against replays (replay_marks.h) in a file, so that they survive a restart.
#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>

#include "base/trust/replay_marks.h"
#include "conditions/alarm.h"

namespace ols::trust {

class MarksFile {
 public:
  static constexpr std::size_t kLargest = 20'000'000;  // [byte]
  static constexpr int kSaid = 600;                    // calls of look(), one a second: ten minutes

  // Empty path: nothing is kept. If the file cannot be read, trouble() says so until look() has
  // been called `said` times.
  explicit MarksFile(std::string path, int said = kSaid);

  // Call at the start. A missing file is normal at the first start.
  void read(ReplayMarks& marks);
  // Whether the marks have changed since the last write. Call from the thread that calls write().
  bool is_behind(const ReplayMarks& marks) const;
  void write(const std::string& text, std::uint64_t revision);
  // Call once a second.
  void look();

  // What a person should correct; empty alarm: nothing.
  Alarm trouble() const;

 private:
  void say_lost(const std::string& why);

  const std::string path_;
  std::uint64_t written_ = 0;  // revision of the last write
  mutable std::mutex mutex_;   // guards the following
  int said_;                   // calls of look() during which an unreadable file is still reported
  std::string lost_, unwritten_;
};

}  // namespace ols::trust
