// A file that appears whole or not at all, also when the power goes: written beside its place, then
// renamed.
#pragma once

#include <fstream>
#include <string>

namespace ols {

class AtomicFile {
 public:
  // Throws std::system_error naming the path when it cannot be opened, or is no plain file.
  explicit AtomicFile(const std::string& path);
  ~AtomicFile();  // without commit() the destination is left as it was
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  std::ostream& stream() { return stream_; }
  void commit();  // throws std::system_error when a write failed

 private:
  std::string path_;
  std::string temporary_;
  std::ofstream stream_;
  bool committed_ = false;
};

}  // namespace ols
