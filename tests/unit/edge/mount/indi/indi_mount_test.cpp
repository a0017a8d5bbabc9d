// The mount against INDI's own telescope simulator.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>

#include "base/process/clocks.h"
#include "base/process/command_output.h"
#include "edge/mount/indi/indi_kind.h"
#include "edge/mount/indi/indi_link.h"
#include "geometry/angles.h"
#include "tests/unit/edge/mount/indi/indi_server.h"
#include "tests/unit/eventually.h"

namespace ols::indi {
namespace {

IndiConfig config_of(int port) {
  IndiConfig config;
  config.port = port;
  config.device = kTelescope;
  config.drive.limits.pan_min_rad = radians(-100.0);
  config.drive.limits.pan_max_rad = radians(100.0);
  return config;
}

std::unique_ptr<mount::Mount> mount_of(const IndiConfig& config) {
  IndiKind kind;
  kind.indi = config;
  return kind.open();
}

bool is_trusted(const mount::Mount& mount) {
  return mount.reference() == mount::Reference::kTrusted;
}

// Keeps the newest sample of a mount.
struct Watched {
  explicit Watched(mount::Mount& watched) : mount(watched) {}
  mount::Mount& mount;
  std::optional<mount::AngleSample> newest;

  const std::optional<mount::AngleSample>& look() {
    for (const auto& sample : mount.take_samples()) newest = sample;
    return newest;
  }
  double speed_deg_s(double over_s) {
    look();
    const mount::AngleSample from = newest.value();
    EXPECT_TRUE(eventually([&] { return look()->time_s >= from.time_s + over_s; }));
    const double time_s = newest->time_s - from.time_s;
    return degrees(std::hypot(newest->angles.pan_rad - from.angles.pan_rad,
                              newest->angles.tilt_rad - from.angles.tilt_rad)) /
           time_s;
  }
  void go(const PanTilt& to, bool rests = true) {
    mount.set_goal(
        mount::Goal{clock_monotonic_s(), to, {}, clock_monotonic_s() + 1.0, false, rests});
  }
  bool arrives(const PanTilt& at, double within_deg) {
    return eventually(
        [&] {
          go(at);
          return look() && degrees(mount::distance(newest->angles, at)) < within_deg;
        },
        60.0);
  }
  // Largest distance from the goal, once it has come to its speed [deg].
  double follow(const PanTilt& rate, double runs_s) {
    const double began_s = clock_monotonic_s();
    const PanTilt from = look()->angles;
    const auto goal_at = [&](double ran_s) {
      return PanTilt{from.pan_rad + rate.pan_rad * ran_s, from.tilt_rad + rate.tilt_rad * ran_s};
    };
    double worst_rad = 0.0;
    EXPECT_TRUE(eventually([&] {
      const double now_s = clock_monotonic_s();
      mount.set_goal(mount::Goal{now_s, goal_at(now_s - began_s), rate, now_s + 1.0});
      const double ran_s = look()->time_s - began_s;
      if (ran_s > 2.5)
        worst_rad = std::max(worst_rad, mount::distance(newest->angles, goal_at(ran_s)));
      EXPECT_LT(now_s - newest->time_s, 1.0) << "no old angles";
      return ran_s > runs_s;
    }));
    return degrees(worst_rad);
  }
};

TEST(IndiMount, GoesFollowsAndHalts) {
  const Server server(7731);
  const auto mount_owner = mount_of(config_of(7731));
  mount::Mount& mount = *mount_owner;
  Watched watched(mount);
  ASSERT_TRUE(eventually([&] { return is_trusted(mount); }));
  // The simulator begins at the pole, six hours east of the meridian.
  const PanTilt place{radians(-85.0), radians(82.0)};
  ASSERT_TRUE(watched.arrives(place, 0.02)) << mount.report().text;
  // And does not follow the stars.
  EXPECT_TRUE(eventually([&] { return watched.speed_deg_s(1.0) < 0.001; }));

  // There and back, because INDI reverses a rate only after a stop; and as the stars go, when the
  // simulator reports nothing.
  for (const auto& [pan_deg_s, tilt_deg_s, runs_s, within_deg] :
       {std::array{1.0, -0.3, 4.0, 0.3}, std::array{-1.0, 0.3, 4.0, 0.3},
        std::array{-15.041 / 3600.0, 0.0, 10.0, 0.01}}) {
    const double worst_deg = watched.follow({radians(pan_deg_s), radians(tilt_deg_s)}, runs_s);
    std::printf("follows %.3f deg/s within %.4f deg\n", pan_deg_s, worst_deg);
    EXPECT_LT(worst_deg, within_deg);
  }

  const auto turn = [&] {
    const double now_s = clock_monotonic_s();
    mount.set_goal(mount::Goal{now_s, {}, {radians(2.0), 0.0}, now_s + 60.0, true});
  };
  turn();
  ASSERT_TRUE(eventually([&] { return watched.speed_deg_s(0.3) > 1.0; }));
  mount.emergency_halt();
  ASSERT_TRUE(eventually([&] {
    turn();  // whatever is wanted meanwhile
    return watched.speed_deg_s(0.2) < 0.05;
  }));
  EXPECT_EQ(mount.report().alarms.size(), 1);
}

// The client before was killed: its last rate goes on.
TEST(IndiMount, StopsWhatItFindsInMotion) {
  const Server server(7734);
  {
    const auto connects_owner = mount_of(config_of(7734));
    mount::Mount& connects = *connects_owner;
    ASSERT_TRUE(eventually([&] { return is_trusted(connects); }));
  }
  {
    IndiLink link("localhost", 7734, kTelescope);
    link.open();
    ASSERT_TRUE(eventually([&] { return link.heard().can_stop_tracking; }));
    link.track({radians(0.5), radians(-0.5)});
    const auto dec_rad = [&] { return link.heard().position.value_or(Equatorial{}).dec_rad; };
    ASSERT_TRUE(eventually([&] { return dec_rad() > 0.0 && dec_rad() < radians(89.5); }));
  }
  const auto mount_owner = mount_of(config_of(7734));
  mount::Mount& mount = *mount_owner;
  Watched watched(mount);
  ASSERT_TRUE(eventually([&] { return is_trusted(mount) && watched.look(); }));
  EXPECT_TRUE(eventually([&] { return watched.speed_deg_s(0.3) < 0.01; }, 3.0));
}

// A doctor connects, too, and must move nothing.
TEST(IndiMount, AParkedTelescopeIsUnparkedByTheFirstGoal) {
  const Server server(7736);
  const auto says = [](const std::string& property, const std::string& value) {
    const std::string name = kTelescope + ("." + property);
    const auto text = command_output({"indi_getprop", "-1", "-p", "7736", "-t", "1", name}, 10.0);
    return text && text->starts_with(value);
  };
  const auto set = [](const std::string& what) {
    return command_output({"indi_setprop", "-p", "7736", kTelescope + ("." + what)}, 10.0)
        .has_value();
  };
  ASSERT_TRUE(eventually([&] { return set("CONNECTION.CONNECT=On"); }));
  ASSERT_TRUE(eventually([&] { return says("CONNECTION.CONNECT", "On"); }));
  ASSERT_TRUE(set("TELESCOPE_PARK.PARK=On"));
  ASSERT_TRUE(eventually([&] { return says("TELESCOPE_PARK._STATE", "Ok"); }, 60.0));
  const auto mount_owner = mount_of(config_of(7736));
  mount::Mount& mount = *mount_owner;
  ASSERT_TRUE(eventually([&] { return is_trusted(mount) && !mount.take_samples().empty(); }));
  EXPECT_TRUE(mount.report().alarms.empty());
  EXPECT_TRUE(says("TELESCOPE_PARK.PARK", "On"));
  mount::Goal goal;
  goal.angles = {radians(20.0), radians(30.0)};
  goal.valid_until_s = clock_monotonic_s() + 60.0;
  mount.set_goal(goal);
  EXPECT_TRUE(eventually([&] { return says("TELESCOPE_PARK.UNPARK", "On"); }));
}

TEST(IndiMount, LeavesItAloneWhereOthersHavePutIt) {
  const Server server(7735);
  const auto mount_owner = mount_of(config_of(7735));
  mount::Mount& mount = *mount_owner;
  ASSERT_TRUE(eventually([&] { return is_trusted(mount); }));
  const auto set = [](const std::string& what) {
    ASSERT_TRUE(command_output({"indi_setprop", "-p", "7735", kTelescope + ("." + what)}, 10.0));
  };
  const auto says = [&](const std::string& words) {
    return eventually([&] {
      const auto alarms = mount.report().alarms;
      return !mount.limits() && std::ranges::any_of(alarms, [&](const Alarm& alarm) {
        return alarm.text.find(words) != std::string::npos;
      });
    });
  };
  // The simulator's way to its park position is on the other side.
  set("TELESCOPE_PARK.PARK=On");
  EXPECT_TRUE(says("parked"));
  EXPECT_TRUE(says("other side of its pier"));
}

TEST(IndiMount, ComesBackWhenItsServerDoes) {
  Server server(7732);
  const auto mount_owner = mount_of(config_of(7732));
  mount::Mount& mount = *mount_owner;
  const auto trusted = [&] { return is_trusted(mount); };
  ASSERT_TRUE(eventually(trusted));
  server.end();
  ASSERT_TRUE(eventually([&] { return !trusted(); }));
  EXPECT_FALSE(mount.limits());
  server.start();
  EXPECT_TRUE(eventually(trusted));
}

TEST(IndiMount, SaysWhatIsMissing) {
  const Server server(7733);
  IndiConfig config = config_of(7733);
  config.device = "No Such Telescope";
  const auto mount_owner = mount_of(config);
  mount::Mount& mount = *mount_owner;
  EXPECT_TRUE(eventually([&] {
    const auto report = mount.report();
    return report.last_error.find("no such device") != std::string::npos;
  }));
}

}  // namespace
}  // namespace ols::indi
