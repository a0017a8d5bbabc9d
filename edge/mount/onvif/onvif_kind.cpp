#include "edge/mount/onvif/onvif_kind.h"

#include <algorithm>

#include "edge/mount/onvif/onvif_session.h"
#include "edge/mount/onvif/service_address.h"

namespace ols::onvif {

mount::Traits OnvifKind::traits() const {
  const double poll_s = onvif.drive.poll_s;
  mount::Traits traits;
  traits.may_home = false;
  traits.limits = onvif.drive.limits;
  traits.angles.step_rad = mount::kVirtualCount_rad;
  // A camera that renews its position less often than it is asked leaves gaps.
  traits.angles.max_gap_s = std::max(1.0, 5.0 * poll_s);
  traits.angles.max_extrapolation_s = std::max(0.4, 2.0 * poll_s + onvif.drive.positions.delay_s);
  return traits;
}

std::string OnvifKind::words() const { return "ONVIF at " + shown_address(onvif.url); }

std::unique_ptr<mount::Mount> OnvifKind::open() const {
  return std::make_unique<mount::DrivenMount>(onvif.drive, std::make_unique<OnvifSession>(onvif));
}

}  // namespace ols::onvif
