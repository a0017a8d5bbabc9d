// Remembers one word over a restart, or a loss of power: what a process must not forget by ending.
#pragma once

#include <string>
#include <vector>

namespace ols {

class WordMemory {
 public:
  // `file` is there as long as there is a word; empty: nothing is remembered. `words` are those
  // that it may say, the gravest last.
  WordMemory(std::string file, std::vector<std::string> words);

  // What there was when this was made, or is now; empty when nothing. A file that cannot be read,
  // or says something else, says the gravest: who cannot know takes the worst.
  const std::string& word() const { return word_; }
  // One of `words`, or empty. Writes only when it changes.
  void set(const std::string& word);

  // Why the file cannot be read or written; empty when all is well.
  const std::string& trouble() const { return trouble_; }

 private:
  void read();
  void write() const;

  std::string file_;
  std::vector<std::string> words_;
  std::string word_;
  std::string trouble_;
};

}  // namespace ols
