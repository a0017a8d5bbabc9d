#include "edge/lens/lens_motor.h"

#include <gtest/gtest.h>

#include "base/process/clocks.h"
#include "sim/lens/lens_line.h"
#include "tests/unit/eventually.h"

namespace ols::lens {
namespace {

TEST(LensMotor, MovesTheLensOnItsLineAndReports) {
  const sim::LensLine line(sim::LensUnitConfig{.zoom_travel_s = 0.5});
  LensMotorConfig config;
  config.device = line.device();
  LensMotor motor(config);
  EXPECT_TRUE(eventually([&] { return motor.report().state == device::DeviceState::kOk; }));
  EXPECT_EQ(motor.report().text, "vendor 0020, model 0466, ROM 0105");
  LensOrder order;
  order.axes.zoom = AxisOrder{0.5, 0.0, 0.0};
  motor.order(order);
  EXPECT_TRUE(eventually([&] {
    const auto zoom = motor.positions().zoom;
    return zoom && std::abs(*zoom - 0.5) < 1e-3;
  }));
  EXPECT_NEAR(line.zoom_at(clock_monotonic_s()), 0.5, 1e-3);
  EXPECT_FALSE(motor.take_samples().empty());
  EXPECT_TRUE(motor.take_samples().size() < 10U) << "each once";
  EXPECT_GT(motor.report().counters.at("lens_replies"), 4U);
}

TEST(LensMotor, ADeviceThatIsNotThereIsAFaultAndTriedAgain) {
  LensMotorConfig config;
  config.device = "/nowhere/lens";
  const LensMotor motor(config);
  EXPECT_TRUE(eventually([&] { return motor.report().errors > 1; }));
  EXPECT_NE(motor.report().state, device::DeviceState::kOk);
  EXPECT_FALSE(motor.positions().zoom);
}

}  // namespace
}  // namespace ols::lens
