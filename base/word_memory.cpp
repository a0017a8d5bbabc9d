#include "base/word_memory.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <utility>

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
  errno = 0;
  std::ifstream stream(path);
  const int failed = errno;
  std::string found;
  std::getline(stream, found);
  if (stream.is_open() && std::ranges::find(words_, found) != words_.end()) {
    word_ = found;
    recall_ = Recall::kKnown;
    file_.write(found + "\n");  // and is held there from now on
    return;
  }
  const bool missing = !stream.is_open() && failed == ENOENT;
  recall_ = missing ? Recall::kMissing : Recall::kUnreadable;
  if (!missing) {
    why_ = path + ": " + (stream.is_open() ? "is damaged" : std::strerror(failed));
    return;
  }
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
