// Why a unit's step counter may not match the position of its head any more. Pure.
#pragma once

#include <string>

#include "conditions/alarm.h"

namespace ols::ptu {

enum class PtuDoubtCause { kPowerCycle, kLimitHit, kHomingInterrupted, kBeforeStart };
// What is wrong and what to do about it.
Alarm alarm_of(PtuDoubtCause cause);
// The reason of its alarm.
std::string describe(PtuDoubtCause cause);

}  // namespace ols::ptu
