// A small file, written by a background thread so that its owner never waits for a disk. The thread
// checks the file from then on: if it is removed or changed, it is written again.
#pragma once

#include <memory>
#include <string>

namespace ols {

class BackgroundFile {
 public:
  explicit BackgroundFile(const std::string& path);  // empty: nothing is written
  // Waits briefly for a pending write, but not for a disk that hangs.
  ~BackgroundFile();
  BackgroundFile(const BackgroundFile&) = delete;
  BackgroundFile& operator=(const BackgroundFile&) = delete;

  // Replaces the content of the file soon, and any pending write. A failed write is repeated every
  // few seconds. The folder is never created: it may be the mount point of a missing disk.
  void write(const std::string& text);

  // Whether the text is in the file; waits at most wait_s for the answer.
  bool is_written(double wait_s) const;
  // Why it is not in the file; empty when all is well.
  std::string trouble() const;

 private:
  struct Shared;  // with the thread

  std::shared_ptr<Shared> shared_;
};

}  // namespace ols
