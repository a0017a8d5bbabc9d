// The mount kind for FLIR's pan-tilt units (edge/mount/mount_kind.h).
#pragma once

#include <memory>
#include <string>

#include "edge/mount/mount_kind.h"
#include "edge/ptu/ptu_config.h"

namespace ols::ptu {

class PtuKind : public mount::MountKind {
 public:
  config::Section section() override { return ptu_section(unit); }
  mount::Traits traits() const override;
  std::string words() const override;
  std::unique_ptr<mount::Mount> open() const override;

  PtuConfig unit;
};

}  // namespace ols::ptu
