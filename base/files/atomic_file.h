// A file that appears whole or not at all, even after a power loss: it is written under a temporary
// name in the same folder, then renamed. It keeps the owner and mode of the file that it replaces.
// If the path is a symbolic link, the file that it points to is replaced.
#pragma once

#include <fstream>
#include <string>

namespace ols {

class AtomicFile {
 public:
  // Throws std::system_error naming the path if the file cannot be opened or is not a plain file.
  explicit AtomicFile(const std::string& path);
  ~AtomicFile();  // without commit(), the file at `path` stays unchanged
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  std::ostream& stream() { return stream_; }
  void commit();  // throws std::system_error if a write failed

 private:
  // The place of `temporary_` in the list of files that the signal handler removes.
  class Listed {
   public:
    explicit Listed(const char* path);
    ~Listed();
    Listed(const Listed&) = delete;
    Listed& operator=(const Listed&) = delete;

   private:
    const char* path_;
  };

  std::string path_;
  std::string temporary_;
  Listed listed_;
  std::ofstream stream_;
  bool committed_ = false;
};

// Installs handlers for SIGINT, SIGTERM and SIGHUP that remove the temporary files before the
// program ends. For programs without an orderly shutdown (base/process/shutdown.h). Call once,
// first in main.
void remove_temporary_files_on_signals();

}  // namespace ols
