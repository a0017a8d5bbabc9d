#include "base/files/persisted_word.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "base/files/small_file.h"

namespace ols {

PersistedWord::PersistedWord(const std::string& file, std::vector<std::string> words)
    : words_(std::move(words)), file_(file) {
  if (file.empty()) {
    why_ = "no state_folder is configured";
  } else {
    read(file);
  }
}

void PersistedWord::read(const std::string& path) {
  constexpr std::size_t kMost = 64;  // [byte]
  try {
    std::string found = read_small_file(path, kMost);
    if (found.ends_with('\n')) found.pop_back();
    if (std::ranges::find(words_, found) != words_.end()) return restore(path, found);
    restore_result_ = RestoreResult::kUnreadable;
    why_ = path + ": is damaged";
  } catch (const std::system_error& failure) {
    if (failure.code() == std::errc::no_such_file_or_directory) return explain_missing(path);
    restore_result_ = RestoreResult::kUnreadable;
    why_ = failure.what();
  }
}

void PersistedWord::restore(const std::string& path, const std::string& word) {
  word_ = word;
  restore_result_ = RestoreResult::kKnown;
  file_.write(word + "\n");  // and kept there from now on
  if (word != words_.front() || file_.is_written(kProof_s)) return;
  restore_result_ = RestoreResult::kUnwritable;
  const std::string trouble = file_.trouble();
  why_ = trouble.empty() ? path + ": the disk does not answer" : trouble;
}

void PersistedWord::explain_missing(const std::string& path) {
  restore_result_ = RestoreResult::kMissing;
  std::error_code ignored;
  const std::string folder = std::filesystem::path(path).parent_path();
  const bool without_folder = !folder.empty() && !std::filesystem::exists(folder, ignored);
  why_ = (without_folder ? folder : path) + " is missing";
}

void PersistedWord::set(const std::string& word) {
  if (word == word_) return;
  word_ = word;
  file_.write(word + "\n");
}

}  // namespace ols
