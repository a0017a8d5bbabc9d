#include "sim/ptu/controller.h"

#include <gtest/gtest.h>

#include "tests/unit/sim/ptu/master.h"

namespace ols::sim {
namespace {

TEST(PtuSlowSettings, TakeTheTimeThatIsConfigured) {
  PtuUnitConfig config = ready_unit();
  config.parameter_set_s = 6.0;
  Master master(config);
  EXPECT_EQ(master.ask("PL40 PL ", 5.5), "");
  EXPECT_EQ(master.wait(1.0), "*\r\n* 40\r\n");
}

}  // namespace
}  // namespace ols::sim
