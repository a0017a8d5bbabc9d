#include "edge/mount/onvif/onvif_kind.h"

#include "edge/mount/onvif/onvif_session.h"
#include "edge/mount/onvif/service_address.h"

namespace ols::onvif {

mount::Traits OnvifKind::traits() const { return mount::driven_traits(onvif.drive); }

std::string OnvifKind::words() const { return "ONVIF at " + shown_address(onvif.url); }

std::unique_ptr<mount::Mount> OnvifKind::open() const {
  return std::make_unique<mount::DrivenMount>(onvif.drive, std::make_unique<OnvifSession>(onvif));
}

}  // namespace ols::onvif
