// Pan-tilt heads on pseudo terminals.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/process/clocks.h"
#include "edge/mount/serial/pelco_d.h"
#include "edge/mount/serial/serial_kinds.h"
#include "edge/mount/serial/visca_head.h"
#include "geometry/angles.h"
#include "tests/unit/edge/mount/serial/head_on_a_line.h"
#include "tests/unit/eventually.h"

namespace ols::serial_mount {
namespace {

// The protocol manual's own examples.
TEST(PelcoD, SaysWhatItsManualSays) {
  const PelcoD head(1);
  EXPECT_EQ(bytes_of(head.stop()), (Bytes{0xff, 1, 0, 0, 0, 0, 1}));
  EXPECT_EQ(bytes_of(head.velocity(0.5, 0.0)), (Bytes{0xff, 1, 0, 4, 0x20, 0, 0x25}));
  EXPECT_EQ(bytes_of(head.velocity(-1.0, -1.0)), (Bytes{0xff, 1, 0, 0x12, 0x3f, 0x3f, 0x91}));
  EXPECT_EQ(bytes_of(head.place(-10.0, 45.0)),
            (Bytes{0xff, 1, 0, 0x4b, 0x88, 0xb8, 0x8c, 0xff, 1, 0, 0x4d, 0x11, 0x94, 0xf3}));
}

TEST(PelcoD, ReadsAnswersAmongRubbish) {
  PelcoD head(1);
  head.receive(text_of({0x00, 0xff, 1, 0, 0x59, 0x11}));
  EXPECT_FALSE(head.position().pan);
  head.receive(text_of({0x94, 0xff, 0xff, 1, 0, 0x5b, 0x01, 0x00, 0x5d}));
  EXPECT_DOUBLE_EQ(head.position().pan.value_or(-1.0), 45.0);
  EXPECT_DOUBLE_EQ(head.position().tilt.value_or(-1.0), 2.56);
  EXPECT_EQ(head.garbled(), 1);
  head.restart();
  head.receive(text_of({0xff, 2, 0, 0x59, 0x11, 0x94, 0x00}));  // another head's
  head.receive(text_of({0xff, 1, 0, 0x59, 0xff, 0xff, 0x58}));  // more than a turn
  EXPECT_FALSE(head.position().pan);
}

TEST(ViscaHead, SpeaksTheCommandList) {
  ViscaHead head;
  EXPECT_EQ(bytes_of(head.stop()), (Bytes{0x81, 1, 6, 1, 1, 1, 3, 3, 0xff}));
  EXPECT_EQ(bytes_of(head.velocity(1.0, -0.5)), (Bytes{0x81, 1, 6, 1, 0x18, 0x0a, 1, 2, 0xff}));
  EXPECT_EQ(bytes_of(head.place(-2.0, 0x123)),
            (Bytes{0x81, 1, 6, 2, 0x18, 0x14, 15, 15, 15, 14, 0, 1, 2, 3, 0xff}));
  head.receive(text_of({0x90, 0x41, 0xff, 0x90, 0x50, 15, 15, 15, 14, 0, 1, 2, 3, 0xff}));
  EXPECT_DOUBLE_EQ(head.position().pan.value_or(0.0), -2.0);
  EXPECT_DOUBLE_EQ(head.position().tilt.value_or(0.0), 0x123);
  head.receive(text_of({0x90, 0x50, 0x80, 15, 15, 14, 0, 1, 2, 3, 0xff}));
  EXPECT_EQ(head.garbled(), 1);
}

std::unique_ptr<mount::Mount> mount_of(Language language, const std::string& device) {
  SerialConfig config;
  config.device = device;
  const double unit_rad = language == Language::kPelcoD ? radians(1.0) : 0.001;
  config.drive.pan = {0.0, -unit_rad, 0.5};
  config.drive.tilt = {0.0, unit_rad, 0.5};
  config.drive.limits.tilt_min_rad = radians(-40.0);
  config.drive.limits.tilt_max_rad = radians(80.0);
  if (language == Language::kVisca) {
    ViscaKind kind;
    kind.serial = config;
    return kind.open();
  }
  PelcoDKind kind;
  kind.serial = config;
  return kind.open();
}

class SerialMount : public ::testing::TestWithParam<Language> {};

TEST_P(SerialMount, GoesFollowsAndHalts) {
  Head head(GetParam());
  const auto mount = mount_of(GetParam(), head.device());
  ASSERT_TRUE(eventually([&] { return mount->reference() == mount::Reference::kTrusted; }));
  const PanTilt place{radians(-12.0), radians(-5.0)};
  ASSERT_TRUE(eventually([&] {
    const double now_s = clock_monotonic_s();
    mount->set_goal(mount::Goal{now_s, place, {}, now_s + 1.0, false, true});
    return !head.turns() && mount::distance(head.angles(), place) < radians(0.15);
  })) << mount->report().text;

  const PanTilt rate{radians(6.0), radians(2.0)};
  const double began_s = clock_monotonic_s();
  double worst_rad = 0.0;
  ASSERT_TRUE(eventually([&] {
    const double now_s = clock_monotonic_s(), ran_s = now_s - began_s;
    const PanTilt to{place.pan_rad + rate.pan_rad * ran_s, place.tilt_rad + rate.tilt_rad * ran_s};
    mount->set_goal(mount::Goal{now_s, to, rate, now_s + 1.0});
    const PanTilt at = head.angles();
    if (ran_s > 2.5) worst_rad = std::max(worst_rad, mount::distance(at, to));
    return ran_s > 4.0;
  }));
  std::printf("follows 6 deg/s within %.2f deg\n", degrees(worst_rad));
  EXPECT_LT(worst_rad, radians(3.0));

  ASSERT_TRUE(head.turns());
  mount->emergency_halt();
  ASSERT_TRUE(eventually([&] {
    const double now_s = clock_monotonic_s();  // whatever is wanted meanwhile
    mount->set_goal(mount::Goal{now_s, {}, rate, now_s + 60.0, true});
    return !head.turns();
  }));
}

TEST_P(SerialMount, StopsAHeadThatIsSilent) {
  Head head(GetParam());
  {
    const auto mount = mount_of(GetParam(), head.device());
    ASSERT_TRUE(eventually([&] { return mount->limits().has_value(); }));
    const auto turn = [&] {
      const double now_s = clock_monotonic_s();
      mount->set_goal(mount::Goal{now_s, {}, {radians(5.0), 0.0}, now_s + 60.0, true});
    };
    ASSERT_TRUE(eventually([&] {
      turn();
      return head.turns();
    }));
    head.be_silent(true);
    ASSERT_TRUE(eventually([&] { return !head.turns(); })) << "no position, no motion";
    ASSERT_TRUE(eventually([&] { return !mount->limits(); })) << "it is opened anew";
    head.be_silent(false);
    ASSERT_TRUE(eventually([&] { return mount->limits().has_value(); }));
    ASSERT_TRUE(eventually([&] {
      turn();
      return head.turns();
    }));
  }
  EXPECT_TRUE(eventually([&] { return !head.turns(); })) << "its station ends";
}

INSTANTIATE_TEST_SUITE_P(Languages, SerialMount,
                         ::testing::Values(Language::kPelcoD, Language::kVisca));

}  // namespace
}  // namespace ols::serial_mount
