#include "edge/command/refusal_monitor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ols::station {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(RefusalMonitor, TellsOfRefusalsThatGoOnAndFallsSilentByItself) {
  RefusalMonitor watch;
  watch.note("slews", "replayed", 100.2);
  watch.note("slews", "replayed", 104.7);
  EXPECT_THAT(watch.alarms(105.0), IsEmpty()) << "one or two are none";
  watch.note("slews", "replayed", 105.1);
  EXPECT_THAT(watch.alarms(105.2),
              ElementsAre("commands: 3 slews refused in 10 s: this command was taken before"));
  for (int i = 0; i < 9; ++i) watch.note("slews", "replayed", 106.0);
  EXPECT_THAT(watch.alarms(109.9),
              ElementsAre("commands: 12 slews refused in 10 s: this command was taken before"));
  EXPECT_THAT(watch.alarms(115.9),
              ElementsAre("commands: 9 slews refused in 10 s: this command was taken before"));
  EXPECT_THAT(watch.alarms(116.0), IsEmpty());
}

TEST(RefusalMonitor, KindsAndReasonsAreCountedApart) {
  RefusalMonitor watch;
  for (int i = 0; i < 3; ++i) {
    watch.note("slews", "stale", 50.0);
    watch.note("PTU commands", "replayed", 50.0 + i);
  }
  watch.note("slews", "replayed", 50.0);
  watch.note("slews", "replayed", 60.0);  // in the place of 50.0
  EXPECT_THAT(
      watch.alarms(52.0),
      ElementsAre("commands: 3 PTU commands refused in 10 s: this command was taken before",
                  "commands: 3 slews refused in 10 s: it came too late; compare the clocks"));
}

}  // namespace
}  // namespace ols::station
