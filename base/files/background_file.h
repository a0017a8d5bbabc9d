// A small file, written by a background thread so that its owner never waits for a disk. The thread
// then watches the file, and writes it again if it is removed or changed.
#pragma once

#include <memory>
#include <string>

namespace ols {

class BackgroundFile {
 public:
  explicit BackgroundFile(const std::string& path);  // empty path: nothing is written
  // Waits for a pending write, but only briefly, because a disk may hang.
  ~BackgroundFile();
  BackgroundFile(const BackgroundFile&) = delete;
  BackgroundFile& operator=(const BackgroundFile&) = delete;

  // Replaces the content of the file soon, and drops an earlier write that is still pending.
  // Retries a failed write every few seconds. Never creates the folder: it may be the mount point
  // of a missing disk.
  void write(const std::string& text);

  // Whether the file holds the text of the last write(); waits at most wait_s until it does.
  bool is_written(double wait_s) const;
  // Why the file does not hold this text; empty if it does.
  std::string trouble() const;

 private:
  struct Shared;  // shared with the thread

  std::shared_ptr<Shared> shared_;
};

}  // namespace ols
