// Files that a restore must not replace by older ones: the site's trust list and settings, and the
// marks against replays. An older list would trust keys that have since been revoked.
#pragma once

#include <string>
#include <vector>

#include "tools/setup/host.h"

namespace ols::setup {

class NeverOlder {
 public:
  // Reads the present files. Throws std::system_error.
  explicit NeverOlder(const Host& host);
  // Writes back each file that was replaced by an older one, and prints its path. Marks have no
  // number to compare: the previous marks are always written back. Throws std::system_error.
  void put_back() const;

 private:
  struct File {
    std::string path, text;
  };
  std::vector<File> files_;
};

}  // namespace ols::setup
