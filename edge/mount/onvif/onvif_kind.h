// The mount kind for ONVIF cameras with pan and tilt (mount_kind.h).
#pragma once

#include <memory>
#include <string>

#include "edge/mount/mount_kind.h"
#include "edge/mount/onvif/onvif_config.h"

namespace ols::onvif {

class OnvifKind : public mount::MountKind {
 public:
  config::Section section() override { return onvif_section(onvif); }
  mount::Traits traits() const override;
  std::string words() const override;
  std::unique_ptr<mount::Mount> open() const override;

  OnvifConfig onvif;
};

}  // namespace ols::onvif
