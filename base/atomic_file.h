// A file that appears whole or not at all, even after a power loss: written under a temporary name
// in the same folder, then renamed. It keeps the owner and the mode of the file that it replaces. A
// symbolic link stays one: the file that it points to is replaced.
#pragma once

#include <fstream>
#include <string>

namespace ols {

class AtomicFile {
 public:
  // Throws std::system_error naming the path when it cannot be opened, or is not a plain file.
  explicit AtomicFile(const std::string& path);
  ~AtomicFile();  // without commit() the destination is left as it was
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  std::ostream& stream() { return stream_; }
  void commit();  // throws std::system_error when a write failed

 private:
  // The entry of `temporary_` among the names that a signal handler removes.
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

// From now on SIGINT, SIGTERM and SIGHUP remove the temporary files before they end the program.
// For programs that have no orderly end of their own (base/shutdown.h); call once, first in main.
void remove_temporary_files_on_signals();

}  // namespace ols
