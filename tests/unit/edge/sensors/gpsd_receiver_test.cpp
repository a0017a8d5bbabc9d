// The receiver's thread on a real gpsd that reads a simulated receiver. Function only: deadlines
// are generous, and nothing is judged by how long it took.
#include "edge/sensors/gpsd/gpsd_receiver.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <memory>
#include <optional>

#include "geometry/angles.h"
#include "sim/sensors/gnss_line.h"
#include "tests/unit/edge/sensors/gpsd_process.h"
#include "tests/unit/eventually.h"
#include "tests/unit/temp_dir.h"

namespace ols::sensors {
namespace {

const Geodetic kAntenna{radians(49.2266), radians(-16.5969), 311.9};

sim::GnssLineConfig receiver() {
  sim::GnssLineConfig c;
  c.antenna = kAntenna;
  c.rate_hz = 5.0;
  return c;
}

GpsdConfig config(const std::string& port) {
  GpsdConfig c;
  c.host = "127.0.0.1";
  c.port = port;
  c.stale_s = 1.5;
  return c;
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

class GnssOnGpsd : public testing::Test {
 protected:
  void SetUp() override {
    if (!GpsdProcess::is_installed()) GTEST_SKIP() << "gpsd is not installed";
  }

  // The last of the readings so far for which it holds.
  bool comes(Gnss& gnss, const std::function<bool(const GnssReading&)>& condition) {
    return eventually([&] {
      for (const GnssReading& r : gnss.take_readings()) {
        if (condition(r)) last_ = r;
      }
      return last_ && condition(*last_);
    });
  }
  static bool reports(const Gnss& gnss, device::DeviceState state, const std::string& text) {
    return eventually([&] {
      const device::DeviceReport r = gnss.report();
      return r.state == state && has(r.text, text);
    });
  }

  const std::string port_ = GpsdProcess::free_port();
  sim::GnssLine line_{receiver(), clock_utime_us, 5};
  std::optional<GnssReading> last_;
};

TEST_F(GnssOnGpsd, GivesTheAntennaWithTheReceiversOwnErrors) {
  const GpsdProcess gpsd(line_.device(), port_);
  GpsdReceiver gnss(config(port_));
  // Also once all satellites have been told of.
  ASSERT_TRUE(comes(gnss, [](const GnssReading& r) {
    return r.fix == GnssFix::kRtkFixed && r.satellites_used == 14 && r.sd_enu_m.x() < 1.0;
  }));
  const LocalFrame frame(kAntenna);
  const Eigen::Vector3d error_enu_m = frame.to_enu(ecef_from_geodetic(last_->antenna));
  EXPECT_LT(error_enu_m.norm(), 0.1);
  EXPECT_NEAR(last_->sd_enu_m.x(), 0.010, 1e-6);
  EXPECT_NEAR(last_->sd_enu_m.z(), 0.015, 1e-6);
  const device::DeviceReport report = gnss.report();
  EXPECT_EQ(report.state, device::DeviceState::kOk);
  EXPECT_EQ(report.text, "RTK fixed, 14 satellites, 0.015 m");
  EXPECT_EQ(report.readings.at("gnss_satellites"), 14.0);
  EXPECT_NEAR(report.readings.at("gnss_sd_m"), 0.015, 1e-6);
  EXPECT_GT(report.counters.at("gnss_reports"), 0U);
  EXPECT_TRUE(report.alarms.empty());
}

TEST_F(GnssOnGpsd, ALostFixAndASilentReceiverAreToldAndHeal) {
  const GpsdProcess gpsd(line_.device(), port_);
  GpsdReceiver gnss(config(port_));
  ASSERT_TRUE(reports(gnss, device::DeviceState::kOk, "RTK fixed"));
  sim::GnssFaults faults;
  faults.no_fix = true;
  line_.set_faults(faults);
  ASSERT_TRUE(reports(gnss, device::DeviceState::kFault, "no fix"));
  EXPECT_GE(gnss.report().errors, 1U);
  line_.set_faults({});
  ASSERT_TRUE(reports(gnss, device::DeviceState::kOk, "RTK fixed"));
  faults = {};
  faults.silent = true;
  line_.set_faults(faults);
  ASSERT_TRUE(reports(gnss, device::DeviceState::kFault, "the receiver sends nothing"));
  line_.set_faults({});
  ASSERT_TRUE(reports(gnss, device::DeviceState::kOk, "RTK fixed"));
}

TEST_F(GnssOnGpsd, AJumpComesThrough) {
  const GpsdProcess gpsd(line_.device(), port_);
  GpsdReceiver gnss(config(port_));
  sim::GnssFaults faults;
  faults.jump_m = 100.0;
  line_.set_faults(faults);
  const LocalFrame frame(kAntenna);
  EXPECT_TRUE(comes(gnss, [&](const GnssReading& r) {
    return r.fix == GnssFix::kRtkFixed &&
           std::abs(frame.to_enu(ecef_from_geodetic(r.antenna)).x() - 100.0) < 0.1;
  }));
}

TEST_F(GnssOnGpsd, GarbledSentencesAreLeftOut) {
  const GpsdProcess gpsd(line_.device(), port_);
  GpsdReceiver gnss(config(port_));
  sim::GnssFaults faults;
  faults.garble_share = 0.2;
  line_.set_faults(faults);
  const LocalFrame frame(kAntenna);
  int fixes = 0;
  EXPECT_TRUE(eventually([&] {
    for (const GnssReading& r : gnss.take_readings()) {
      if (r.fix < GnssFix::k3D) continue;
      ++fixes;
      EXPECT_LT(frame.to_enu(ecef_from_geodetic(r.antenna)).norm(), 1.0);
    }
    return fixes > 10;
  }));
}

TEST_F(GnssOnGpsd, AGpsdThatIsNotThereOrGoesIsToldAndFoundAgain) {
  GpsdReceiver gnss(config(port_));
  ASSERT_TRUE(reports(gnss, device::DeviceState::kAbsent, "no gpsd at 127.0.0.1:" + port_));
  EXPECT_FALSE(gnss.report().alarms.empty());
  {
    const GpsdProcess gpsd(line_.device(), port_);
    ASSERT_TRUE(reports(gnss, device::DeviceState::kOk, "RTK fixed"));
  }
  ASSERT_TRUE(reports(gnss, device::DeviceState::kAbsent, "gpsd"));
  const GpsdProcess gpsd(line_.device(), port_);
  ASSERT_TRUE(reports(gnss, device::DeviceState::kOk, "RTK fixed"));
  EXPECT_GE(gnss.report().counters.at("gnss_reconnects"), 1U);
}

TEST_F(GnssOnGpsd, AGpsdWithoutReceiverIsToldFromOneThatIsNotThere) {
  const GpsdProcess gpsd("", port_);
  GpsdReceiver gnss(config(port_));
  ASSERT_TRUE(reports(gnss, device::DeviceState::kAbsent, "gpsd has no receiver"));
  EXPECT_EQ(gnss.report().alarms.size(), 1U);
}

TEST_F(GnssOnGpsd, AReceiverThatIsPulledOutIsToldAndGpsdIsLeftAlone) {
  const std::string link = temp_dir() + "ols_gnss_" + std::to_string(::getpid());
  auto line = std::make_unique<sim::GnssLine>(receiver(), clock_utime_us, 6, link);
  const GpsdProcess gpsd(link, port_);
  GpsdReceiver gnss(config(port_));
  ASSERT_TRUE(reports(gnss, device::DeviceState::kOk, "RTK fixed"));
  line.reset();
  // Longer than it would wait for a receiver that is there and says nothing.
  ASSERT_TRUE(
      reports(gnss, device::DeviceState::kAbsent, "the receiver's device is missing for 7 s"));
  EXPECT_EQ(gnss.report().counters.at("gnss_reconnects"), 0U);
}

TEST(Gnss, WithoutAHostThereIsNone) {
  GpsdReceiver gnss(GpsdConfig{});
  EXPECT_TRUE(gnss.take_readings().empty());
  EXPECT_EQ(gnss.report().state, device::DeviceState::kAbsent);
  EXPECT_EQ(gnss.report().text, "not configured");
  EXPECT_TRUE(gnss.report().alarms.empty());
}

}  // namespace
}  // namespace ols::sensors
