#include "edge/ptu/doubt_cause.h"

#include "conditions/alarms.h"

namespace ols::ptu {

Alarm alarm_of(PtuDoubtCause cause) {
  switch (cause) {
    case PtuDoubtCause::kPowerCycle:
      return alarm::ptu_lost_power();
    case PtuDoubtCause::kLimitHit:
      return alarm::ptu_ran_into_limit();
    case PtuDoubtCause::kHomingInterrupted:
      return alarm::ptu_homing_interrupted();
    case PtuDoubtCause::kBeforeStart:
      return alarm::ptu_reference_in_doubt();
  }
  return {};
}

std::string describe(PtuDoubtCause cause) { return alarm_of(cause).reason(); }

}  // namespace ols::ptu
