// A kind of mount: its keys in [mount], what a station knows before the mount is found, and how it
// is opened.
#pragma once

#include <memory>
#include <string>

#include "base/config/config_section.h"
#include "edge/mount/mount.h"

namespace ols::mount {

// Known before the mount is found.
struct Traits {
  bool moves = true;     // false: it obeys no order, and no station's logic waits for it
  bool may_home = true;  // on command
  AngleHistory::Config angles;
  Limits limits;  // as configured; the mount's own may be narrower
};

class MountKind {
 public:
  virtual ~MountKind() = default;
  virtual config::Section section() = 0;  // refers to this object
  virtual Traits traits() const = 0;
  virtual std::string words() const = 0;  // what is configured, in words
  // Starts to look for the mount and returns at once.
  virtual std::unique_ptr<Mount> open() const = 0;
};

}  // namespace ols::mount
