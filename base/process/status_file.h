// A program's status file, for people and other programs. Each write replaces the whole file.
#pragma once

#include <string>

namespace ols {

class StatusFile {
 public:
  // Empty path: nothing is written.
  explicit StatusFile(std::string path);

  // Writes the text and a line end. A failure does not end the program: it is logged once.
  void write(const std::string& text);

 private:
  const std::string path_;
  bool is_reported_ = false;
};

}  // namespace ols
