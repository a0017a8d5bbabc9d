// The mount kind for mounts that never move (mount_kind.h).
#pragma once

#include <memory>
#include <string>

#include "edge/mount/fixed/fixed_mount.h"
#include "edge/mount/mount_kind.h"

namespace ols::mount {

class FixedKind : public MountKind {
 public:
  config::Section section() override;
  Traits traits() const override;
  std::string words() const override;
  std::unique_ptr<Mount> open() const override;

  FixedMountConfig fixed;
};

}  // namespace ols::mount
