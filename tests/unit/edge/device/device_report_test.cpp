#include "edge/device/device_report.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace ols::device {
namespace {

TEST(DeviceReport, IsOfAnAbsentDeviceUntilItIsFilled) {
  const DeviceReport report;
  EXPECT_EQ(report.state, DeviceState::kAbsent);
  EXPECT_FALSE(report.last_good_s);
  EXPECT_EQ(report.errors, 0U);
}

// ols-doctor and the journal tell states apart by their names.
TEST(DeviceReport, EachStateHasANameOfItsOwn) {
  std::set<std::string> names;
  for (const DeviceState state :
       {DeviceState::kAbsent, DeviceState::kStarting, DeviceState::kOk, DeviceState::kFault}) {
    names.insert(to_string(state));
  }
  EXPECT_EQ(names, (std::set<std::string>{"absent", "starting", "ok", "fault"}));
}

}  // namespace
}  // namespace ols::device
