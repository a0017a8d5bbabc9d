#include "edge/mount/indi/indi_kind.h"

#include "edge/mount/indi/indi_session.h"

namespace ols::indi {

mount::Traits IndiKind::traits() const { return mount::driven_traits(indi.drive); }

std::string IndiKind::words() const {
  return indi.device + " of the INDI server at " + indi.host + ":" + std::to_string(indi.port);
}

std::unique_ptr<mount::Mount> IndiKind::open() const {
  return std::make_unique<mount::DrivenMount>(indi.drive, std::make_unique<IndiSession>(indi));
}

}  // namespace ols::indi
