#include "base/config/toml_config.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <string>

#include "base/config/area.h"
#include "base/config/toml_merge.h"
#include "base/config/toml_text.h"
#include "tests/unit/error_text.h"
#include "tests/unit/temp_dir.h"

namespace ols {
namespace {

using testing::HasSubstr;

TEST(Area, ContainsItsBorders) {
  constexpr Area kArea{49.0, 16.0, 50.0, 17.0};
  EXPECT_TRUE(is_inside(kArea, 49.0, 17.0));
  EXPECT_TRUE(is_inside(kArea, 49.5, 16.5));
  EXPECT_FALSE(is_inside(kArea, 50.1, 16.5));
  EXPECT_FALSE(is_inside(kArea, 48.9, 16.5));
  EXPECT_FALSE(is_inside(kArea, 49.5, 15.9));
  EXPECT_FALSE(is_inside(kArea, 49.5, 17.1));
}

TEST(Area, MayLieAcrossTheDateLine) {
  constexpr Area kArea{-20.0, 179.0, -10.0, -179.0};
  EXPECT_TRUE(is_inside(kArea, -15.0, 179.5));
  EXPECT_TRUE(is_inside(kArea, -15.0, -179.5));
  EXPECT_FALSE(is_inside(kArea, -15.0, 0.0));
}

TEST(TomlText, IsReadAsItWas) {
  const std::string texts[] = {"",
                               "/dev/ols/ptu",
                               "a \"b\" \\ 'c'",
                               "1\n2\r\n\t3\b\f",
                               std::string("\x01\x1b\x7f\0", 4),
                               "Gr\u00fcn \u20ac \U0001f600"};
  for (const std::string& text : texts) {
    ConfigFile file("k = " + toml_text(text) + "\n", "f");
    EXPECT_EQ(file.root().text("k", "nothing"), text);
  }
}

TEST(TomlText, IsOneLineOfAscii) {
  EXPECT_EQ(toml_text("/dev/ols/ptu"), "\"/dev/ols/ptu\"");
  EXPECT_EQ(toml_text("a \"b\" \\ 'c'"), R"("a \"b\" \\ 'c'")");
  EXPECT_EQ(toml_text("1\n2\r\n\t3\x1b[0m\x7f"), R"("1\n2\r\n\t3\u001B[0m\u007F")");
  EXPECT_EQ(toml_text("Gr\u00fcn"), R"("Gr\u00FCn")");
}

// A terminal that is not set to UTF-8 sends such bytes: still a file that can be read.
TEST(TomlText, TakesWhatIsNoUtf8) {
  ConfigFile file("k = " + toml_text("Gr\xfcn") + "\n", "f");
  EXPECT_EQ(file.root().text("k", ""), "Gr\u00fcn");
}

TEST(TomlMerge, ChangesValuesAndNothingElse) {
  EXPECT_EQ(toml_merged("# first\n"
                        "id = \"s1\"\n"
                        "[pose]   # of GROUND\n"
                        "heading_deg = -12 # by compass\n"
                        "\n"
                        "[calibration]\n"
                        "sd = { heading_deg = 2.0, mount_deg = 0.1 }\n"
                        "[ptu]\n"
                        "device = \"x\"",
                        "[pose]\nheading_deg = 211.5\ntilt_x_deg = 0.1\ntilt_y_deg = 0.2\n"
                        "[chain]\nmount_z_deg = 0.5\n[calibration.sd]\nheading_deg = 0.01\n"),
            "# first\n"
            "id = \"s1\"\n"
            "[pose]   # of GROUND\n"
            "heading_deg = 211.5 # by compass\n"
            "tilt_x_deg = 0.1\n"
            "tilt_y_deg = 0.2\n"
            "\n"
            "[calibration]\n"
            "sd = { heading_deg = 0.01, mount_deg = 0.1 }\n"
            "[ptu]\n"
            "device = \"x\"\n"
            "\n"
            "[chain]\n"
            "mount_z_deg = 0.5\n");
}

// As ols-setup writes a station's file.
TEST(TomlMerge, AddsTheTableThatOnlyInnerHeadersImply) {
  EXPECT_EQ(toml_merged("[calibration.sd]  # 1-sigma\nheading_deg = 90\n[lens]\nfx_px = 900\n",
                        "[calibration]\nid = 1\n[calibration.sd]\nheading_deg = 0.1\n"),
            "[calibration.sd]  # 1-sigma\nheading_deg = 0.1\n[lens]\nfx_px = 900\n"
            "\n[calibration]\nid = 1\n");
}

TEST(TomlMerge, RefusesAFormThatItWouldSpoil) {
  EXPECT_THROW(toml_merged("sd = { heading_deg = 2.0 }\nx = 1\n", "[sd]\ntilt_deg = 1.0\n"),
               std::runtime_error);
}

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
