// One word of state that survives a restart or a power loss. A missing file means that the previous
// state is unknown.
#pragma once

#include <string>
#include <vector>

#include "base/files/background_file.h"

namespace ols {

// The result of reading the file at construction.
enum class RestoreResult {
  kKnown,       // one of the permitted words
  kNoFile,      // no file is configured: nothing is persisted
  kMissing,     // the file or its folder does not exist
  kUnreadable,  // the file cannot be read, or holds no permitted word
  // The file holds the most permissive word but cannot be written: a later, stricter word may have
  // been lost.
  kUnwritable,
};

class PersistedWord {
 public:
  // `words`: the permitted words, the most permissive first. If the file holds that first word, it
  // is trusted only after it has been written again: on a disk that cannot be written, a later and
  // stricter word may have been lost. Waits for this at most kProof_s. Empty `file`: nothing is
  // persisted.
  PersistedWord(const std::string& file, std::vector<std::string> words);

  RestoreResult restore_result() const { return restore_result_; }
  // Why the word is unknown: "FILE is missing"; empty if it is known.
  const std::string& why_unknown() const { return why_; }
  // The word that was set last, or else restored from the file; empty if there is none.
  const std::string& word() const { return word_; }
  // `word`: one of `words`. Does not wait for the disk. If somebody removes or changes the file, it
  // is written again.
  void set(const std::string& word);

  // Why the file cannot be written now; empty if it can.
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
