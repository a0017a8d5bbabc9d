// A small file that is written whole, beside whoever must not wait for a disk, and that is looked
// at from then on: taken away, or changed by somebody, it is written again.
#pragma once

#include <memory>
#include <string>

namespace ols {

class BackgroundFile {
 public:
  explicit BackgroundFile(const std::string& path);  // empty: nothing is written
  // Waits a moment for what is not written yet, but not for a disk that hangs.
  ~BackgroundFile();
  BackgroundFile(const BackgroundFile&) = delete;
  BackgroundFile& operator=(const BackgroundFile&) = delete;

  // To be all that is in the file soon, in place of what still waits. What fails, and what was
  // taken away, is tried again every few seconds. The folder is never made: where it is a disk that
  // is not there, the memory would end up beside it.
  void write(const std::string& text);

  // Whether it is in the file, as soon as that is known: waits so long at most.
  bool is_written(double wait_s) const;
  // Why it is not in the file; empty when all is well.
  std::string trouble() const;

 private:
  struct Shared;  // with the thread

  std::shared_ptr<Shared> shared_;
};

}  // namespace ols
