// The faults of a PTZ camera against the product's driver, by SOAP texts in simulated time: what
// the driver gives as angles is right, or it gives none and says why.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "edge/mount/mount.h"
#include "geometry/angles.h"
#include "sim/onvif/onvif_in_hand.h"

namespace ols::sim {
namespace {

constexpr double kStep_s = 0.005, kRate_deg_s = 5.0;

class FaultyPtz : public testing::Test {
 protected:
  static OnvifConfig device() {
    OnvifConfig config;
    config.unit.command_delay_s = 0.08;
    config.unit.boot_s = 4.0;
    return config;
  }
  static mount::DriveConfig drive(double delay_s = 0.0) {
    mount::DriveConfig config = drive_config(device().unit);
    config.positions.delay_s = delay_s;
    return config;
  }
  void SetUp() override { use(drive()); }
  void use(const mount::DriveConfig& config) { camera_.emplace(device(), config, 1, now_s_); }

  void set(const PtzFaults& faults) { camera_->set_faults(faults, now_s_); }

  // Pans to and fro at a constant rate, within the camera's travel.
  void turn_for(double seconds) {
    for (const double end_s = now_s_ + seconds; now_s_ < end_s; now_s_ += kStep_s) {
      if (std::abs(degrees(truth().pan_rad)) > 60.0) way_ = truth().pan_rad > 0.0 ? -1.0 : 1.0;
      const PanTilt rate{way_ * radians(kRate_deg_s), 0.0};
      camera_->drive().set_goal(mount::Goal{now_s_, {}, rate, now_s_ + 1.0, true});
      camera_->advance(now_s_);
      track_[now_s_] = truth();
      for (const auto& sample : camera_->drive().take_samples()) judge(sample);
    }
  }
  void judge(const mount::AngleSample& sample) {
    ++samples_;
    const auto at = track_.lower_bound(sample.time_s);
    if (at == track_.end()) return;
    worst_deg_ =
        std::max(worst_deg_, std::abs(degrees(sample.angles.pan_rad - at->second.pan_rad)));
  }
  // Since the last call.
  int samples() { return std::exchange(samples_, 0); }
  double worst_deg() { return std::exchange(worst_deg_, 0.0); }

  PanTilt truth() const { return camera_->angles_at(now_s_); }
  double speed_deg_s() {
    const PanTilt before = truth();
    turn_for(0.5);
    return std::abs(degrees(truth().pan_rad - before.pan_rad)) / 0.5;
  }
  bool says(const std::string& id) const {
    const auto alarms = camera_->drive().alarms(now_s_);
    return std::ranges::any_of(alarms, [&](const Alarm& alarm) { return alarm.id == id; });
  }

  double now_s_ = 100.0, way_ = 1.0, worst_deg_ = 0.0;
  int samples_ = 0;
  std::map<double, PanTilt> track_;
  std::optional<OnvifInHand> camera_;
};

TEST_F(FaultyPtz, WithoutFaultsItsAnglesAreTrueInMotion) {
  turn_for(10.0);
  EXPECT_GT(samples(), 30);
  EXPECT_LT(worst_deg(), 0.3);
  EXPECT_GT(speed_deg_s(), 0.5 * kRate_deg_s);
}

TEST_F(FaultyPtz, LatePositionsAreRightOnceTheirDelayIsKnown) {
  constexpr double kLate_s = 0.4;
  set({.late_s = kLate_s});
  turn_for(10.0);
  EXPECT_NEAR(worst_deg(), kRate_deg_s * kLate_s, 0.5) << "nobody knows of the delay";
  use(drive(kLate_s));
  set({.late_s = kLate_s});
  turn_for(2.0);
  samples(), worst_deg();
  turn_for(10.0);
  EXPECT_GT(samples(), 30);
  EXPECT_LT(worst_deg(), 0.5);
}

TEST_F(FaultyPtz, APositionThatStaysIsNotBelievedInMotionAndSaid) {
  turn_for(5.0);
  set({.frozen = true});
  turn_for(10.0);
  EXPECT_TRUE(says("ptu_ignores_orders"));
  samples();
  turn_for(3.0);
  EXPECT_EQ(samples(), 0);
  set({});
  turn_for(60.0);
  EXPECT_FALSE(says("ptu_ignores_orders"));
  EXPECT_GT(samples(), 30);
  EXPECT_GT(speed_deg_s(), 0.5 * kRate_deg_s);
}

TEST_F(FaultyPtz, WithoutPositionsThereAreNoAnglesAndNoMotion) {
  turn_for(5.0);
  set({.no_position = true});
  turn_for(5.0);
  samples();
  EXPECT_LT(speed_deg_s(), 0.01);
  EXPECT_EQ(samples(), 0);
  set({});
  turn_for(10.0);
  EXPECT_GT(samples(), 30);
}

TEST_F(FaultyPtz, AfterARebootItIsWhereItSaysAndGoesOn) {
  turn_for(8.0);
  set({.reboots = true});
  samples();
  turn_for(2.0);
  EXPECT_EQ(samples(), 0) << "it does not answer";
  turn_for(20.0);
  EXPECT_GT(samples(), 30);
  EXPECT_LT(worst_deg(), 0.5);
  EXPECT_GT(speed_deg_s(), 0.5 * kRate_deg_s);
}

TEST_F(FaultyPtz, ConnectionsThatBreakLeaveTheAnglesTrue) {
  set({.lost_share = 0.1});
  turn_for(40.0);
  EXPECT_GT(samples(), 30);
  EXPECT_LT(worst_deg(), 0.5);
  set({});
  turn_for(5.0);
  EXPECT_GT(speed_deg_s(), 0.5 * kRate_deg_s);
}

}  // namespace
}  // namespace ols::sim
