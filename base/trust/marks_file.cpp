#include "base/trust/marks_file.h"

#include <exception>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "base/files/atomic_file.h"
#include "base/files/small_file.h"
#include "conditions/alarms.h"

namespace ols::trust {

MarksFile::MarksFile(std::string path, int said) : path_(std::move(path)), said_(said) {}

void MarksFile::read(ReplayMarks& marks) {
  if (path_.empty()) return;
  try {
    const std::size_t bad = marks.read(read_small_file(path_, kLargest));
    if (bad > 0) say_lost(path_ + ": " + std::to_string(bad) + " damaged lines");
  } catch (const std::system_error& problem) {
    if (problem.code() != std::errc::no_such_file_or_directory) say_lost(problem.what());
  }
  written_ = marks.revision();
}

void MarksFile::say_lost(const std::string& why) {
  const std::lock_guard lock(mutex_);
  lost_ = why;
}

bool MarksFile::is_behind(const ReplayMarks& marks) const {
  return !path_.empty() && marks.revision() != written_;
}

void MarksFile::write(const std::string& text, std::uint64_t revision) {
  std::string trouble;
  try {
    if (text.size() > kLargest) throw std::length_error(path_ + ": too large to be read again");
    AtomicFile file(path_);
    file.stream() << text;
    file.commit();
    written_ = revision;
  } catch (const std::exception& problem) {
    trouble = problem.what();
  }
  const std::lock_guard lock(mutex_);
  unwritten_ = trouble;
}

void MarksFile::look() {
  const std::lock_guard lock(mutex_);
  if (lost_.empty() || --said_ > 0) return;
  lost_.clear();
}

Alarm MarksFile::trouble() const {
  const std::lock_guard lock(mutex_);
  if (!unwritten_.empty()) {
    return alarm::heard_unsaved(unwritten_);
  }
  return lost_.empty() ? Alarm() : alarm::heard_lost(lost_);
}

}  // namespace ols::trust
