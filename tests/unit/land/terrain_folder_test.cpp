#include "land/terrain_folder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <stop_token>

#include "base/config/toml_config.h"
#include "base/files/small_file.h"
#include "geometry/angles.h"
#include "tests/unit/error_text.h"
#include "tests/unit/folder_test.h"

namespace ols::land {
namespace {

const std::vector<NewGrid> kGrids{
    {{"", "", 38.5, 10.0, 0.001, 0.002, 2, 3, 4.0},
     {1.5F, 2.5F, 3.5F, 4.5F, 5.5F, std::numeric_limits<float>::quiet_NaN()}}};
const std::vector<Covering> kCoverings{{CoveringKind::kWood,
                                        {{{radians(10.0), radians(38.5)},
                                          {radians(10.002), radians(38.5)},
                                          {radians(10.0), radians(38.499)}}},
                                        20.0,
                                        5.0}};

class TerrainFolderTest : public FolderTest<> {
 protected:
  TerrainFolderTest() {
    Manifest manifest{.latitude_deg = 38.5, .longitude_deg = 10.0, .radius_km = 1.0};
    manifest.sources = {{"N38E010.hgt", "elevation", "public domain", "egm96_15.gtx", 4.0}};
    manifest.notes = {"a note"};
    write_terrain_folder(path_, manifest, kGrids, kCoverings);
  }
  void put(const std::string& name, const std::string& text) {
    std::ofstream(path_ + "/" + name, std::ios::binary) << text;
  }
  std::string refused() {
    return error_text<std::runtime_error>([&] { read_terrain_folder(path_); });
  }

  const std::string path_ = folder_ + "/land";
};

TEST_F(TerrainFolderTest, IsReadAsWritten) {
  const TerrainFolder folder = read_terrain_folder(path_);
  EXPECT_EQ(folder.manifest.sources[0].licence, "public domain");
  EXPECT_EQ(folder.manifest.notes, std::vector<std::string>{"a note"});
  EXPECT_EQ(folder.version.size(), 12U);
  const auto top = folder.terrain->top(radians(38.49999), radians(10.00002));
  EXPECT_NEAR(top->height_m, 21.5, 0.1);
  EXPECT_NEAR(top->sd_m, std::hypot(4.0, 5.0), 1e-9);
  EXPECT_FALSE(folder.terrain->ground(radians(38.4995), radians(10.003)));
  EXPECT_EQ(error_text<std::runtime_error>([&] { write_terrain_folder(path_, {}, {}, {}); }),
            path_ + ": exists");
}

// A crane 300 m above the ellipsoid.
TEST_F(TerrainFolderTest, SceneryCanBeLeftOut) {
  const std::string path = folder_ + "/seen";
  Covering crane = kCoverings.front();
  crane.kind = CoveringKind::kScenery;
  crane.height_m = 300.0;
  crane.sd_m = 0.5;
  write_terrain_folder(path, {}, kGrids, {kCoverings.front(), crane});
  const auto top = [&](Scenery scenery) {
    return *read_terrain_folder(path, scenery).terrain->top(radians(38.49999), radians(10.00002));
  };
  EXPECT_EQ(top(Scenery::kIncluded).height_m, 300.0);
  EXPECT_EQ(top(Scenery::kIncluded).sd_m, 0.5);
  EXPECT_NEAR(top(Scenery::kLeftOut).height_m, 21.5, 0.1);
}

TEST_F(TerrainFolderTest, DamageIsNamed) {
  const std::string manifest = read_small_file(path_ + "/land.json", 100'000);
  const std::string heights = read_small_file(path_ + "/heights-1.f32", 100'000);
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = manifest;
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
  };
  struct Case {
    std::string file, text, expected;
  };
  std::string flipped = heights;
  flipped[5] ^= 1;
  for (const Case& one : std::vector<Case>{
           {"heights-1.f32", flipped, "heights-1.f32: is damaged"},
           {"heights-1.f32", heights.substr(0, 20), "heights-1.f32: has 20 bytes, not 24"},
           {"coverings.json", "[]", "coverings.json: is damaged"},
           {"land.json", manifest.substr(0, 99), "land.json: is no JSON"},
           {"land.json", "{}", "land.json: format: is missing"},
           {"land.json", with("\"version\": 1", "\"version\": 2"), "version: 2 is not known here"},
           {"land.json", with("\"rows\": 2", "\"rows\": -2"), "rows: -2 is out of range"},
           {"land.json", with("heights-1.f32", "../../x"), "is not the name of a file"},
           {"land.json", with("38.5", "\"x\""), "is not a number"},
           {"land.json", with("heights-1.f32", "heights-9.f32"), "heights-9.f32"}}) {
    put("land.json", manifest);
    put("heights-1.f32", heights);
    const std::string coverings = read_small_file(path_ + "/coverings.json", 100'000);
    put(one.file, one.text);
    EXPECT_NE(refused().find(one.expected), std::string::npos) << refused();
    put("coverings.json", coverings);
  }
}

TEST_F(TerrainFolderTest, ReadingCanBeStoppedBeforeAGrid) {
  std::stop_source stop;
  EXPECT_NO_THROW(read_terrain_folder(path_, Scenery::kIncluded, stop.get_token()));
  stop.request_stop();
  EXPECT_EQ(error_text<std::runtime_error>(
                [&] { read_terrain_folder(path_, Scenery::kIncluded, stop.get_token()); }),
            path_ + ": reading was stopped");
}

TEST_F(TerrainFolderTest, ACheckReadsTheManifestAndTheLengths) {
  EXPECT_EQ(check_configured_land(path_).radius_km, 1.0);
  const auto why = [&] { return error_text<ConfigError>([&] { check_configured_land(path_); }); };
  put("heights-1.f32", "short");
  EXPECT_NE(why().find("[land] folder: " + path_ + "/heights-1.f32: has 5 bytes, not 24"),
            std::string::npos)
      << why();
  std::filesystem::remove(path_ + "/heights-1.f32");
  EXPECT_NE(why().find("heights-1.f32"), std::string::npos) << why();
  put("land.json", "{}");
  EXPECT_NE(why().find("land.json: format: is missing"), std::string::npos) << why();
}

TEST(Coverings, BadOnesAreRefused) {
  for (const auto& bad : std::vector<std::pair<std::string, std::string>>{
           {"{}", "is not a list"},
           {R"([{"kind":"tent","height_m":1,"sd_m":1,"rings":[]}])", "\"tent\" is not known"},
           {R"([{"kind":"wood","height_m":-1,"sd_m":1,"rings":[]}])",
            "height_m: -1 is out of range"},
           {R"([{"kind":"wood","height_m":1,"sd_m":1,"rings":[[[0,0],[1,1]]]}])", "three corners"},
           {R"([{"kind":"wood","height_m":1,"sd_m":1,"rings":[[[0,0],[1,1],[1,99]]]}])",
            "[1,99] is out of range"}}) {
    const std::string why = error_text<std::invalid_argument>([&] { parse_coverings(bad.first); });
    EXPECT_NE(why.find(bad.second), std::string::npos) << why;
  }
}

}  // namespace
}  // namespace ols::land
