// What must never move a PTU, and what must never leave a station.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "station_fixture.h"

namespace ols::station {
namespace {

using test::StationTest;

class StationSafetyTest : public StationTest {
 protected:
  double counter(const std::string& name) const {
    const auto counters = station_.snapshot().counters;
    const auto found = counters.find(name);
    return found == counters.end() ? 0.0 : found->second;
  }
  void press() { station_.emergency_stop(true, now_); }
  void let_go() { station_.emergency_stop(false, now_); }
  sensors::StationPose pose(double east_m = 0.0, double sd_m = 0.5) const {
    const StationGeometry geometry = config().geometry;
    const LocalFrame site(geometry.position);
    sensors::StationPose pose;
    pose.position = geodetic_from_ecef(site.to_ecef({east_m, 0.0, 0.0}));
    pose.position_sd_enu_m = {sd_m, sd_m, 2.0 * sd_m};
    pose.position_source = pose.tilt_source = sensors::PoseSource::kSensor;
    pose.tilt_sd_rad = 1e-3;
    return pose;
  }
};

const double kNaN = std::numeric_limits<double>::quiet_NaN();
const double kInf = std::numeric_limits<double>::infinity();

// Every field of a slew, each spoilt in every way it can be.
TEST_F(StationSafetyTest, NoSpoiltFieldOfASlewMoves) {
  run_until(100.5);
  using Field = std::function<double&(SlewCommand&)>;
  struct Spoil {
    const char* name;
    Field field;
    std::vector<double> out_of_range;
  };
  const std::vector<Spoil> spoils = {
      {"effect", [](auto& s) -> double& { return s.effect_s; }, {0.0, now_ - 2, now_ + 2, 1e300}},
      {"received", [](auto& s) -> double& { return s.received_s; }, {}},
      {"lease", [](auto& s) -> double& { return s.lease_s; }, {0.0, -1.0, 2.1, 1e300}},
      {"azimuth", [](auto& s) -> double& { return s.direction.azimuth_rad; }, {-7.0, 7.0, 1e300}},
      {"elevation", [](auto& s) -> double& { return s.direction.elevation_rad; }, {-1.6, 1.6, 1e9}},
      {"azimuth rate", [](auto& s) -> double& { return s.azimuth_rate_rad_s; }, {-1.6, 1.6, 1e9}},
      {"elevation rate",
       [](auto& s) -> double& { return s.elevation_rate_rad_s; },
       {-1.6, 1.6, 1e9}},
      {"sd", [](auto& s) -> double& { return s.direction_sd_rad; }, {-1e-9, 4.0, 1e300}}};
  double refused = 0;
  for (const Spoil& spoil : spoils) {
    for (const double value : {kNaN, kInf, -kInf}) {
      SlewCommand command = slew(20.0);
      spoil.field(command) = value;
      EXPECT_EQ(station_.slew(command, now_), Refusal::kNotFinite) << spoil.name << " " << value;
      EXPECT_EQ(counter("refused_not_finite"), ++refused);
    }
    for (const double value : spoil.out_of_range) {
      SlewCommand command = slew(20.0);
      spoil.field(command) = value;
      EXPECT_EQ(station_.slew(command, now_), Refusal::kOutOfRange) << spoil.name << " " << value;
    }
  }
  EXPECT_EQ(station_.state(), StationState::kIdle);
  EXPECT_FALSE(station_.goal(now_));
  EXPECT_EQ(counter("slew_accepted"), 0.0);
  EXPECT_EQ(station_.slew(slew(20.0), now_), Refusal::kNone) << "and a good one is taken after all";
}

TEST_F(StationSafetyTest, NoSpoiltPointMoves) {
  run_until(100.5);
  for (const double value : {kNaN, kInf, -kInf}) {
    EXPECT_EQ(station_.point({{value, 0.0}}, now_), Refusal::kNotFinite);
    EXPECT_EQ(station_.point({{0.0, value}}, now_), Refusal::kNotFinite);
  }
  for (const double tilt_deg : {-46.1, 31.1, 90.0, -90.0, 180.0}) {
    EXPECT_EQ(station_.point({{0.0, radians(tilt_deg)}}, now_), Refusal::kUnreachable) << tilt_deg;
  }
  for (const double pan_deg : {159.1, -159.1, 180.0}) {
    EXPECT_EQ(station_.point({{radians(pan_deg), 0.0}}, now_), Refusal::kUnreachable) << pan_deg;
  }
  // It could be reached by whole turns, but that is not what the operator meant.
  for (const PanTilt& slip :
       {PanTilt{radians(500.0), 0.0}, {radians(-361.0), 0.0}, {0.0, radians(355.0)}, {0.0, -1e6}}) {
    EXPECT_EQ(station_.point({slip}, now_), Refusal::kOutOfRange) << degrees(slip.pan_rad);
  }
  EXPECT_EQ(station_.state(), StationState::kIdle);
  EXPECT_FALSE(station_.goal(now_));
  EXPECT_EQ(counter("point_refused"), 18.0);
}

TEST_F(StationSafetyTest, NoSpoiltDesignationTracks) {
  run_until(100.5);
  for (const double value : {kNaN, kInf, -kInf}) {
    EXPECT_EQ(station_.designate({value, {629, 469, 20, 20}}, now_), Refusal::kNotFinite);
    EXPECT_EQ(station_.designate({{}, {value, 469, 20, 20}}, now_), Refusal::kNotFinite);
    EXPECT_EQ(station_.designate({{}, {629, value, 20, 20}}, now_), Refusal::kNotFinite);
    EXPECT_EQ(station_.designate({{}, {629, 469, value, 20}}, now_), Refusal::kNotFinite);
    EXPECT_EQ(station_.designate({{}, {629, 469, 20, value}}, now_), Refusal::kNotFinite);
  }
  EXPECT_EQ(station_.designate({now_ + 1e9, {629, 469, 20, 20}}, now_), Refusal::kNoFrame);
  EXPECT_EQ(script_.initialised, 0);
  EXPECT_EQ(station_.state(), StationState::kIdle);
  EXPECT_EQ(counter("designate_refused"), 16.0);
}

TEST_F(StationSafetyTest, InAnEmergencyOnlyStopAndRearmAreHeard) {
  designated_for(0.5);
  ASSERT_TRUE(station_.goal(now_));
  press();
  EXPECT_EQ(station_.state(), StationState::kEmergency);
  EXPECT_FALSE(station_.goal(now_));
  EXPECT_EQ(station_.slew(slew(20.0), now_), Refusal::kEmergency);
  EXPECT_EQ(station_.point({{0.2, 0.1}}, now_), Refusal::kEmergency);
  EXPECT_EQ(station_.designate({std::nullopt, {629, 469, 20, 20}}, now_), Refusal::kEmergency);
  EXPECT_EQ(station_.release(now_), Refusal::kEmergency);
  station_.stop(now_);
  EXPECT_EQ(station_.rearm(now_), Refusal::kEmergency) << "still pressed";
  EXPECT_EQ(counter("refused_emergency"), 5.0);
  const std::size_t before = bearings_.size();
  run_until(now_ + 1.0);
  EXPECT_EQ(station_.state(), StationState::kEmergency);
  EXPECT_FALSE(station_.goal(now_));
  EXPECT_EQ(bearings_.size(), before);
  EXPECT_NEAR(counter("seconds_emergency"), 1.0, 0.02);
}

TEST_F(StationSafetyTest, LettingGoOfTheEmergencyStopMovesNothing) {
  designated_for(0.5);
  press();
  let_go();
  run_until(now_ + 1.0);
  EXPECT_EQ(station_.state(), StationState::kEmergency);
  EXPECT_EQ(station_.slew(slew(20.0), now_), Refusal::kEmergency);
  EXPECT_FALSE(station_.goal(now_));
}

TEST_F(StationSafetyTest, AfterRearmingOnlyANewCommandOfTheOperatorMoves) {
  designated_for(0.5);
  press();
  let_go();
  EXPECT_EQ(station_.rearm(now_), Refusal::kNone);
  run_until(now_ + 1.0);
  EXPECT_EQ(station_.state(), StationState::kStopped);
  EXPECT_EQ(station_.slew(slew(20.0), now_), Refusal::kPrecedence);
  EXPECT_FALSE(station_.goal(now_));
  EXPECT_EQ(station_.point({{0.2, 0.1}}, now_), Refusal::kNone);
  EXPECT_TRUE(station_.goal(now_));
}

// Forged REARM and POINT right behind the release of the button.
TEST_F(StationSafetyTest, FromAfarNobodyRearmsAndMovesIt) {
  press();
  EXPECT_EQ(station_.rearm_over_bus(now_), Refusal::kEmergency) << "still pressed";
  let_go();
  EXPECT_EQ(station_.rearm_over_bus(now_), Refusal::kRearmNeedsAHand);
  EXPECT_EQ(station_.point({{0.2, 0.1}}, now_), Refusal::kEmergency);
  EXPECT_EQ(station_.release(now_), Refusal::kEmergency);
  run_until(now_ + 0.2);
  EXPECT_EQ(station_.state(), StationState::kEmergency);
  EXPECT_FALSE(station_.goal(now_));
  EXPECT_EQ(counter("refused_rearm_needs_a_hand"), 1.0);
  EXPECT_EQ(station_.rearm(now_), Refusal::kNone) << "a hand at the station";
  EXPECT_EQ(station_.state(), StationState::kStopped);
}

TEST_F(StationSafetyTest, ASiteMayLetItBeRearmedFromAfar) {
  StationConfig open = config();
  open.rearm_over_bus = true;
  Station station(open, std::make_unique<test::ScriptedTracker>(script_));
  station.emergency_stop(true, now_);
  EXPECT_EQ(station.rearm_over_bus(now_), Refusal::kEmergency) << "still pressed";
  station.emergency_stop(false, now_);
  EXPECT_EQ(station.rearm_over_bus(now_), Refusal::kNone);
  EXPECT_EQ(station.state(), StationState::kStopped);
}

TEST_F(StationSafetyTest, RearmingAStationInOrderChangesNothing) {
  designated_for(0.5);
  EXPECT_EQ(station_.rearm(now_), Refusal::kNone);
  EXPECT_EQ(station_.state(), StationState::kTracking);
}

TEST_F(StationSafetyTest, PressedAgainBeforeRearmingItStays) {
  press();
  let_go();
  press();
  EXPECT_EQ(station_.rearm(now_), Refusal::kEmergency);
  let_go();
  EXPECT_EQ(station_.rearm(now_), Refusal::kNone);
}

TEST_F(StationSafetyTest, WithoutAPositionItFollowsButSendsNoBearing) {
  sensors::StationPose unknown = pose();
  unknown.position_source = sensors::PoseSource::kNone;
  station_.set_pose(unknown);
  designated_for(0.5);
  EXPECT_TRUE(bearings_.empty());
  EXPECT_GT(counter("bearings_without_pose"), 5.0);
  EXPECT_TRUE(station_.goal(now_)) << "the target is followed all the same";
  station_.set_pose(pose());
  run_until(now_ + 0.5);
  EXPECT_FALSE(bearings_.empty());
}

TEST_F(StationSafetyTest, ThePoseAndItsSigmasAreInTheBearings) {
  sensors::StationPose leaning = pose(10.0, 0.5);
  leaning.tilt_sd_rad = radians(1.0);
  station_.set_pose(leaning);
  designated_for(0.5);
  ASSERT_FALSE(bearings_.empty());
  const LineOfSight& sight = bearings_.back().sight;
  EXPECT_EQ(sight.origin_sd_enu_m, Eigen::Vector3d(0.5, 0.5, 1.0));
  EXPECT_NEAR(std::sqrt(sight.covariance_systematic(1, 1)), radians(1.0), 1e-4);
  const Eigen::Vector3d moved = LocalFrame(config().geometry.position).to_enu(sight.origin_ecef);
  EXPECT_NEAR(moved.x(), 10.0, 0.1);
}

TEST_F(StationSafetyTest, AConfiguredPoseIsNoRevision) {
  sensors::StationPose surveyed = pose(0.0, 0.0);
  surveyed.position_source = surveyed.tilt_source = sensors::PoseSource::kSurveyed;
  station_.set_pose(surveyed);
  designated_for(0.3);
  EXPECT_EQ(bearings_.back().pose_revision, 0);
}

TEST_F(StationSafetyTest, OnlyAPoseOutsideOfItsSigmasIsAnotherCalibration) {
  station_.set_pose(pose(0.0, 0.5));
  station_.set_pose(pose(0.4, 0.1));
  designated_for(0.3);
  EXPECT_EQ(bearings_.back().pose_revision, 1) << "no longer the configured one";
  station_.set_pose(pose(0.6, 0.1));
  run_until(now_ + 0.3);
  EXPECT_EQ(bearings_.back().pose_revision, 2);
  sensors::StationPose leaning = pose(0.6, 0.1);
  leaning.tilt_x_rad = 1.1e-3;
  station_.set_pose(leaning);
  run_until(now_ + 0.3);
  EXPECT_EQ(bearings_.back().pose_revision, 3);
}

// A camera's clock was set forward: the mount would run on, without a picture, until then.
TEST_F(StationSafetyTest, AFrameOfTheFutureIsNotUsed) {
  designated_for(0.5);
  const int tracked = script_.tracked;
  camera::Frame early;
  early.mid_exposure_s = now_ + 30.0;
  station_.on_frame(early, now_);
  EXPECT_EQ(script_.tracked, tracked);
  EXPECT_EQ(counter("frames_in_future"), 1.0);
  run_until(now_ + 0.5);
  EXPECT_GT(script_.tracked, tracked) << "the true ones go on";
}

// The computer stood still for two seconds: what lay waiting is dropped, not worked off.
TEST_F(StationSafetyTest, AfterAStandstillThereIsNoBacklog) {
  designated_for(0.5);
  next_sample_ = now_ + 10.0;  // the angles after the last frame never come
  const int tracked = script_.tracked;
  camera::Frame waiting;
  waiting.mid_exposure_s = now_ + 0.01;
  station_.on_frame(waiting, now_ + 0.02);
  EXPECT_EQ(script_.tracked, tracked + 1);
  now_ += 2.0;
  for (int i = 1; i <= 10; ++i) {
    camera::Frame late;
    late.mid_exposure_s = now_ - 2.0 + 0.09 * i;
    station_.on_frame(late, now_);
  }
  EXPECT_EQ(script_.tracked, tracked + 1);
  EXPECT_EQ(counter("frames_too_old"), 10.0);
  EXPECT_TRUE(station_.step(now_).bearings.empty());
  EXPECT_EQ(counter("bearings_too_old") + counter("frames_without_angles"), 1.0);
  EXPECT_FALSE(station_.goal(now_)) << "nothing moves on what was known two seconds ago";
  next_sample_ = next_frame_ = now_;
  run_until(now_ + 1.0);
  EXPECT_EQ(station_.state(), StationState::kTracking) << "and it recovers";
}

// The unit was switched off and on: what its angles mean is not known.
TEST_F(StationSafetyTest, NothingIsPointedOrSlewedWithoutAReference) {
  for (const mount::Reference lost : {mount::Reference::kDoubted, mount::Reference::kMissing}) {
    station_.set_reference(mount::Reference::kTrusted);
    run_until(now_ + 0.5);
    ASSERT_EQ(station_.slew(slew(30.0), now_), Refusal::kNone);
    ASSERT_TRUE(station_.goal(now_));
    station_.set_reference(lost);
    EXPECT_FALSE(station_.goal(now_));
    EXPECT_FALSE(station_.snapshot().angles);
    EXPECT_EQ(station_.slew(slew(30.0), now_), Refusal::kNoReference);
    EXPECT_EQ(station_.point({{0.1, 0.0}}, now_), Refusal::kNoReference);
    EXPECT_FALSE(station_.goal(now_));
  }
  EXPECT_EQ(counter("refused_no_reference"), 4.0);
}

TEST_F(StationSafetyTest, ATargetOutlastsALostReferenceAndIsSlewedToAgain) {
  station_.set_reference(mount::Reference::kTrusted);
  designated_for(1.0);
  ASSERT_EQ(station_.state(), StationState::kTracking);
  station_.set_reference(mount::Reference::kDoubted);
  EXPECT_EQ(station_.state(), StationState::kLost);
  script_.belief = 0.0;
  bearings_.clear();
  now_ += 30.0;  // homing
  next_sample_ = next_frame_ = now_;
  station_.set_reference(mount::Reference::kTrusted);
  run_until(now_ + 0.5);
  ASSERT_EQ(station_.slew(slew(30.0), now_), Refusal::kNone);
  EXPECT_EQ(station_.state(), StationState::kSlewed);
  EXPECT_TRUE(station_.goal(now_));
  script_.belief = 0.9;
  run_until(now_ + 0.45);
  EXPECT_EQ(station_.state(), StationState::kTracking);
  EXPECT_GT(script_.searches, 0);
  EXPECT_EQ(script_.initialised, 1);  // the operator need not designate again
}

TEST_F(StationSafetyTest, HomesWhereItMayAndOnlyThen) {
  station_.set_reference(mount::Reference::kUnknown);
  EXPECT_EQ(station_.home(now_), Refusal::kNoUnit);
  station_.set_reference(mount::Reference::kTrusted);
  press();
  EXPECT_EQ(station_.home(now_), Refusal::kEmergency);
  EXPECT_FALSE(station_.take_actions().home);
  let_go();
  ASSERT_EQ(station_.rearm(now_), Refusal::kNone);
  EXPECT_EQ(station_.home(now_), Refusal::kNone);
  EXPECT_TRUE(station_.take_actions().home);
  EXPECT_FALSE(station_.take_actions().home);
  StationConfig with_regions = config();
  with_regions.homing_allowed = false;
  Station kept(with_regions, std::make_unique<test::ScriptedTracker>(script_));
  kept.set_reference(mount::Reference::kMissing);
  EXPECT_EQ(kept.home(now_), Refusal::kKeepOut);
  EXPECT_FALSE(kept.take_actions().home);
}

TEST_F(StationSafetyTest, NoPointOutlastsTheUnitOrComesBeforeIt) {
  ASSERT_EQ(station_.point({{0.3, 0.1}}, now_), Refusal::kNone);
  ASSERT_TRUE(station_.goal(now_));
  station_.set_reference(mount::Reference::kUnknown);
  EXPECT_FALSE(station_.goal(now_));
  EXPECT_EQ(station_.point({{0.3, 0.1}}, now_), Refusal::kNoUnit);
  station_.set_reference(mount::Reference::kTrusted);
  EXPECT_FALSE(station_.goal(now_));
}

TEST_F(StationSafetyTest, AStopCallsOffAHoming) {
  station_.set_reference(mount::Reference::kTrusted);
  ASSERT_EQ(station_.home(now_), Refusal::kNone);
  station_.stop(now_);
  const UnitActions actions = station_.take_actions();
  EXPECT_FALSE(actions.home);
  EXPECT_TRUE(actions.stop);
  EXPECT_FALSE(station_.take_actions().stop);
  now_ += Station::kStopHold_s;
  EXPECT_EQ(station_.home(now_), Refusal::kNone);  // who says it afterwards means it
  EXPECT_TRUE(station_.take_actions().home);
}

TEST_F(StationSafetyTest, APersonVouchesOnlyForWhatIsDoubted) {
  station_.set_reference(mount::Reference::kTrusted);
  EXPECT_EQ(station_.reference_ok(now_), Refusal::kNoDoubt);
  station_.set_reference(mount::Reference::kMissing);
  EXPECT_EQ(station_.reference_ok(now_), Refusal::kNoReference);
  EXPECT_FALSE(station_.take_actions().reference_ok);
  station_.set_reference(mount::Reference::kDoubted);
  EXPECT_EQ(station_.reference_ok(now_), Refusal::kNone);
  EXPECT_TRUE(station_.take_actions().reference_ok);
}

// A unit that cannot be reached may move unseen.
TEST_F(StationSafetyTest, FromWhichSideItsUnitCameIsUnknownAfterItWasLost) {
  station_.set_limits({.count = {5.61e-5, 5.61e-5}});
  const auto side = [this] {
    run_until(now_ + 0.3, false);
    const auto counts = station_.pointing().counts_at(now_ - 0.1);
    EXPECT_TRUE(counts);
    return counts ? counts->approach.pan : -2;
  };
  EXPECT_EQ(side(), 0);
  angles_.pan_rad += 0.01;
  EXPECT_EQ(side(), 1);
  station_.set_reference(mount::Reference::kUnknown);
  station_.set_reference(mount::Reference::kTrusted);
  EXPECT_EQ(side(), 0);
}

}  // namespace
}  // namespace ols::station
