#include "tools/setup/answers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/unit/error_text.h"
#include "tests/unit/setup/answers_fixture.h"

namespace ols::setup {
namespace {

using testing::HasSubstr;

std::string complaint(const std::string& text) {
  return error_text<ConfigError>([&] { read_answers(text, "answers.toml"); }, "none");
}

std::string with(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

TEST(Answers, AStationsDevicesMayBeFoundLater) {
  const Answers answers = read_answers(station_answers(), "answers.toml");
  EXPECT_TRUE(answers.is_station);
  EXPECT_EQ(answers.station, "alfa");
  EXPECT_EQ(answers.interface, "eth0");
  EXPECT_EQ(answers.invitation.site, kSite.secret);
  EXPECT_EQ(find(answers.values, "station.camera.device"), nullptr);
  ASSERT_NE(find(answers.values, "station.pose.heading_deg"), nullptr);
}

TEST(Answers, ABadOneIsNamedByLineAndKey) {
  const std::string good = station_answers();
  EXPECT_THAT(complaint(with(good, "heading_deg = 45.0", "heading_deg = 450.0")),
              HasSubstr("answers.toml:10: station.pose.heading_deg"));
  EXPECT_THAT(complaint(with(good, "height_m", "hight_m")), HasSubstr("answers.toml:9: "));
  EXPECT_THAT(complaint(with(good, "fx_px = 13333.3\n", "")), HasSubstr("fx_px: is missing"));
  EXPECT_THAT(complaint(with(good, "\"station\"", "\"ship\"")), HasSubstr("answers.toml:1: role"));
  EXPECT_THAT(complaint(with(good, "invitation = \"", "invitation = \"x")),
              HasSubstr("answers.toml:3: invitation: must be the 128"));
  EXPECT_THAT(complaint("neighbours = [\"10.0.0.2\", \"x\\ny\"]\n" + good),
              HasSubstr("answers.toml:1: neighbours"));
  EXPECT_EQ(complaint("neighbours = [\"10.0.0.2\", \"fd00::2\"]\n" + good), "none");
  EXPECT_THAT(complaint("interface = \"lo\"\n"), HasSubstr("role"));
  EXPECT_THAT(complaint(with(kCentreAnswers, "airfield", "air field")),
              HasSubstr("answers.toml:2: site"));
  EXPECT_THAT(complaint(with(kCentreAnswers, "quota_gb = 5.0", "quota = 5")),
              HasSubstr("answers.toml:6: logger.quota"));
  EXPECT_THAT(complaint(with(kCentreAnswers, "root =", "id =")), HasSubstr("id"));
}

TEST(Answers, TheFilesAreThoseThatTheProgramsReadAndRequireSignatures) {
  const Answers answers = read_answers(station_answers(devices()), "answers.toml");
  const std::string text = station_file(of_table(answers.values, "station"), "/etc/ols/alfa.toml");
  const Values values = flat(text);
  EXPECT_EQ(*find(values, "trust.mode"), "\"require\"");
  EXPECT_EQ(*find(values, "id"), "\"alfa\"");
  EXPECT_THAT(*find(values, "lcm_url"), HasSubstr("ttl=1"));
  EXPECT_EQ(*find(values, "state_folder"), "\"/var/lib/ols\"");
  EXPECT_EQ(*find(flat(fusion_file({}, "f")), "trust.mode"), "\"require\"");
  EXPECT_EQ(*find(flat(console_file({}, "c")), "trust.mode"), "\"require\"");
  const Values logger = flat(logger_file({{"quota_gb", "5.0"}}, "l"));
  EXPECT_EQ(*find(logger, "quota_gb"), "5.0");
}

TEST(Answers, WhatTheyStateIsNotReplacedByADefault) {
  const Values values{{"trust.mode", "\"observe\""},
                      {"lcm_url", "\"udpm://239.1.1.1:7667?ttl=0\""}};
  const Values fusion = flat(fusion_file(values, "f"));
  EXPECT_EQ(*find(fusion, "trust.mode"), "\"observe\"");
  EXPECT_THAT(*find(fusion, "lcm_url"), HasSubstr("239.1.1.1"));
}

TEST(Answers, AKeyThatHasNoPlaceInTheFileIsAnError) {
  EXPECT_THROW(fusion_file({{"nonsense", "1"}}, "f"), std::invalid_argument);
}

}  // namespace
}  // namespace ols::setup
