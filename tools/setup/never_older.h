// What must not be replaced by something older when a host is restored: the site's trust list and
// settings, for an older list believes keys that were revoked since, and the marks against replays.
#pragma once

#include <string>
#include <vector>

#include "tools/setup/host.h"

namespace ols::setup {

class NeverOlder {
 public:
  // Reads what is there. Throws std::system_error.
  explicit NeverOlder(const Host& host);
  // Puts back each file that was replaced by an older one meanwhile, and says so. Marks have no
  // number: those that were there stay. Throws std::system_error.
  void put_back() const;

 private:
  struct File {
    std::string path, text;
  };
  std::vector<File> files_;
};

}  // namespace ols::setup
