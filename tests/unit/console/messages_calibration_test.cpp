#include "console/messages_calibration.h"

#include <gtest/gtest.h>

#include <limits>

#include "console/messages.h"
#include "geometry/angles.h"
#include "tests/unit/on_the_bus.h"

namespace ols::console {
namespace {

TEST(ConsoleCalibration, OfAStation) {
  auto status = made<ols_msg::station_status_t>();
  status.station = "alfa";
  status.calibration_sd_rad = std::numeric_limits<double>::quiet_NaN();
  const auto said = [&status] {
    return station_from(on("OLS_STATUS_alfa", status))->fields.at("calibration");
  };
  EXPECT_EQ(said(), Json::parse(R"({"state": "none", "id": "0", "utime_us": null,
                                    "sd_deg": null})"));
  status.calibration_state = ols_msg::station_status_t::CALIBRATION_IN_USE;
  status.calibration_id = -6'917'529'027'641'081'856;  // no browser's number holds it
  status.calibration_utime = 1'780'000'000'000'000;
  status.calibration_sd_rad = radians(0.003);
  EXPECT_EQ(said(), Json::parse(R"({"state": "in use", "id": "-6917529027641081856",
                                    "utime_us": 1780000000000000, "sd_deg": 0.003})"));
  status.calibration_state = ols_msg::station_status_t::CALIBRATION_DOUBTED;
  EXPECT_EQ(said().at("state"), "doubted");
  status.calibration_state = ols_msg::station_status_t::CALIBRATION_REFUSED;
  EXPECT_EQ(said().at("state"), "refused");
}

TEST(ConsoleCalibration, OfTheStationsOfAFusion) {
  auto status = made<ols_msg::fusion_status_t>();
  status.stations = 2;
  status.station = {"alfa", "bravo"};
  status.bearings = {1, 1};
  status.rate_hz = status.age_s = status.residual = status.clock_offset_s = {1.0, 1.0};
  status.clock_found_s = status.clock_found_sd_s = {0.0, 0.0};
  status.bias_rad = status.bias_sd_rad = {{0.0, 0.0}, {0.0, 0.0}};
  status.quarantine = {"", ""};
  status.calibration_state = {ols_msg::station_status_t::CALIBRATION_DOUBTED,
                              ols_msg::station_status_t::CALIBRATION_NONE};
  status.calibration_utime = {1'780'000'000'000'000, 0};
  status.calibration_sd_rad = {radians(0.01), std::numeric_limits<double>::quiet_NaN()};
  const auto stations = fusion_from(on("OLS_FUSION_STATUS", status))->fields.at("stations");
  EXPECT_EQ(stations.at(0).at("calibration"),
            Json::parse(R"({"state": "doubted", "utime_us": 1780000000000000, "sd_deg": 0.01})"));
  EXPECT_EQ(stations.at(1).at("calibration"),
            Json::parse(R"({"state": "none", "utime_us": null, "sd_deg": null})"));
}

}  // namespace
}  // namespace ols::console
