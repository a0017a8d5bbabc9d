// A small file, written by a background thread so that its owner never waits for a disk. The thread
// then watches the file, and writes it again if it is removed or changed.
#pragma once

#include <memory>
#include <string>

namespace ols {

class BackgroundFile {
 public:
  explicit BackgroundFile(const std::string& path);  // empty path: nothing is written
  // Waits briefly for a pending write, but not for a disk that hangs.
  ~BackgroundFile();
  BackgroundFile(const BackgroundFile&) = delete;
  BackgroundFile& operator=(const BackgroundFile&) = delete;

  // Replaces the content of the file soon; a write that is still pending is dropped. Retries a
  // failed write every few seconds. Never creates the folder: it may be the mount point of a
  // missing disk.
  void write(const std::string& text);

  // Whether the file holds the text; waits at most wait_s for the answer.
  bool is_written(double wait_s) const;
  // Why the file does not hold the text; empty if it does.
  std::string trouble() const;

 private:
  struct Shared;  // shared with the thread

  std::shared_ptr<Shared> shared_;
};

}  // namespace ols
