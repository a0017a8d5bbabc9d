// The simulated telescope by INDI's own client.
#include <gtest/gtest.h>

#include "base/process/clocks.h"
#include "edge/mount/indi/indi_kind.h"
#include "edge/mount/indi/indi_link.h"
#include "sim/telescope/telescope_server.h"
#include "tests/unit/eventually.h"

namespace ols::sim {
namespace {

TelescopeConfig config() {
  TelescopeConfig config;
  config.port = 0;
  config.observer = {radians(49.0), radians(16.0)};
  return config;
}

double speed_rad_s(TelescopeServer& telescope) {
  const double now_s = clock_monotonic_s();
  const PanTilt before = telescope.angles_at(now_s - 0.2), now = telescope.angles_at(now_s);
  return std::hypot(now.pan_rad - before.pan_rad, now.tilt_rad - before.tilt_rad) / 0.2;
}

TEST(Telescope, IsStoppedAlsoIfItReportsNoPosition) {
  TelescopeServer telescope(config(), 1);
  {
    indi::IndiLink before("localhost", telescope.port(), config().device);
    before.open();
    before.connect_telescope();
    ASSERT_TRUE(eventually([&] { return before.heard().can_stop_tracking; }));
    before.track({radians(0.5), radians(0.3)});
    ASSERT_TRUE(eventually([&] { return speed_rad_s(telescope) > radians(0.4); }));
  }
  PtuFaults faults;
  faults.ptz.no_position = true;
  telescope.set_faults(faults);
  indi::IndiKind kind;
  kind.indi.port = telescope.port();
  kind.indi.device = config().device;
  const auto mount = kind.open();
  // Before the mount gives up waiting for a position.
  EXPECT_TRUE(eventually([&] { return speed_rad_s(telescope) == 0.0; }, 8.0));
  EXPECT_FALSE(mount->limits());
}

TEST(Telescope, GoesWhereItIsSent) {
  TelescopeServer telescope(config(), 1);
  indi::IndiLink link("localhost", telescope.port(), config().device);
  link.open();
  link.connect_telescope();
  link.set_interval(0.05);
  ASSERT_TRUE(eventually([&] { return link.heard().position.has_value(); }));
  const PanTilt place{radians(4.0), radians(3.0)};
  link.go_to(indi::equatorial_of(indi::Axes::kEquatorial, place, config().observer,
                                 1e-9 * static_cast<double>(clock_utc_ns())));
  EXPECT_TRUE(eventually([&] {
    const PanTilt at = telescope.angles_at(clock_monotonic_s());
    return std::hypot(at.pan_rad - place.pan_rad, at.tilt_rad - place.tilt_rad) < radians(0.02) &&
           !link.heard().slews;
  }));
}

}  // namespace
}  // namespace ols::sim
