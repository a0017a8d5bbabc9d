// A kind of mount: its keys in the configuration section [mount], its traits, and a function that
// opens it.
#pragma once

#include <memory>
#include <string>

#include "base/config/config_section.h"
#include "edge/mount/mount.h"

namespace ols::mount {

// The properties of a mount that are known from its configuration, before it is connected.
struct Traits {
  bool moves = true;     // false: the mount never moves and obeys no orders
  bool may_home = true;  // true: it can home on command
  AngleHistory::Config angles;
  Limits limits;  // as configured; the connected mount may state narrower ones
};

class MountKind {
 public:
  virtual ~MountKind() = default;
  virtual config::Section section() = 0;  // binds its keys to this object's members
  virtual Traits traits() const = 0;
  virtual std::string words() const = 0;  // description of the configured mount
  // Starts the mount's thread, which connects to the mount, and returns at once.
  virtual std::unique_ptr<Mount> open() const = 0;
};

}  // namespace ols::mount
