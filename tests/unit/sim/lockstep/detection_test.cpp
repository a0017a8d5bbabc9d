// Stations that look by themselves, in simulated time: what they send, and what the site makes of
// it when nobody designates anything.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <vector>

#include "sim/lockstep/lead_times.h"
#include "sim/lockstep/lockstep.h"

namespace ols::sim {
namespace {

constexpr double kTick_s = 1e-3;

// The drone passes the middle of the site, 75 m above it, at this time. Each camera at 350 m sees
// 33 m of its way.
Scenario passing(double at_s) {
  Scenario s = load_scenario(std::string(OLS_SCENARIOS) + "/faults.toml");
  s.detector_on = true;
  s.targets.resize(1);
  auto line = std::make_shared<Line>();
  line->v_enu = {6.0, 3.0, 0.0};
  line->start_enu = Eigen::Vector3d(0.0, 0.0, 75.0) - at_s * line->v_enu;
  s.targets.front().trajectory = line;
  return s;
}

PanTilt at_middle(const World& world, std::size_t station) {
  return aim_at(world.stations()[station].nominal, world.site().to_ecef({0.0, 0.0, 75.0})).value();
}

double exposed_s(const station::Bearing& bearing) {
  return bearing.mid_exposure_s - monotonic_s(0.0);
}

// Between a bearing and the direction of the target at its instant.
double off_rad(const World& world, const station::Bearing& bearing) {
  const Eigen::Vector3d target = world.target(0, exposed_s(bearing)).p_ecef;
  return angle_between(direction_ecef(bearing.sight), target - bearing.sight.origin_ecef);
}

// The first station, which nobody designates anything to unless `operated`.
class OneStation : public testing::Test {
 protected:
  void begin(const Scenario& scenario, bool operated = false) {
    world_ = std::make_unique<World>(scenario, 7);
    fidelity_ = operated ? Fidelity{} : nobody_designates(scenario);
    station_ = std::make_unique<LockstepStation>(
        *world_, 0, fidelity_,
        std::make_unique<Renderer>(*world_, 0,
                                   slopes_texture(scenario.landscape, scenario.camera)));
  }
  void run_until(double end_s) {
    for (; time_s_ < end_s; time_s_ += kTick_s) {
      for (station::Bearing& bearing : station_->advance(time_s_)) {
        (bearing.is_tracklet() ? found_ : followed_).push_back(std::move(bearing));
      }
    }
  }
  void point(const PanTilt& angles) {
    station::Station& station = station_->station();
    ASSERT_EQ(station.point({angles}, monotonic_s(time_s_)), station::Refusal::kNone);
  }
  double counter(const char* name) const {
    const auto counters = station_->station().snapshot().counters;
    return counters.contains(name) ? counters.at(name) : 0.0;
  }
  std::set<std::int64_t> ids() const {
    std::set<std::int64_t> ids;
    for (const station::Bearing& bearing : found_) ids.insert(bearing.track_id);
    return ids;
  }

  std::unique_ptr<World> world_;
  Fidelity fidelity_;
  std::unique_ptr<LockstepStation> station_;
  std::vector<station::Bearing> found_, followed_;
  double time_s_ = 0.0;
};

TEST_F(OneStation, SendsBearingsOfWhatCrossesItsView) {
  begin(passing(7.0));
  run_until(2.0);
  point(at_middle(*world_, 0));
  run_until(12.0);
  ASSERT_GT(found_.size(), 15U);
  EXPECT_EQ(ids().size(), 1U);
  EXPECT_TRUE(followed_.empty());
  double squares = 0.0;
  for (const station::Bearing& bearing : found_) {
    EXPECT_LT(off_rad(*world_, bearing), radians(0.1));
    EXPECT_EQ(bearing.detected->image_bearings, 1);
    EXPECT_GT(bearing.detected->signal, 3.0);
    EXPECT_NEAR(bearing.detected->size_rad, 1.2 / 350.0, 0.8 / 350.0);
    squares += std::pow(off_rad(*world_, bearing), 2);
  }
  RecordProperty("off_rms_deg", std::to_string(degrees(std::sqrt(squares / found_.size()))));
  // Six metres a second to the east and three to the north, seen from the southwest.
  const station::DetectedObject& late = *found_.back().detected;
  const Eigen::Vector2d error = late.rate_rad_s - Eigen::Vector2d(2.12 / 362.0, 0.0);
  EXPECT_LT(error.dot(late.rate_covariance.inverse() * error), 16.0);
  EXPECT_GE(counter("detector_images"), 0.75 * 10.0 * 10.0);
}

TEST_F(OneStation, SendsNothingOfAnEmptySky) {
  begin(passing(1e4));
  run_until(2.0);
  point(at_middle(*world_, 0));
  run_until(60.0);
  EXPECT_TRUE(found_.empty()) << found_.size();
  EXPECT_GE(counter("detector_images"), 400.0);
}

TEST_F(OneStation, SendsItsOwnTargetOnce) {
  begin(passing(10.0), true);
  run_until(20.0);
  ASSERT_GT(followed_.size(), 80U);
  // The designation is of an earlier picture: those between it and its arrival were looked at
  // before.
  const double designated_s = followed_.front().mid_exposure_s + 0.3;
  for (const station::Bearing& bearing : found_) {
    if (bearing.mid_exposure_s < designated_s) continue;
    EXPECT_TRUE(std::ranges::none_of(followed_, [&](const station::Bearing& own) {
      return own.mid_exposure_s == bearing.mid_exposure_s && own.track_id == bearing.track_id;
    }));
    const bool both = std::ranges::any_of(followed_, [&](const station::Bearing& own) {
      return own.mid_exposure_s == bearing.mid_exposure_s;
    });
    EXPECT_FALSE(both && off_rad(*world_, bearing) < radians(0.1)) << exposed_s(bearing);
  }
}

// Over hills and clouds at several degrees a second, there and back.
TEST_F(OneStation, SendsNothingOfTheSceneryWhileItTurns) {
  begin(passing(1e4));
  run_until(2.0);
  PanTilt angles = at_middle(*world_, 0);
  for (int i = 0; i < 6; ++i) {
    angles.pan_rad += radians(i % 2 == 0 ? 20.0 : -20.0);
    angles.tilt_rad -= radians(i == 2 ? 4.0 : 0.0);
    point(angles);
    run_until(time_s_ + 5.0);
  }
  EXPECT_LE(ids().size(), 1U);
  EXPECT_GE(counter("detector_images"), 200.0);
}

// Nobody designates: the stations watch the middle and find the drone, the fusion makes a target of
// their tracklets, and its slews bring the stations' trackers onto it.
TEST(DetectingSite, FindsTheDroneAndHoldsIt) {
  Scenario scenario = passing(8.0);
  for (StationScenario& station : scenario.stations) {
    station.watch = azimuth_elevation_from_enu(Eigen::Vector3d(0.0, 0.0, 75.0) - station.p_enu);
  }
  const World world(scenario, 7);
  Fidelity fidelity = nobody_designates(world.scenario());
  fidelity.handover.mode = fusion::HandoverMode::kAutomatic;
  Lockstep site(world, fidelity);
  site.run(16.0);
  const LockstepResult result = site.result();
  ASSERT_FALSE(result.joint.empty());
  RecordProperty("first_position_s", std::to_string(result.joint.front().published_s));
  EXPECT_LT(result.joint.front().published_s, 8.0);
  EXPECT_GT(result.joint.back().published_s, 15.5);
  EXPECT_LT(result.joint.back().error_enu_m.norm(), 1.0);
  for (const StationTruth& station : world.stations()) {
    EXPECT_EQ(site.station(station.id).station().state(), station::StationState::kTracking)
        << station.id;
  }
}

}  // namespace
}  // namespace ols::sim
