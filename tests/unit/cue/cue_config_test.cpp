#include "cue/cue_config.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/config/toml_config.h"
#include "tests/unit/error_text.h"

namespace ols::cues {
namespace {

using testing::HasSubstr;

CueConfig parsed(const std::string& text) { return parse_cue_config(text, "cue.toml"); }

std::string error_of(const std::string& text) {
  return error_text<ConfigError>([&] { parsed(text); });
}

std::string input(const std::string& format, const std::string& from,
                  const std::string& more = "") {
  return "[[input]]\nname = \"a\"\nformat = \"" + format + "\"\nfrom = \"" + from + "\"\n" + more;
}

TEST(CueConfig, NothingComesInByDefault) { EXPECT_TRUE(parsed("").inputs.empty()); }

TEST(CueConfig, AnInputIsRead) {
  const CueConfig config =
      parsed(input("aircraft-json", "http://adsb/data/aircraft.json",
                   "poll_s = 0.5\narea_deg = [49.0, 16.0, 50.0, 17.0]\nhorizontal_sd_m = 5.0\n"));
  ASSERT_EQ(config.inputs.size(), 1U);
  EXPECT_EQ(config.inputs[0].format, Format::kAircraftJson);
  EXPECT_EQ(config.inputs[0].poll_s, 0.5);
  EXPECT_EQ(config.inputs[0].rules.name, "a");
  EXPECT_EQ(config.inputs[0].rules.area_deg[2], 50.0);
  EXPECT_EQ(config.inputs[0].rules.horizontal_sd_m, 5.0);
  EXPECT_STREQ(to_string(config.inputs[0].format), "aircraft-json");
}

TEST(CueConfig, WhatCannotBeIsNamedWithItsLine) {
  EXPECT_THAT(error_of(input("sbs", "udp://0.0.0.0:1")), HasSubstr("cue.toml:4: input[0].from"));
  EXPECT_THAT(error_of(input("aircraft-json", "tcp://a:1")),
              HasSubstr("cannot be received that way"));
  EXPECT_THAT(error_of(input("cot", "tcp://a:1", "types = []")),
              HasSubstr("types: must not be empty"));
  EXPECT_THAT(error_of(input("cot", "tcp://a:1", "area_deg = [50.0, 1.0, 49.0, 2.0]")),
              HasSubstr("south, west"));
  EXPECT_THAT(error_of(input("cot", "tcp://a:1") + input("cot", "tcp://a:2")),
              HasSubstr("two have the name"));
  EXPECT_THAT(error_of("[[input]]\nname = \"a b\"\nformat = \"cot\"\nfrom = \"tcp://a:1\""),
              HasSubstr("letters"));
}

}  // namespace
}  // namespace ols::cues
