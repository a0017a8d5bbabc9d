#include "edge/mount/indi/indi_kind.h"

#include <algorithm>

#include "edge/mount/indi/indi_session.h"

namespace ols::indi {

mount::Traits IndiKind::traits() const {
  mount::Traits traits;
  traits.may_home = false;
  traits.limits = indi.drive.limits;
  traits.angles.step_rad = mount::kVirtualCount_rad;
  traits.angles.max_gap_s = std::max(0.5, 4.0 * indi.drive.poll_s);
  traits.angles.max_extrapolation_s =
      std::max(0.4, 2.0 * indi.drive.poll_s + indi.drive.positions.delay_s);
  return traits;
}

std::string IndiKind::words() const {
  return indi.device + " of the INDI server at " + indi.host + ":" + std::to_string(indi.port);
}

std::unique_ptr<mount::Mount> IndiKind::open() const {
  return std::make_unique<mount::DrivenMount>(indi.drive, std::make_unique<IndiSession>(indi));
}

}  // namespace ols::indi
