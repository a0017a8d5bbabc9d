// What faults of a station's sensors make of its pose: its whole process in simulated time.
#include "geometry/angles.h"
#include "tests/unit/edge/process/station_in_simulated_time.h"

namespace ols::station {
namespace {

using Status = ols_msg::station_status_t;

struct Fault {
  sim::GnssFaults gnss;
  sim::InclinometerFaults inclinometer;
  const char* of_position;
  const char* of_tilt;  // null: the inclinometer is well
};

const Fault kFaults[] = {
    {{.no_fix = true}, {.stuck = true}, "gnss: no fix for", "inclinometer: stuck"},
    {{.silent = true}, {.silent = true}, "gnss: silent for", "inclinometer: silent for"},
    {{.jump_m = 100.0}, {}, "gnss: 100 m from the", nullptr},
};

// Of a station with a survey, and of one that has only what its sensors measure.
class StationSensors : public test::StationInSimulatedTime,
                       public testing::WithParamInterface<bool> {
 protected:
  StationSensors()
      : StationInSimulatedTime(with_sensors(), [](StationSettings& settings) {
          if (GetParam()) return;
          settings.pose.surveyed_position.reset();
          settings.pose.surveyed_tilt_rad.reset();
        }) {}

  static sim::Scenario with_sensors() {
    sim::Scenario s = scenario();
    s.inclinometer.on = s.gnss.on = true;
    s.ptu.home_at_power_up = false;
    return s;
  }
  void set_faults(const sim::GnssFaults& gnss, const sim::InclinometerFaults& inclinometer) {
    sim::StationFaults faults;
    faults.gnss = gnss;
    faults.inclinometer = inclinometer;
    station_->set_faults(faults);
  }
  bool is_quiet() {
    return time_.pass(
        60.0, [this] { return !says("gnss:") && !says("inclinometer:") && !says("pose:"); });
  }
  Eigen::Vector3d place() const {
    return ecef_from_geodetic(
        {radians(status_.latitude_deg), radians(status_.longitude_deg), status_.height_m});
  }
};

TEST_P(StationSensors, FaultsLeavePositionAndTiltAndTheirSigmasGrow) {
  ASSERT_TRUE(is_quiet());
  time_.pass(10.0);
  const Status before = status_;
  const Eigen::Vector3d p_before = place();
  const StationGeometry& truth = world_.stations()[0].truth;
  EXPECT_LT((p_before - ecef_from_geodetic(truth.position)).norm(), 0.2);
  EXPECT_NEAR(before.tilt_y_rad, truth.chain.tilt_y_rad, radians(0.08));
  EXPECT_EQ(before.position_source, GetParam() ? +Status::POSE_SURVEYED : +Status::POSE_SENSOR);
  EXPECT_EQ(before.tilt_source, before.position_source);
  for (const Fault& fault : kFaults) {
    SCOPED_TRACE(fault.of_position);
    set_faults(fault.gnss, fault.inclinometer);
    EXPECT_TRUE(is_said(fault.of_position));
    EXPECT_EQ(says("position kept"), fault.gnss.jump_m == 0.0);
    EXPECT_TRUE(!fault.of_tilt || is_said(fault.of_tilt));
    EXPECT_EQ(says("tilt kept"), fault.of_tilt != nullptr);
    EXPECT_TRUE(time_.pass(60.0, [&] {
      return status_.position_sd_m[0] > before.position_sd_m[0] + 0.004 &&
             (!fault.of_tilt || status_.tilt_sd_rad > before.tilt_sd_rad + 1e-6);
    }));
    EXPECT_EQ(status_.position_source, before.position_source);
    EXPECT_LT((place() - p_before).norm(), 0.01);
    EXPECT_NEAR(status_.tilt_x_rad, before.tilt_x_rad, 1e-4);
    set_faults({}, {});
    EXPECT_TRUE(is_quiet());
    EXPECT_TRUE(time_.pass(60.0, [&] {
      return std::abs(status_.position_sd_m[0] - before.position_sd_m[0]) < 0.005;
    }));
  }
}

INSTANTIATE_TEST_SUITE_P(SurveyedOrNot, StationSensors, testing::Bool());

}  // namespace
}  // namespace ols::station
