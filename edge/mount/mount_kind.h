// A kind of mount: its keys in [mount], what a station knows before the mount is found, and the way
// to open it.
#pragma once

#include <memory>
#include <string>

#include "base/config/config_section.h"
#include "edge/mount/mount.h"

namespace ols::mount {

// What is known before the mount is found.
struct Traits {
  bool moves = true;     // false: the mount obeys no order, and the station never waits for it
  bool may_home = true;  // it can home on command
  AngleHistory::Config angles;
  Limits limits;  // as configured; the mount's own limits may be narrower
};

class MountKind {
 public:
  virtual ~MountKind() = default;
  virtual config::Section section() = 0;  // the section refers to this object
  virtual Traits traits() const = 0;
  virtual std::string words() const = 0;  // the configured mount, in words
  // Starts to look for the mount and returns at once.
  virtual std::unique_ptr<Mount> open() const = 0;
};

}  // namespace ols::mount
