// Files that a restore must not replace by older ones: the site's trust list and settings, because
// an older list believes keys that have been revoked since; and the marks against replays.
#pragma once

#include <string>
#include <vector>

#include "tools/setup/host.h"

namespace ols::setup {

class NeverOlder {
 public:
  // Reads the present files. Throws std::system_error.
  explicit NeverOlder(const Host& host);
  // Puts back each file that was replaced by an older one, and reports it. Marks have no number:
  // the previous ones stay. Throws std::system_error.
  void put_back() const;

 private:
  struct File {
    std::string path, text;
  };
  std::vector<File> files_;
};

}  // namespace ols::setup
