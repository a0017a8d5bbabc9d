#include "tools/doctor/motion_probe.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <deque>

#include "geometry/angles.h"
#include "tools/doctor/judge_devices.h"

namespace ols::doctor {
namespace {

using testing::HasSubstr;

constexpr double kStep_s = 0.02, kPosition_sd_rad = radians(0.02);

// Goes to its goal at 2 deg/s; its positions are 0.4 s late.
struct Mount {
  double gain = 1.0;          // of the motion over the ordered one
  double backlash_rad = 0.0;  // of the way back
  PanTilt at{radians(10.0), 0.0};
  std::deque<PanTilt> late = std::deque<PanTilt>(20, at);
  PanTilt from = at;
  double greatest_rad = 0.0;  // of all its turns

  void run(const mount::Goal& goal) {
    const auto turn = [&](double& now_rad, double begun_rad, double to_rad) {
      const double back_rad = to_rad == begun_rad && now_rad != begun_rad ? backlash_rad : 0.0;
      const double way_rad = begun_rad + gain * (to_rad - begun_rad) + back_rad - now_rad;
      now_rad += std::clamp(way_rad, -radians(2.0) * kStep_s, radians(2.0) * kStep_s);
      greatest_rad = std::max(greatest_rad, std::abs(now_rad - begun_rad));
    };
    turn(at.pan_rad, from.pan_rad, goal.angles.pan_rad);
    turn(at.tilt_rad, from.tilt_rad, goal.angles.tilt_rad);
    late.push_back(at);
    late.pop_front();
  }
};

std::string said_of(Mount mount, const mount::Limits& limits) {
  MotionProbe probe(limits, mount.at);
  double now_s = 50.0;
  for (std::optional<mount::Goal> goal;
       (goal = probe.next(now_s, {{now_s, 0.0, mount.late.front()}})); now_s += kStep_s) {
    mount.run(*goal);
    if (now_s > 150.0) return "it does not end";
  }
  EXPECT_LT(degrees(mount.greatest_rad), 3.1);
  std::string text;
  for (const Finding& finding : judge(probe.motions(), kPosition_sd_rad))
    text += line(finding) + "\n";
  return text;
}

TEST(DoctorMovesAMount, ThereAndBackAndSaysWhatItsPositionsShow) {
  const std::string good = said_of({}, {});
  EXPECT_THAT(good,
              HasSubstr("ok    ptu: pan turned 3.00 of 3.00 deg, its positions show it after 0.5"));
  EXPECT_THAT(good, HasSubstr("tilt turned 3.00 of 3.00 deg"));
  EXPECT_THAT(good, HasSubstr("came back to within 0.000 deg"));
  for (const double gain : {0.0, -1.0, 0.8})
    EXPECT_THAT(said_of({.gain = gain}, {}), HasSubstr("FAIL  ptu: pan turned")) << gain;
  EXPECT_THAT(said_of({.backlash_rad = radians(0.1)}, {}),
              HasSubstr("warn  ptu: pan turned 3.00 of 3.00 deg, its positions show it after 0.5"));
}

TEST(DoctorMovesAMount, OnlyWhereItHasRoom) {
  mount::Limits limits;
  limits.pan_max_rad = radians(12.0);  // turns to the right instead
  limits.keep_out = {{radians(-90.0), radians(90.0), radians(1.0), radians(9.0)},
                     {radians(-90.0), radians(90.0), radians(-9.0), radians(-1.0)}};
  const std::string said = said_of({}, limits);
  EXPECT_THAT(said, HasSubstr("ok    ptu: pan turned 3.00 of 3.00 deg"));
  EXPECT_THAT(said, HasSubstr("tilt has no room to turn"));
}

}  // namespace
}  // namespace ols::doctor
