// Remembers one word over a restart, or a loss of power: what a process must not forget by ending.
#pragma once

#include <string>
#include <vector>

#include "base/background_file.h"

namespace ols {

class WordMemory {
 public:
  // `file` is there as long as there is a word; empty: nothing is remembered. `words` are those
  // that it may say, the gravest last.
  WordMemory(const std::string& file, std::vector<std::string> words);

  // What there was when this was made, or is now; empty when nothing. A file that cannot be read,
  // or says something else, says the gravest: who cannot know takes the worst.
  const std::string& word() const { return word_; }
  // One of `words`, or empty. Does not wait for the disk.
  void set(const std::string& word);

  // Why the file could not be read, or cannot be written; empty when all is well.
  std::string trouble() const;

 private:
  void read(const std::string& path);

  std::vector<std::string> words_;
  std::string word_;
  std::string unreadable_;  // until it is written
  BackgroundFile file_;
};

}  // namespace ols
