#include "edge/ptu/ptu_kind.h"

#include "edge/ptu/ptu_thread.h"

namespace ols::ptu {

mount::Traits PtuKind::traits() const {
  return {.moves = true,
          .may_home = unit.limits.keep_out.empty() || unit.home_despite_keep_out,
          .angles = unit.history,
          .limits = unit.limits};
}

std::string PtuKind::words() const {
  return unit.device + " at " + std::to_string(unit.baud) + " baud";
}

std::unique_ptr<mount::Mount> PtuKind::open() const { return std::make_unique<PtuThread>(unit); }

}  // namespace ols::ptu
