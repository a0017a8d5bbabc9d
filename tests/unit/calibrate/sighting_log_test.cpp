#include "tools/calibrate/sighting_log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "base/bus/channel_names.h"
#include "ols_msg/bearing_t.hpp"
#include "ols_msg/sighting_t.hpp"
#include "tests/unit/base/bus/log_file.h"
#include "tests/unit/calibration/scene.h"

namespace ols::calibration {
namespace {

using Message = ols_msg::sighting_t;

Message sighting(const std::string& station = "alfa") {
  Message message{};
  message.schema_version = Message::SCHEMA_VERSION;
  message.utime = kStart_us;
  message.station = station;
  message.belief = 0.9;
  message.track_id = 4;
  message.pan_counts = 1000.5;
  message.approach_pan = message.approach_tilt = 1;
  message.pan_count_rad = message.tilt_count_rad = 11.5714 * test::kArcsec;
  message.covariance_px2[0] = message.covariance_px2[2] = 0.09;
  message.clock_state = ols_msg::bearing_t::CLOCK_SYNCHRONISED;
  message.clock_error_s = 1e-3;
  return message;
}

std::string record(const Message& message, const std::string& channel = "OLS_SIGHTING_alfa") {
  return log_record(kStart_us, channel, payload_of(message));
}

SightingLog told(const std::string& bytes) {
  const LogFile log(bytes);
  return read_sightings({{log.path()}, 0.5}, {"alfa"}, {test::prior_of(test::hill())});
}

TEST(SightingLog, ReadsWhatAStationTells) {
  const SightingLog log = told(record(sighting()));
  ASSERT_EQ(log.sightings.size(), 1U);
  EXPECT_EQ(log.sightings[0].reading.pan.counts, 1000.5);
  EXPECT_EQ(log.sightings[0].track_id, 4);
  EXPECT_NEAR(log.sightings[0].sd_px, 0.3, 1e-9);
}

TEST(SightingLog, CountsWhatItDoesNotUse) {
  Message wrong_schema = sighting(), no_number = sighting(), no_clock = sighting(),
          doubtful = sighting();
  wrong_schema.schema_version = 77;
  no_number.x_px = std::nan("");
  no_clock.clock_state = ols_msg::bearing_t::CLOCK_UNSYNCHRONISED;
  doubtful.belief = 0.2;
  const SightingLog log =
      told(record(wrong_schema) + record(no_number) + record(no_clock) + record(doubtful) +
           record(sighting("bravo"), "OLS_SIGHTING_bravo") + record(sighting("bravo")) +
           log_record(kStart_us, "OLS_SIGHTING_alfa", "no message") + record(sighting()));
  EXPECT_EQ(log.sightings.size(), 1U);
  EXPECT_EQ(log.unusable, 4U);
  EXPECT_EQ(log.unsynchronised, 1U);
  EXPECT_EQ(log.disbelieved, 1U);
  EXPECT_EQ(log.of_others, 1U);
  ASSERT_EQ(log.damage.size(), 1U);
  EXPECT_NE(log.damage[0].find(": 4 messages are damaged or of another version of OLS, the first, "
                               "of OLS_SIGHTING_alfa, is at byte 0"),
            std::string::npos)
      << log.damage[0];
}

TEST(SightingLog, TellsHowFarItIsInAllRecordings) {
  const std::string one = record(sighting());
  const LogFile first(one), second(one + one);
  std::vector<std::pair<std::size_t, std::size_t>> told;
  read_sightings({{first.path(), second.path()}, 0.5}, {"alfa"}, {test::prior_of(test::hill())},
                 [&](std::size_t done, std::size_t all) { told.emplace_back(done, all); });
  const std::size_t size = one.size();
  EXPECT_EQ(told, (std::vector<std::pair<std::size_t, std::size_t>>{
                      {size, 3 * size}, {2 * size, 3 * size}, {3 * size, 3 * size}}));
}

TEST(SightingLog, OfAUnitThatCountsOtherwiseNothingIsUsed) {
  Message message = sighting();
  message.pan_count_rad *= 2.0;
  EXPECT_THAT([&] { told(record(message)); },
              testing::ThrowsMessage<std::runtime_error>(
                  testing::HasSubstr("'alfa': its unit counts otherwise")));
}

}  // namespace
}  // namespace ols::calibration
