#include "cue/json_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ols::cues {
namespace {

using testing::HasSubstr;

TEST(JsonReader, ALineWithEverythingIsRead) {
  const Reading reading = json_reading(
      R"({"id": "r1", "label": "Radar 1", "time_s": 1795428930.5, "latitude_deg": 49.2,)"
      R"( "longitude_deg": 16.6, "height_m": 400, "horizontal_sd_m": 20, "vertical_sd_m": 40,)"
      R"( "velocity_enu_m_s": [1, 2, 3], "velocity_sd_m_s": 0.5})",
      1);
  ASSERT_TRUE(std::holds_alternative<Report>(reading));
  const Report& one = std::get<Report>(reading);
  EXPECT_EQ(one.name, "r1");
  EXPECT_EQ(one.label, "Radar 1");
  EXPECT_EQ(one.utime_us, 1'795'428'930'500'000);
  EXPECT_EQ(one.latitude_deg, 49.2);
  EXPECT_EQ(one.longitude_deg, 16.6);
  EXPECT_EQ(one.height_m, 400.0);
  EXPECT_EQ(one.horizontal_sd_m, 20.0);
  EXPECT_EQ(one.vertical_sd_m, 40.0);
  EXPECT_EQ(one.velocity_enu_m_s, (std::array{1.0, 2.0, 3.0}));
  EXPECT_EQ(one.velocity_sd_m_s, 0.5);
}

TEST(JsonReader, WithoutATimeItIsNow) {
  const Reading reading =
      json_reading(R"({"id": "a", "latitude_deg": 1, "longitude_deg": 2, "height_m": 3})", 77);
  ASSERT_TRUE(std::holds_alternative<Report>(reading));
  EXPECT_EQ(std::get<Report>(reading).utime_us, 77);
  EXPECT_FALSE(std::get<Report>(reading).horizontal_sd_m);
}

TEST(JsonReader, WhatIsWrongIsNamed) {
  const std::string place = R"("latitude_deg": 1, "longitude_deg": 2, "height_m": 3)";
  const std::vector<std::pair<std::string, std::string>> lines{
      {"x", "no JSON object"},
      {"[1]", "no JSON object"},
      {"{" + place + "}", "id is missing"},
      {R"({"id": "", )" + place + "}", "id is empty"},
      {R"({"id": 7, )" + place + "}", "id must be a text"},
      {R"({"id": "a", "horizontal_sd": 1, )" + place + "}", "unknown key horizontal_sd"},
      {R"({"id": "a", "time_s": "now", )" + place + "}", "time_s must be a number"},
      {R"({"id": "a", "time_s": -1, )" + place + "}", "time_s must be seconds"},
      {R"({"id": "a", "velocity_enu_m_s": [1, 2], )" + place + "}", "three numbers"},
      {R"({"id": "a", "latitude_deg": null, "longitude_deg": 2, "height_m": 3})", "a number"}};
  for (const auto& [line, what] : lines) {
    const Reading reading = json_reading(line, 1);
    ASSERT_TRUE(std::holds_alternative<Refused>(reading)) << line;
    EXPECT_EQ(std::get<Refused>(reading).why, Refusal::kMalformed) << line;
    EXPECT_THAT(std::get<Refused>(reading).what, HasSubstr(what)) << line;
  }
  const Reading flat = json_reading(R"({"id": "a", "latitude_deg": 1, "longitude_deg": 2})", 1);
  EXPECT_EQ(std::get<Refused>(flat).why, Refusal::kNoHeight);
}

}  // namespace
}  // namespace ols::cues
