#include "base/config/config_common.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <span>

#include "tests/unit/error_text.h"
#include "tests/unit/temp_dir.h"

namespace ols::config {
namespace {

using testing::HasSubstr;

struct Sample {
  std::string lcm_url = "memq://", status_file, name = "a";
  std::array<double, 4> area_deg{-90.0, -180.0, 90.0, 180.0};
};

Section sample_section(Sample& s) {
  return {"",
          "",
          {bus_url(s.lcm_url), config::status_file(s.status_file),
           text("name", s.name, "A name.", word_up_to(3)),
           numbers("area_deg", std::span<double>(s.area_deg), {-180.0, 180.0}, "deg", "A place.")},
          {},
          [&s](ConfigTable& root) { check_area(s.area_deg, "area_deg", root); }};
}

std::string error_of(const std::string& toml) {
  return error_text<ConfigError>([&] { parse(toml, "f", sample_section); }, "accepted");
}

TEST(ConfigCommon, AFileAndATextGiveTheSame) {
  const std::string toml = "lcm_url = 'udpm://239.255.76.67:7667?ttl=1'\nstatus_file = '/s'\n";
  const std::string path = temp_dir() + "common.toml";
  std::ofstream(path) << toml;
  for (const Sample& read : {load(path, sample_section), parse(toml, "f", sample_section)}) {
    EXPECT_EQ(read.lcm_url, "udpm://239.255.76.67:7667?ttl=1");
    EXPECT_EQ(read.status_file, "/s");
    EXPECT_EQ(read.name, "a");
  }
  EXPECT_THROW(load(path + "x", sample_section), ConfigError);
}

TEST(ConfigCommon, ErrorsNameLineAndKey) {
  EXPECT_THAT(error_of("\nlcm_url = 'bogus://'\n"), HasSubstr("f:2: lcm_url"));
  EXPECT_EQ(error_of("name = 'a-_'\n"), "accepted");
  for (const char* name : {"", "a b", "abcd", "é"}) {
    EXPECT_THAT(error_of("name = '" + std::string(name) + "'\n"),
                HasSubstr("f:1: name: must be 1 to 3 letters, digits, - or _"))
        << name;
  }
}

TEST(ConfigCommon, AnAreaHasItsSouthInTheSouthAndNoMoreThanTheEarth) {
  EXPECT_EQ(error_of("area_deg = [49.0, 170.0, 50.0, -170.0]\n"), "accepted");  // over the dateline
  for (const char* area :
       {"50.0, 16.0, 49.0, 17.0", "-91.0, 16.0, 49.0, 17.0", "49.0, 16.0, 91.0, 17.0"}) {
    EXPECT_THAT(error_of("area_deg = [" + std::string(area) + "]\n"), HasSubstr("f:1: area_deg"))
        << area;
  }
}

TEST(ConfigCommon, TwoOfOneNameAreRefused) {
  ConfigFile file("[[input]]\n", "f");
  EXPECT_NO_THROW(check_distinct({"a", "b"}, "input", file.root()));
  EXPECT_THAT(
      [&] {
        check_distinct({"a", "b", "a"}, "input", file.root());
      },
      testing::ThrowsMessage<ConfigError>(HasSubstr("input: two have the name \"a\"")));
}

}  // namespace
}  // namespace ols::config
