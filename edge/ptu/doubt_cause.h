// The reason why a unit's step counter may no longer match the position of its head. Pure.
#pragma once

#include <string>

#include "conditions/alarm.h"

namespace ols::ptu {

enum class PtuDoubtCause { kPowerCycle, kLimitHit, kHomingInterrupted, kBeforeStart };
// The alarm for this reason: what is wrong, and what to do about it.
Alarm alarm_of(PtuDoubtCause cause);
// The same reason as text, with the alarm's words.
std::string describe(PtuDoubtCause cause);

}  // namespace ols::ptu
