// A program's status file, for people and other programs. It is rewritten as a whole.
#pragma once

#include <string>

namespace ols {

class StatusFile {
 public:
  // path: empty: no file.
  explicit StatusFile(std::string path);

  // Appends a line's end. A failure must not end the program: it is logged once.
  void write(const std::string& text);

 private:
  const std::string path_;
  bool is_reported_ = false;
};

}  // namespace ols
