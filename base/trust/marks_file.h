// The marks against replays (replay_marks.h) in a file, so that they outlast a restart. Says what
// is wrong with it for as long as that matters.
#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>

#include "base/trust/replay_marks.h"

namespace ols::trust {

class MarksFile {
 public:
  static constexpr std::size_t kLargest = 20'000'000;  // [byte]
  static constexpr int kSaid = 600;  // looks: of the watching thread, one a second

  // An empty path: they are not kept. A file that could not be read is said for `said` looks.
  explicit MarksFile(std::string path, int said = kSaid);

  // At the start. A file that is not there is that of a first start.
  void read(ReplayMarks& marks);
  // Whether there is anything new to write; from one thread, as write().
  bool is_behind(const ReplayMarks& marks) const;
  void write(const std::string& text, std::uint64_t revision);
  // Once a second.
  void look();

  // What a person should put right; empty: nothing.
  std::string trouble() const;

 private:
  void say_lost(const std::string& why);

  const std::string path_;
  std::uint64_t written_ = 0;  // revision
  mutable std::mutex mutex_;   // of what follows
  int said_;                   // looks for which a file that could not be read is still said
  std::string lost_, unwritten_;
};

}  // namespace ols::trust
