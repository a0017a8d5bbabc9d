#include "tools/calibrate/rectify.h"

#include <gtest/gtest.h>

#include <fstream>

#include "base/config/toml_config.h"
#include "tests/unit/calibrate/bus_station.h"
#include "tests/unit/temporary_folder.h"
#include "tools/calibrate/target_file.h"

namespace ols::calibration {
namespace {

using Status = ols_msg::station_status_t;

class RectifyTest : public testing::Test {
 protected:
  RectifyTest() {
    files_.config = "alfa.toml";
    files_.settings.id = "alfa";
    files_.settings.pose.surveyed_position.emplace();
    CameraIntrinsics& camera = files_.settings.station.geometry.camera;
    camera.width_px = 640;
    camera.height_px = 480;
    camera.fx_px = camera.fy_px = 5000.0;
    files_.instrument = new_instrument(files_.settings);
    options_.name = "rectify";
    options_.targets = folder_.path() + "/workshop.toml";
    std::ofstream(options_.targets) << "[cross]\ndistance_m = 25\n[level_line]\n";
  }

  Procedure make(std::int8_t tilt_source) {
    Status status{};
    status.schema_version = Status::SCHEMA_VERSION;
    status.station = "alfa";
    status.utime = status.boot_id = 1;
    status.sequence = ++sequence_;
    status.pan_rad = 0.3;
    status.tilt_source = tilt_source;
    status.tilt_x_rad = 0.001;
    status.tilt_y_rad = -0.002;
    status.tilt_sd_rad = 2e-4;
    station_.bus.publish(station_channel(kStatusChannel, "alfa"), status);
    while (station_.bus.handle(0) > 0) {
    }
    return make_rectification(options_, files_, link_, session_);
  }

  TemporaryFolder folder_;
  test::BusStation station_;
  StationLink link_{station_.bus, "alfa"};
  ProcedureSession session_{folder_.path(), "alfa"};
  StationFiles files_;
  ProcedureOptions options_;
  std::int64_t sequence_ = 0;
};

TEST_F(RectifyTest, EachTargetOfTheFileIsAskedForFromWhereTheUnitStands) {
  const Procedure procedure = make(Status::POSE_SENSOR);
  std::vector<std::string> steps;
  while (const auto order = procedure.field->next()) {
    EXPECT_EQ(order->shot.angles.pan_rad, 0.3);
    steps.push_back(order->step);
    procedure.field->not_taken("no camera");
  }
  EXPECT_EQ(steps, (std::vector<std::string>{"level line: driving there", "cross: driving there"}));
}

// The session's observations are written anew after each step.
TEST_F(RectifyTest, TheStationsOwnLevelIsAmongWhatWasObserved) {
  const Procedure procedure = make(Status::POSE_SENSOR);
  const std::vector<Observation> all = procedure.field->observations();
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].kind, Kind::kInclinometer);
  EXPECT_EQ(all[0].tilt_rad, Eigen::Vector2d(0.001, -0.002));
  EXPECT_EQ(all[0].zero_sd_rad, 2e-4);
  EXPECT_TRUE(make(Status::POSE_NONE).field->observations().empty());
}

TEST_F(RectifyTest, ItsFolderHoldsTheTargetsAndCannotBeGoneOnWith) {
  make(Status::POSE_SENSOR);
  EXPECT_EQ(read_targets(folder_.path() + "/targets.toml").cross->distance_m, 25.0);
  EXPECT_FALSE(std::filesystem::exists(session_.folder() / kSessionFile));
}

TEST_F(RectifyTest, AWrongTargetIsNamedBeforeAnythingMoves) {
  std::ofstream(options_.targets) << "[cross]\n";
  EXPECT_THROW(make(Status::POSE_SENSOR), ConfigError);
}

}  // namespace
}  // namespace ols::calibration
