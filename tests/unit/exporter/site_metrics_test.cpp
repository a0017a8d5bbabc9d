#include "tools/exporter/site_metrics.h"

#include <gtest/gtest.h>
#include <prometheus/text_serializer.h>

#include <limits>
#include <set>

#include "conditions/alarm.h"
#include "conditions/alarms.h"
#include "ols_msg/bearing_t.hpp"

namespace ols::exporter {
namespace {

using Station = ols_msg::station_status_t;

Station status_of(const std::string& id) {
  Station s{};
  s.station = id;
  s.utime = 1'700'000'000'000'000;
  s.state = Station::STATE_TRACKING;
  s.clock_state = ols_msg::bearing_t::CLOCK_SYNCHRONISED;
  s.clock_error_s = 2e-4;
  s.frame_latency_s = 0.03;
  s.calibration_state = Station::CALIBRATION_IN_USE;
  s.calibration_utime = s.utime - 60'000'000;
  s.device_name = {"camera", "ptu", "software"};
  s.device_state = {Station::DEVICE_OK, Station::DEVICE_FAULT, Station::DEVICE_OK};
  s.device_text = {"Mako", "no reply", "0.1.0"};
  s.last_error = "ptu: no reply";
  s.last_error_utime = s.utime - 30'000'000;
  s.reading_name = {"disk_free_bytes"};
  s.reading_value = {5e9};
  s.counter_name = {"bearings"};
  s.counter_value = {1234.0};
  set_alarms({alarm::station_clock_error("s9", 3.0)}, s);
  return s;
}

std::string text(const SiteMetrics& metrics, double now_s) {
  return prometheus::TextSerializer().Serialize(metrics.families(now_s));
}

bool has_line(const std::string& text, const std::string& line) {
  return ("\n" + text).find("\n" + line + "\n") != std::string::npos;
}

TEST(SiteMetrics, AStationIsToldInBaseUnits) {
  SiteMetrics metrics("1.2");
  metrics.receive(status_of("alfa"), 100.0);
  const std::string told = text(metrics, 103.0);
  for (const char* line :
       {"ols_build_info{version=\"1.2\"} 1", "ols_station_status_age_seconds{station=\"alfa\"} 3",
        "ols_station_state{station=\"alfa\",state=\"tracking\"} 1",
        "ols_alarm{program=\"station\",station=\"alfa\",alarm=\"station_clock_error\",severity="
        "\"urgent\",says=\"station s9: not used, it reports a clock error of … s\",action=\"check "
        "that station's time service\"} 1",
        "ols_station_clock_synchronised{station=\"alfa\"} 1",
        "ols_station_calibration_age_seconds{station=\"alfa\"} 60",
        "ols_station_device_up{station=\"alfa\",device=\"camera\"} 1",
        "ols_station_device_up{station=\"alfa\",device=\"ptu\"} 0",
        "ols_station_build_info{station=\"alfa\",version=\"0.1.0\"} 1",
        "ols_station_last_error_age_seconds{station=\"alfa\"} 30",
        "ols_station_events_total{station=\"alfa\",event=\"bearings\"} 1234"}) {
    EXPECT_TRUE(has_line(told, line)) << line << "\n" << told;
  }
  EXPECT_EQ(told.find("device=\"software\""), std::string::npos);
  EXPECT_NE(told.find("reading=\"disk_free_bytes\"} 5000000000"), std::string::npos) << told;
}

TEST(SiteMetrics, AnyTwoTimesHaveADifference) {
  SiteMetrics metrics("1");
  Station s = status_of("alfa");
  s.utime = std::numeric_limits<std::int64_t>::min();
  s.calibration_utime = std::numeric_limits<std::int64_t>::max();
  metrics.receive(s, 1.0);
  const std::string told = text(metrics, 1.0);
  EXPECT_NE(told.find("ols_station_calibration_age_seconds{station=\"alfa\"} -"), std::string::npos)
      << told;
}

TEST(SiteMetrics, TheFusionAndWhatWasNotBelievedAreTold) {
  SiteMetrics metrics("1");
  ols_msg::fusion_status_t fusion{};
  fusion.station = {"alfa", "bravo"};
  fusion.bearings = {7, 9};
  fusion.rate_hz = {12.0, 11.0};
  fusion.residual = {1.0, std::numeric_limits<double>::quiet_NaN()};
  fusion.quarantine = {"", "clock"};
  fusion.counter_name = {"targets"};
  fusion.counter_value = {5.0};
  metrics.receive(fusion, 10.0);
  metrics.hear_distrusted({{"unsigned", 3.0}});
  const std::string told = text(metrics, 10.5);
  for (const char* line :
       {"ols_fusion_status_age_seconds 0.5", "ols_bearings_total{station=\"alfa\"} 7",
        "ols_station_quarantined{station=\"bravo\"} 1",
        "ols_station_quarantined{station=\"alfa\"} 0",
        "ols_fusion_events_total{event=\"targets\"} 5",
        "ols_bus_distrusted_total{reason=\"unsigned\"} 3"}) {
    EXPECT_TRUE(has_line(told, line)) << line << "\n" << told;
  }
}

// What a sender names must neither fill the memory nor break a line.
TEST(SiteMetrics, NamesAreBoundedAndQuoted) {
  SiteMetrics metrics("1");
  Station mad = status_of("al\"fa\n\\");
  mad.reading_name.assign(5000, "x");
  mad.reading_value.assign(5000, 1.0);
  metrics.receive(mad, 1.0);
  const std::string told = text(metrics, 1.0);
  EXPECT_NE(told.find("station=\"al\\\"fa\\n\\\\\""), std::string::npos) << told;
  std::size_t readings = 0;
  for (std::size_t at = 0; (at = told.find("\nols_station_reading{", at)) != std::string::npos;
       ++at)
    ++readings;
  EXPECT_EQ(readings, SiteMetrics::kMostNames);
  for (std::size_t i = 0; i < 2 * SiteMetrics::kMostStations; ++i) {
    metrics.receive(status_of(std::string("s").append(std::to_string(i))), 2.0);
  }
  std::set<std::string> stations;
  for (const auto& family : metrics.families(2.0)) {
    if (family.name != "ols_station_frame_latency_seconds") continue;
    for (const auto& metric : family.metric) stations.insert(metric.label[0].value);
  }
  EXPECT_EQ(stations.size(), SiteMetrics::kMostStations);
}

TEST(SiteMetrics, AnEnrolledStationIsToldBeforeItIsHeardAndUntilItIsRevoked) {
  const std::string alfa = "ols_station_enrolled{station=\"alfa\"} 1";
  SiteMetrics metrics("1");
  metrics.know({"alfa", "bravo"});
  EXPECT_TRUE(has_line(text(metrics, 0.0), alfa));
  EXPECT_EQ(text(metrics, 0.0).find("ols_station_status_age"), std::string::npos);
  metrics.receive(status_of("alfa"), 0.0);
  metrics.receive(status_of("bravo"), SiteMetrics::kForget_s + 1.0);
  EXPECT_TRUE(has_line(text(metrics, SiteMetrics::kForget_s + 1.0), alfa)) << "though forgotten";
  metrics.know({"alfa"});
  EXPECT_EQ(text(metrics, 0.0).find("\"bravo\""), std::string::npos);
  EXPECT_TRUE(has_line(text(metrics, 0.0), alfa));
}

TEST(SiteMetrics, ASilentStationIsForgottenAfterADay) {
  SiteMetrics metrics("1");
  metrics.receive(status_of("alfa"), 0.0);
  metrics.receive(status_of("bravo"), SiteMetrics::kForget_s - 1.0);
  EXPECT_NE(text(metrics, 0.0).find("\"alfa\""), std::string::npos);
  metrics.receive(status_of("bravo"), SiteMetrics::kForget_s + 1.0);
  EXPECT_EQ(text(metrics, 0.0).find("\"alfa\""), std::string::npos);
}

}  // namespace
}  // namespace ols::exporter
