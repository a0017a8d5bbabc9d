// Messages are taken as gpsd 3.22 wrote them, read by libgps itself.
#include "edge/sensors/gpsd/gnss_from_gpsd.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <random>

#include "geometry/angles.h"

namespace ols::sensors {
namespace {

std::string tpv(const std::string& status, const std::string& second = "05.480",
                const std::string& errors = "\"epv\":23.000,\"eph\":13.300,") {
  return R"({"class":"TPV","device":"/dev/pts/0",)" + status +
         R"("mode":3,"time":"2026-11-21T03:15:)" + second +
         R"(Z","ept":0.005,"lat":49.226600000,"lon":16.596900000,"altHAE":310.0000,)"
         R"("altMSL":266.0000,"alt":266.0000,)" +
         errors + R"("geoidSep":44.000,"sep":22.800,"dgpsAge":1.0,"dgpsSta":1})";
}

std::string gst(const std::string& second = "05.480") {
  return R"({"class":"GST","device":"/dev/pts/0","time":"2026-11-21T03:15:)" + second +
         R"(Z","rms":0.020,"major":0.012,"minor":0.011,"orient":10.000,)"
         R"("lat":0.012,"lon":0.010,"alt":0.020})";
}

class Gpsd {
 public:
  const gps_data_t& says(std::string message) {
    data_->set = 0;
    gps_unpack(message.data(), data_.get());
    return *data_;
  }

 private:
  std::unique_ptr<gps_data_t> data_ = std::make_unique<gps_data_t>();
};

GnssFix fix_of(const std::string& status) {
  Gpsd gpsd;
  return gnss_from_gpsd(gpsd.says(tpv(status)), std::nullopt, 1.0).fix;
}

TEST(GnssFromGpsd, ThreeIsRtkFixedAndFourIsFloat) {
  EXPECT_EQ(fix_of("\"status\":3,"), GnssFix::kRtkFixed);
  EXPECT_EQ(fix_of("\"status\":4,"), GnssFix::kRtkFloat);
  EXPECT_EQ(fix_of("\"status\":2,"), GnssFix::kDifferential);
  EXPECT_EQ(fix_of("\"status\":1,"), GnssFix::k3D);
  EXPECT_EQ(fix_of(""), GnssFix::k3D);  // gpsd need not say
}

TEST(GnssFromGpsd, WhatIsNotMeasuredIsNoFix) {
  for (const char* status : {"\"status\":5,", "\"status\":7,", "\"status\":8,"}) {
    EXPECT_EQ(fix_of(status), GnssFix::kNone) << status;
  }
}

TEST(GnssFromGpsd, HeightIsAboveTheEllipsoid) {
  Gpsd gpsd;
  const auto reading = gnss_from_gpsd(gpsd.says(tpv("\"status\":3,")), std::nullopt, 7.5);
  EXPECT_NEAR(degrees(reading.antenna.latitude_rad), 49.2266, 1e-12);
  EXPECT_NEAR(degrees(reading.antenna.longitude_rad), 16.5969, 1e-12);
  EXPECT_EQ(reading.antenna.height_m, 310.0);
  EXPECT_EQ(reading.time_s, 7.5);
}

TEST(GnssFromGpsd, GpsdsOwnErrorsAreTakenAsTheCallerSays) {
  Gpsd gpsd;
  const auto& data = gpsd.says(tpv(""));
  const auto cautious = gnss_from_gpsd(data, std::nullopt, 1.0);
  EXPECT_NEAR(cautious.sd_enu_m.x(), 13.3 / std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(cautious.sd_enu_m.z(), 23.0, 1e-9);
  const auto two_sigma = gnss_from_gpsd(data, std::nullopt, 1.0, 2.0);
  EXPECT_NEAR(two_sigma.sd_enu_m.z(), 11.5, 1e-9);
  const std::string axes = "\"epx\":4.0,\"epy\":6.0,\"epv\":8.0,";
  const auto each = gnss_from_gpsd(gpsd.says(tpv("", "05.480", axes)), std::nullopt, 1.0);
  EXPECT_EQ(each.sd_enu_m, Eigen::Vector3d(4.0, 6.0, 8.0));
}

TEST(GnssFromGpsd, WithoutErrorsOrHeightItIsNoPositionInSpace) {
  Gpsd gpsd;
  EXPECT_EQ(gnss_from_gpsd(gpsd.says(tpv("", "05.480", "")), std::nullopt, 1.0).fix, GnssFix::k2D);
  std::string no_height = tpv("");
  no_height.replace(no_height.find("altHAE"), 6, "magvar");
  EXPECT_EQ(gnss_from_gpsd(gpsd.says(no_height), std::nullopt, 1.0).fix, GnssFix::k2D);
}

TEST(GnssFromGpsd, NoFixIsToldAsSuch) {
  Gpsd gpsd;
  const auto& data = gpsd.says(R"({"class":"TPV","device":"/dev/pts/0","mode":1})");
  EXPECT_EQ(gnss_from_gpsd(data, std::nullopt, 1.0).fix, GnssFix::kNone);
}

TEST(GnssFromGpsd, NothingInTheStructureMakesAReadingThatIsNotFinite) {
  std::mt19937 random(3);
  const double odd[] = {
      std::nan(""), std::numeric_limits<double>::infinity(), -1e300, 1e300, -1.0, 0.0, 45.0};
  const auto any = [&] { return odd[random() % std::size(odd)]; };
  auto data = std::make_unique<gps_data_t>();
  for (int round = 0; round < 20000; ++round) {
    gps_fix_t& fix = data->fix;
    fix.mode = static_cast<int>(random() % 6) - 1;
    fix.status = static_cast<int>(random() % 12) - 1;
    fix.latitude = any(), fix.longitude = any(), fix.altHAE = any();
    fix.epx = any(), fix.epy = any(), fix.epv = any(), fix.eph = any();
    data->satellites_used = static_cast<int>(random());
    const auto reading = gnss_from_gpsd(*data, std::nullopt, 1.0);
    EXPECT_GE(reading.satellites_used, 0);
    if (reading.fix < GnssFix::k3D) continue;
    EXPECT_TRUE(reading.sd_enu_m.allFinite() && (reading.sd_enu_m.array() > 0.0).all());
    EXPECT_LE(std::abs(reading.antenna.latitude_rad), radians(90.0));
    EXPECT_LE(std::abs(reading.antenna.longitude_rad), kPi);
    EXPECT_TRUE(std::isfinite(reading.antenna.height_m));
  }
}

TEST(GpsdEpochs, AFixTakesTheReceiversOwnErrorsOfItsEpoch) {
  Gpsd gpsd;
  GpsdEpochs epochs;
  epochs.take(gpsd.says(tpv("\"status\":3,")), 1.0);
  EXPECT_TRUE(epochs.take_readings(1.0).empty());
  epochs.take(gpsd.says(gst()), 1.1);
  const auto out = epochs.take_readings(1.1);
  ASSERT_EQ(out.size(), 1U);
  EXPECT_EQ(out[0].sd_enu_m, Eigen::Vector3d(0.010, 0.012, 0.020));
  EXPECT_EQ(out[0].time_s, 1.0);
}

TEST(GpsdEpochs, TheErrorsMayComeFirst) {
  Gpsd gpsd;
  GpsdEpochs epochs;
  epochs.take(gpsd.says(gst()), 1.0);
  epochs.take(gpsd.says(tpv("\"status\":3,", "05.480", "")), 1.1);
  const auto out = epochs.take_readings(1.1);
  ASSERT_EQ(out.size(), 1U);
  EXPECT_EQ(out[0].fix, GnssFix::kRtkFixed);
  EXPECT_EQ(out[0].sd_enu_m.x(), 0.010);
}

// An RTK fix that is lost must not go on with the centimetres of the epoch before.
TEST(GpsdEpochs, ErrorsOfAnotherEpochAreNotUsed) {
  Gpsd gpsd;
  GpsdEpochs epochs;
  epochs.take(gpsd.says(gst("05.480")), 1.0);
  epochs.take(gpsd.says(tpv("", "05.730")), 1.2);
  EXPECT_TRUE(epochs.take_readings(1.3).empty());
  const auto out = epochs.take_readings(1.6);  // long enough
  ASSERT_EQ(out.size(), 1U);
  EXPECT_GT(out[0].sd_enu_m.x(), 5.0);
}

TEST(GpsdEpochs, TheNextFixReleasesTheOneBefore) {
  Gpsd gpsd;
  GpsdEpochs epochs;
  epochs.take(gpsd.says(tpv("\"status\":4,", "05.480")), 1.00);
  epochs.take(gpsd.says(tpv("\"status\":3,", "05.580")), 1.10);
  const auto out = epochs.take_readings(1.1);
  ASSERT_EQ(out.size(), 1U);
  EXPECT_EQ(out[0].fix, GnssFix::kRtkFloat);
}

}  // namespace
}  // namespace ols::sensors
