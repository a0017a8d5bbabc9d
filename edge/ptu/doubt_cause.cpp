#include "edge/ptu/doubt_cause.h"

namespace ols::ptu {

const char* describe(PtuDoubtCause cause) {
  switch (cause) {
    case PtuDoubtCause::kPowerCycle:
      return "lost power and was not seen to home since: home it, or reference-ok once "
             "it was checked";
    case PtuDoubtCause::kLimitHit:
      return "ran into a limit and may have lost steps: home it, or reference-ok once it was "
             "checked";
    case PtuDoubtCause::kHomingInterrupted:
      return "homing was interrupted: home it, or reference-ok once it was checked";
    case PtuDoubtCause::kBeforeStart:
      return "its reference was in doubt already before this start: home it, or reference-ok once "
             "it was checked";
  }
  return "";
}

}  // namespace ols::ptu
