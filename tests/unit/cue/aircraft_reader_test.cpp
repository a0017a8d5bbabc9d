#include "cue/aircraft_reader.h"

#include <gtest/gtest.h>

namespace ols::cues {
namespace {

constexpr std::int64_t kNow_us = 1'795'428'930'000'000;

std::string file(const std::string& aircraft) {
  return R"({"now": 1795428930.0, "messages": 1, "aircraft": [)" + aircraft + "]}";
}

const Report& report(const Readings& readings, std::size_t index = 0) {
  return std::get<Report>(readings.at(index));
}

Refusal refusal(const Reading& reading) { return std::get<Refused>(reading).why; }

TEST(AircraftReader, AnAircraftWithAPlaceIsRead) {
  const Readings found = aircraft_json_readings(
      file(R"({"hex": "3c6444", "flight": "DLH9LF  ", "lat": 49.2, "lon": 16.6, "seen_pos": 1.5,)"
           R"( "alt_geom": 10000, "alt_baro": 9000, "nac_p": 9, "gs": 100.0, "track": 90.0,)"
           R"( "geom_rate": 600}, {"hex": "aaaaaa", "seen": 3})"));
  ASSERT_EQ(found.size(), 1U) << "one without a place is nothing to speak of";
  const Report& one = report(found);
  EXPECT_EQ(one.name, "3c6444");
  EXPECT_EQ(one.label, "DLH9LF");
  EXPECT_EQ(one.utime_us, kNow_us - 1'500'000);
  EXPECT_NEAR(one.height_m, 3048.0, 1e-9);
  EXPECT_FALSE(one.is_pressure_height);
  EXPECT_NEAR(one.horizontal_sd_m.value_or(0.0), 30.0 / 2.45, 1e-9);
  ASSERT_TRUE(one.velocity_enu_m_s);
  EXPECT_NEAR((*one.velocity_enu_m_s)[0], 51.444, 1e-3);
  EXPECT_NEAR((*one.velocity_enu_m_s)[1], 0.0, 1e-9);
  EXPECT_NEAR((*one.velocity_enu_m_s)[2], 3.048, 1e-9);
}

TEST(AircraftReader, AHeightByPressureSaysSoAndNoneIsRefused) {
  const Readings found = aircraft_json_readings(
      file(R"({"hex": "1", "lat": 1, "lon": 1, "seen_pos": 0, "alt_baro": 1000},)"
           R"({"hex": "2", "lat": 1, "lon": 1, "seen_pos": 0, "alt_baro": "ground"},)"
           R"({"lat": 1, "lon": 1, "seen_pos": 0, "alt_baro": 1000}, 7)"));
  ASSERT_EQ(found.size(), 4U);
  EXPECT_TRUE(report(found).is_pressure_height);
  EXPECT_FALSE(report(found).horizontal_sd_m) << "no category: the configuration's";
  EXPECT_EQ(refusal(found[1]), Refusal::kNoHeight);
  EXPECT_EQ(refusal(found[2]), Refusal::kMalformed);
  EXPECT_EQ(refusal(found[3]), Refusal::kMalformed);
}

TEST(AircraftReader, AFileOfSomethingElseIsMalformed) {
  for (const char* text : {"", "[]", "{}", R"({"now": "x", "aircraft": []})",
                           R"({"now": 1, "aircraft": {}})", R"({"now": 1e300, "aircraft": []})"}) {
    const Readings found = aircraft_json_readings(text);
    ASSERT_EQ(found.size(), 1U) << text;
    EXPECT_EQ(refusal(found[0]), Refusal::kMalformed) << text;
  }
}

TEST(AircraftReader, AFileOfMoreAircraftThanFlyIsReadInPart) {
  std::string rubbish = "0";
  for (int i = 1; i < 100'000; ++i) rubbish += ",0";
  const Readings found = aircraft_json_readings(file(rubbish));
  ASSERT_EQ(found.size(), 1001U);
  EXPECT_EQ(refusal(found.back()), Refusal::kTooMany);
}

TEST(SbsReader, ACallSignIsNotLongerThanOneCanBe) {
  SbsReader reader;
  reader.take("MSG,1,1,1,3C6444,1,,,,," + std::string(60'000, 'A') + ",,,,,,,,,,,", kNow_us);
  const Readings found =
      reader.take("MSG,3,1,1,3C6444,1,,,,,,10000,,,49.2,16.6,,,0,0,0,0", kNow_us);
  EXPECT_EQ(report(found).label, "AAAAAAAA");
}

// Of the times in the lines nobody knows the zone.
TEST(SbsReader, PutsTogetherWhatItsLinesSay) {
  SbsReader reader;
  EXPECT_TRUE(
      reader.take("MSG,1,1,1,3C6444,1,2026/11/23,11:15:29,,,DLH9LF  ,,,,,,,,,,,", kNow_us).empty());
  EXPECT_TRUE(
      reader.take("MSG,4,1,1,3C6444,1,,,,,,,100,180,,,-600,,,,,", kNow_us + 100'000).empty());
  const Readings found =
      reader.take("MSG,3,1,1,3C6444,1,,,,,,10000,,,49.2,16.6,,,0,0,0,0", kNow_us + 200'000);
  ASSERT_EQ(found.size(), 1U);
  const Report& one = report(found);
  EXPECT_EQ(one.name, "3c6444");
  EXPECT_EQ(one.label, "DLH9LF");
  EXPECT_EQ(one.utime_us, kNow_us + 200'000);
  EXPECT_TRUE(one.is_pressure_height);
  EXPECT_NEAR(one.height_m, 3048.0, 1e-9);
  ASSERT_TRUE(one.velocity_enu_m_s);
  EXPECT_NEAR((*one.velocity_enu_m_s)[1], -51.444, 1e-3);
  EXPECT_NEAR((*one.velocity_enu_m_s)[2], -3.048, 1e-9);
}

TEST(SbsReader, AnOldVelocityIsNone) {
  SbsReader reader;
  reader.take("MSG,4,1,1,3C6444,1,,,,,,,100,180,,,-600,,,,,", kNow_us);
  const Readings found =
      reader.take("MSG,3,1,1,3C6444,1,,,,,,10000,,,49.2,16.6,,,0,0,0,0", kNow_us + 11'000'000);
  EXPECT_FALSE(report(found).velocity_enu_m_s);
}

TEST(SbsReader, RubbishIsRefusedAndNothingGrowsWithoutEnd) {
  SbsReader reader;
  EXPECT_EQ(refusal(reader.take("rubbish", kNow_us)[0]), Refusal::kMalformed);
  EXPECT_EQ(refusal(reader.take("MSG,3,1,1,XYZ,1", kNow_us)[0]), Refusal::kMalformed);
  EXPECT_EQ(refusal(reader.take("MSG,3,1,1,3C6444,1,,,,,,,,,49.2,16.6,,", kNow_us)[0]),
            Refusal::kNoHeight);
  EXPECT_TRUE(reader.take("STA,,5,179,400AE7,10103,2008/11/28,14:58:51,,,RM", kNow_us).empty());
  for (int i = 0; i < 5000; ++i) {
    char line[80];
    std::snprintf(line, sizeof line, "MSG,3,1,1,%06X,1,,,,,,100,,,1.0,1.0,,,,,,", i);
    EXPECT_EQ(reader.take(line, kNow_us + i).size(), 1U);
  }
}

}  // namespace
}  // namespace ols::cues
