// The file in which a program says how it is, for people and other programs: rewritten as a whole.
#pragma once

#include <string>

namespace ols {

class StatusFile {
 public:
  // Empty: none.
  explicit StatusFile(std::string path);

  // A line's end is added. A failure must not end the program: it is logged once.
  void write(const std::string& text);

 private:
  const std::string path_;
  bool is_reported_ = false;
};

}  // namespace ols
