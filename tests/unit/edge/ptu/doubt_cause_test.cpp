#include "edge/ptu/doubt_cause.h"

#include <gtest/gtest.h>

#include <string>

namespace ols::ptu {
namespace {

TEST(PtuDoubtCause, EachCauseSaysWhatToDo) {
  for (const PtuDoubtCause cause :
       {PtuDoubtCause::kPowerCycle, PtuDoubtCause::kLimitHit, PtuDoubtCause::kHomingInterrupted,
        PtuDoubtCause::kBeforeStart}) {
    EXPECT_NE(std::string(describe(cause)).find("home it"), std::string::npos);
  }
}

}  // namespace
}  // namespace ols::ptu
