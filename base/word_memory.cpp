#include "base/word_memory.h"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <fstream>
#include <utility>

namespace ols {

WordMemory::WordMemory(const std::string& file, std::vector<std::string> words)
    : words_(std::move(words)), file_(file) {
  if (file.empty()) return;
  try {
    read(file);
  } catch (const std::exception& failure) {
    word_ = words_.back();
    unreadable_ = failure.what();
  }
}

void WordMemory::read(const std::string& path) {
  if (!std::filesystem::exists(path)) return;
  std::getline(std::ifstream(path), word_);
  if (std::ranges::find(words_, word_) != words_.end()) return;
  word_ = words_.back();
  unreadable_ = path + ": cannot be read";
}

void WordMemory::set(const std::string& word) {
  if (word == word_) return;
  word_ = word;
  unreadable_.clear();
  file_.write(word.empty() ? "" : word + "\n");
}

std::string WordMemory::trouble() const {
  return unreadable_.empty() ? file_.trouble() : unreadable_;
}

}  // namespace ols
