// Why a unit's step counter may not match the position of its head any more. Pure.
#pragma once

namespace ols::ptu {

enum class PtuDoubtCause { kPowerCycle, kLimitHit, kHomingInterrupted, kBeforeStart };
// What is wrong and what to do about it.
const char* describe(PtuDoubtCause cause);

}  // namespace ols::ptu
