#include "base/word_memory.h"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <fstream>
#include <utility>

#include "base/atomic_file.h"

namespace ols {

WordMemory::WordMemory(std::string file, std::vector<std::string> words)
    : file_(std::move(file)), words_(std::move(words)) {
  if (file_.empty()) return;
  try {
    read();
  } catch (const std::exception& failure) {
    word_ = words_.back();
    trouble_ = failure.what();
  }
}

void WordMemory::read() {
  if (!std::filesystem::exists(file_)) return;
  std::getline(std::ifstream(file_), word_);
  if (std::ranges::find(words_, word_) != words_.end()) return;
  word_ = words_.back();
  trouble_ = file_ + ": cannot be read";
}

void WordMemory::set(const std::string& word) {
  if (word == word_) return;
  word_ = word;
  if (file_.empty()) return;
  try {
    write();
    trouble_.clear();
  } catch (const std::exception& failure) {
    trouble_ = failure.what();
  }
}

void WordMemory::write() const {
  if (word_.empty()) {
    std::filesystem::remove(file_);
    return;
  }
  AtomicFile file(file_);
  file.stream() << word_ << '\n';
  file.commit();
}

}  // namespace ols
