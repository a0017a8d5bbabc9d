// Remembers one word over a restart, or a loss of power: what a process must not forget by ending.
// That there was no word is a word, too: a file that is not there means that nobody knows.
#pragma once

#include <string>
#include <vector>

#include "base/background_file.h"

namespace ols {

// What the file said when the memory was made.
enum class RestoreResult {
  kKnown,       // one of the words
  kNoFile,      // nothing is to be remembered: no file was named
  kMissing,     // the file, or its folder, is not there
  kUnreadable,  // it cannot be read, or says something else
  kUnwritable,  // it says the first word, which may be old: the last could not be written
};

class PersistedWord {
 public:
  // `words` are those that it may say, first the one that permits most: that one is believed only
  // once it was written again, because a disk that takes nothing has perhaps not taken a later,
  // graver one. `file` empty: nothing is remembered. Waits for the disk, at most kProof_s.
  PersistedWord(const std::string& file, std::vector<std::string> words);

  RestoreResult restore_result() const { return restore_result_; }
  // Why it is not known, in words: "FILE is missing"; empty when it is.
  const std::string& why_unknown() const { return why_; }
  // The word found or set last; empty when neither.
  const std::string& word() const { return word_; }
  // One of `words`. Does not wait for the disk. What is set is kept in the file as long as this
  // lives, whoever takes it away.
  void set(const std::string& word);

  // Why it cannot be written at the moment; empty when all is well.
  std::string trouble() const { return file_.trouble(); }

 private:
  static constexpr double kProof_s = 3.0;
  void read(const std::string& path);
  void restore(const std::string& path, const std::string& word);
  void explain_missing(const std::string& path);

  std::vector<std::string> words_;
  std::string word_;
  RestoreResult restore_result_ = RestoreResult::kNoFile;
  std::string why_;
  BackgroundFile file_;
};

}  // namespace ols
