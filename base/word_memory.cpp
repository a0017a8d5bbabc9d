#include "base/word_memory.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "base/small_file.h"

namespace ols {

WordMemory::WordMemory(const std::string& file, std::vector<std::string> words)
    : words_(std::move(words)), file_(file) {
  if (file.empty()) {
    why_ = "no state_folder is configured";
  } else {
    read(file);
  }
}

void WordMemory::read(const std::string& path) {
  constexpr std::size_t kMost = 64;  // [byte]
  try {
    std::string found = read_small_file(path, kMost);
    if (found.ends_with('\n')) found.pop_back();
    if (std::ranges::find(words_, found) != words_.end()) return recall(path, found);
    recall_ = Recall::kUnreadable;
    why_ = path + ": is damaged";
  } catch (const std::system_error& failure) {
    if (failure.code() == std::errc::no_such_file_or_directory) return explain_missing(path);
    recall_ = Recall::kUnreadable;
    why_ = failure.what();
  }
}

void WordMemory::recall(const std::string& path, const std::string& word) {
  word_ = word;
  recall_ = Recall::kKnown;
  file_.write(word + "\n");  // and is held there from now on
  if (word != words_.front() || file_.is_written(kProof_s)) return;
  recall_ = Recall::kUnwritable;
  const std::string trouble = file_.trouble();
  why_ = trouble.empty() ? path + ": the disk does not answer" : trouble;
}

void WordMemory::explain_missing(const std::string& path) {
  recall_ = Recall::kMissing;
  std::error_code ignored;
  const std::string folder = std::filesystem::path(path).parent_path();
  const bool without_folder = !folder.empty() && !std::filesystem::exists(folder, ignored);
  why_ = (without_folder ? folder : path) + " is missing";
}

void WordMemory::set(const std::string& word) {
  if (word == word_) return;
  word_ = word;
  file_.write(word + "\n");
}

}  // namespace ols
