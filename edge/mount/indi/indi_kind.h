// The mount kind for telescope mounts behind an INDI server (mount_kind.h).
#pragma once

#include <memory>
#include <string>

#include "edge/mount/indi/indi_config.h"
#include "edge/mount/mount_kind.h"

namespace ols::indi {

class IndiKind : public mount::MountKind {
 public:
  config::Section section() override { return indi_section(indi); }
  mount::Traits traits() const override;
  std::string words() const override;
  std::unique_ptr<mount::Mount> open() const override;

  IndiConfig indi;
};

}  // namespace ols::indi
