#include "base/config/toml_config.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <string>

#include "tests/unit/error_text.h"
#include "tests/unit/temp_dir.h"

namespace ols {
namespace {

using testing::HasSubstr;

std::string error_of(std::string_view text, void (*read)(ConfigTable&)) {
  return error_text<ConfigError>([&] {
    ConfigFile file(text, "station.toml");
    read(file.root());
  });
}

TEST(ConfigFile, ReadsValuesAndFallbacks) {
  ConfigFile file("a = 1.5\nn = 3\nname = 'x'\n[t]\nv = [1, 2.5]\non = true\n", "f");
  EXPECT_EQ(file.root().number("a", 0, 0, 2), 1.5);
  EXPECT_EQ(file.root().number("absent", 7, 0, 2), 7);
  EXPECT_EQ(file.root().integer("n", 0, 0, 5), 3);
  EXPECT_EQ(file.root().text("name", ""), "x");
  EXPECT_EQ(file.root().table("t").numbers("v", {0, 0}, 0, 9), (std::vector<double>{1, 2.5}));
  EXPECT_TRUE(file.root().table("t").boolean("on", false));
}

TEST(ConfigFile, AnIntegerIsANumber) {
  ConfigFile file("a = 2\n", "f");
  EXPECT_EQ(file.root().number("a", 0, 0, 2), 2.0);
}

TEST(ConfigFile, NamesFileLineAndKeyOfAnUnknownKey) {
  const auto error = error_of("[ptu]\nbaud = 9600\ncolour = 1\n", [](ConfigTable& root) {
    root.table("ptu").refuse_unknown({"baud"});
  });
  EXPECT_EQ(error, "station.toml:3: ptu.colour: unknown key");
}

TEST(ConfigFile, OffersTheMostSimilarKnownKey) {
  const auto meant = [](const std::string& key) {
    try {
      ConfigFile file(key + " = 1\n", "f");
      file.root().refuse_unknown({"heading_deg", "height_m", "lens", "baud", "on"});
    } catch (const ConfigError& error) {
      const std::string words = error.what();
      const std::size_t at = words.find("did you mean ");
      return at == std::string::npos ? "nothing" : words.substr(at + 13);
    }
    return std::string("known");
  };
  EXPECT_EQ(meant("headign_deg"), "heading_deg?");
  EXPECT_EQ(meant("heading"), "nothing");  // more than a third is missing
  EXPECT_EQ(meant("lense"), "lens?");
  EXPECT_EQ(meant("buad"), "baud?");
  EXPECT_EQ(meant("heigth_m"), "height_m?");
  EXPECT_EQ(meant("no"), "nothing");
  EXPECT_EQ(meant("baud"), "known");
  EXPECT_EQ(meant(std::string(100000, 'x')), "nothing");
}

TEST(ConfigFile, NamesTheLineOfAnUnknownTable) {
  const auto error =
      error_of("a = 1\n[x]\nb = 2\n", [](ConfigTable& root) { root.refuse_unknown({"a"}); });
  EXPECT_EQ(error, "station.toml:2: x: unknown key");
}

TEST(ConfigFile, RefusesOutOfRangeNonFiniteAndWrongType) {
  EXPECT_EQ(error_of("a = 3\n", [](ConfigTable& root) { root.number("a", 0, 0, 2); }),
            "station.toml:1: a: 3 is outside 0..2");
  EXPECT_EQ(error_of("\na = nan\n", [](ConfigTable& root) { root.number("a", 0, 0, 2); }),
            "station.toml:2: a: must be finite");
  EXPECT_EQ(error_of("a = 'x'\n", [](ConfigTable& root) { root.number("a", 0, 0, 2); }),
            "station.toml:1: a: must be a number");
  EXPECT_EQ(error_of("a = 1.5\n", [](ConfigTable& root) { root.integer("a", 0, 0, 2); }),
            "station.toml:1: a: must be an integer");
  EXPECT_EQ(error_of("a = [1, 2]\n",
                     [](ConfigTable& root) {
                       root.numbers("a", {0, 0, 0}, 0, 2);
                     }),
            "station.toml:1: a: must be an array of 3 numbers");
  EXPECT_EQ(error_of("a = 'q'\n",
                     [](ConfigTable& root) {
                       root.choice("a", "x", {"x", "y"});
                     }),
            "station.toml:1: a: \"q\" is not one of x, y");
}

TEST(ConfigFile, NamesTheLineOfASyntaxError) {
  EXPECT_THAT(error_of("a = 1\nb = = 2\n", [](ConfigTable&) {}), HasSubstr("station.toml:2: "));
}

TEST(ConfigFile, NamesAFileThatCannotBeRead) {
  EXPECT_THAT([&] { ConfigFile file("/nonexistent/station.toml"); },
              testing::ThrowsMessage<ConfigError>("/nonexistent/station.toml: cannot be read"));
}

TEST(ConfigFile, AnEmptyFileIsAConfigurationAndAFolderIsNone) {
  const std::string path = temp_dir() + "empty_config_" + std::to_string(::getpid()) + ".toml";
  std::ofstream{path};
  EXPECT_NO_THROW(ConfigFile{path});
  std::remove(path.c_str());
  EXPECT_THROW(ConfigFile{temp_dir()}, ConfigError);
}

TEST(ConfigFile, ReadsArraysOfTables) {
  ConfigFile file("[[s]]\nid = 'a'\n[[s]]\nid = 'b'\nz = 1\n", "f");
  const auto tables = file.root().tables("s");
  ASSERT_EQ(tables.size(), 2u);
  EXPECT_EQ(tables[1]->text("id", ""), "b");
  EXPECT_EQ(tables[0]->text("id", ""), "a");
}

}  // namespace
}  // namespace ols
