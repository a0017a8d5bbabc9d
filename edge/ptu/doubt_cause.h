// Why a unit's step counter may not match the position of its head any more. Pure.
#pragma once

#include <string>

namespace ols::ptu {

enum class PtuDoubtCause { kPowerCycle, kLimitHit, kHomingInterrupted, kBeforeStart };
// What is wrong and what to do about it.
std::string alarm_of(PtuDoubtCause cause);
// Its alarm without "ptu: ".
std::string describe(PtuDoubtCause cause);

}  // namespace ols::ptu
