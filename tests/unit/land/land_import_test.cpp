// ols-land import, on small files that this test makes and on real tiles.
#include "tools/land/land_import.h"

#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <ogr_spatialref.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <random>

#include "geometry/angles.h"
#include "geometry/utm.h"
#include "land/geoid.h"
#include "land/horizon_map.h"
#include "land/terrain_folder.h"
#include "tests/unit/error_text.h"
#include "tests/unit/folder_test.h"
#include "tests/unit/land/made_land.h"
#include "tools/land/covering_reader.h"

namespace ols::land {
namespace {

constexpr double kVoid = -32768.0;

struct Model {
  double west = 9.9, north = 38.6;  // of the first height
  double step = 0.01;
  int columns = 21, rows = 21;
  int epsg = 4326;   // 0: none
  std::string unit;  // of the heights; empty: not stated
  std::function<double(double x, double y)> height = [](double x, double y) {
    return 100.0 * x + 200.0 * y;
  };
};

void write_model(const std::string& path, const Model& model) {
  GDALAllRegister();
  auto* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  GDALDataset* file =
      driver->Create(path.c_str(), model.columns, model.rows, 1, GDT_Float32, nullptr);
  ASSERT_NE(file, nullptr);
  double affine[] = {model.west - 0.5 * model.step,  model.step, 0.0,
                     model.north + 0.5 * model.step, 0.0,        -model.step};
  file->SetGeoTransform(affine);
  if (model.epsg != 0) {
    OGRSpatialReference system;
    system.importFromEPSG(model.epsg);
    file->SetSpatialRef(&system);
  }
  file->GetRasterBand(1)->SetNoDataValue(kVoid);
  if (!model.unit.empty()) file->GetRasterBand(1)->SetUnitType(model.unit.c_str());
  std::vector<float> row(static_cast<std::size_t>(model.columns));
  for (int i = 0; i < model.rows; ++i) {
    for (int k = 0; k < model.columns; ++k) {
      row[static_cast<std::size_t>(k)] = static_cast<float>(
          model.height(model.west + k * model.step, model.north - i * model.step));
    }
    ASSERT_EQ(file->GetRasterBand(1)->RasterIO(GF_Write, 0, i, model.columns, 1, row.data(),
                                               model.columns, 1, GDT_Float32, 0, 0, nullptr),
              CE_None);
  }
  GDALClose(file);
}

class LandImportTest : public FolderTest<> {
 protected:
  LandImportTest() {
    options_.latitude_deg = 38.5;
    options_.longitude_deg = 10.0;
    options_.radius_km = 5.0;
    options_.heights = "ellipsoid";
    options_.output = folder_ + "/land";
  }
  std::string model(const std::string& name, const Model& model) {
    write_model(folder_ + "/" + name, model);
    return folder_ + "/" + name;
  }
  std::string file(const std::string& name, const std::string& text) {
    std::ofstream(folder_ + "/" + name) << text;
    return folder_ + "/" + name;
  }
  // The notes in one text.
  std::string import() {
    std::filesystem::remove_all(options_.output);
    std::string notes;
    for (const std::string& note : import_land(options_)) notes += note + '\n';
    return notes;
  }
  std::string refused() {
    return error_text<std::runtime_error>([&] { import(); });
  }
  std::optional<SurfaceHeight> ground(double latitude_deg, double longitude_deg) {
    return read_terrain_folder(options_.output)
        .terrain->ground(radians(latitude_deg), radians(longitude_deg));
  }

  ImportOptions options_;
};

TEST_F(LandImportTest, TilesThatShareAnEdgeBecomeOneLand) {
  Model west{.columns = 11}, east{.west = 10.0};
  west.height = [](double x, double y) {
    return y > 38.495 && y < 38.505 && x > 9.985 ? kVoid : 100.0 * x + 200.0 * y;
  };
  options_.elevation = {model("west.tif", west), model("east.tif", east)};
  options_.longitude_deg = 10.003;
  const std::string notes = import();
  EXPECT_NE(notes.find("west.tif: 2 heights are void"), std::string::npos) << notes;
  EXPECT_NE(notes.find("west.tif and east.tif share"), std::string::npos) << notes;
  EXPECT_NE(notes.find("with equal heights"), std::string::npos) << notes;
  EXPECT_EQ(read_terrain_folder(options_.output).manifest.grids.size(), 1U);
  // East of the seam, on it, west of it; beside the void, whose edge the other tile knows.
  for (const double x : {10.0234, 10.0, 9.9777}) {
    EXPECT_NEAR(ground(38.5134, x)->height_m, 100.0 * x + 200.0 * 38.5134, 0.01);
  }
  EXPECT_FALSE(ground(38.5, 9.9934));
  EXPECT_NEAR(ground(38.5, 10.0001)->height_m, 8700.01, 0.01);
}

TEST_F(LandImportTest, ASiteAt180DegreesHasLandOnBothSides) {
  const auto round = [](double x, double y) { return 10.0 * (x < 0.0 ? x + 360.0 : x) + y; };
  Model west{.west = 179.8, .height = round}, east{.west = -180.0, .height = round};
  options_.elevation = {model("west.tif", west), model("east.tif", east)};
  for (const double site_deg : {179.999, -179.999}) {
    options_.longitude_deg = site_deg;
    const std::string notes = import();
    EXPECT_NE(notes.find("100 % of the area"), std::string::npos) << notes;
    for (const double x : {179.97, 179.9999, -179.9999, -179.97}) {
      ASSERT_TRUE(ground(38.5034, x)) << site_deg << ' ' << x;
      EXPECT_NEAR(ground(38.5034, x)->height_m, round(x, 38.5034), 0.01) << site_deg << ' ' << x;
    }
  }
}

TEST_F(LandImportTest, ReadsAnyProjectionAndTheGeoid) {
  Model utm{.west = 580'000.0,
            .north = 4'270'000.0,
            .step = 100.0,
            .columns = 161,
            .rows = 161,
            .epsg = 32632};
  utm.height = [](double x, double y) { return 0.01 * (x - 580'000.0) + 0.02 * (y - 4'255'000.0); };
  options_.elevation = {model("utm.tif", utm)};
  options_.heights = "egm96_15.gtx";
  EXPECT_NE(import().find("is resampled"), std::string::npos);
  const Utm at = utm_from_geodetic({radians(38.51), radians(10.01), 0.0}).position;
  EXPECT_NEAR(
      ground(38.51, 10.01)->height_m,
      utm.height(at.easting_m, at.northing_m) + Geoid("egm96_15.gtx").height_m(38.51, 10.01), 0.2);
}

TEST_F(LandImportTest, ADatumThatIsNotWgs84IsTransformed) {
  options_.elevation = {model("ed50.tif", {.epsg = 4230})};
  EXPECT_NE(import().find("is resampled"), std::string::npos);
  // European Datum 1950 is some hundred metres off: here the ground falls by 0.2 m in that.
  EXPECT_NEAR(ground(38.5, 10.0)->height_m, 8700.3, 0.15);
}

TEST_F(LandImportTest, TheFinerModelCountsWhereItKnowsTheLand) {
  const auto level = [](double m) { return [m](double, double) { return m; }; };
  Model fine{.west = 9.99, .north = 38.51, .step = 0.001};
  fine.height = level(103.0);
  Model coarse;
  coarse.height = level(100.0);
  options_.elevation = {model("coarse.tif", coarse), model("fine.tif", fine)};
  EXPECT_NE(import().find("fine.tif and coarse.tif have models that overlap at"),
            std::string::npos);
  EXPECT_NEAR(ground(38.5, 10.0)->height_m, 103.0, 1e-3);
  EXPECT_NEAR(ground(38.53, 10.0)->height_m, 100.0, 1e-3);
}

TEST_F(LandImportTest, WhatCannotBeUsedIsNamed) {
  const std::string good = model("good.tif", {});
  Model higher{.west = 10.1}, beside{.west = 10.11}, none{.epsg = 0}, at_site;
  higher.height = beside.height = [](double x, double y) { return 100.0 * x + 200.0 * y + 50.0; };
  at_site.height = [](double x, double y) {
    return std::hypot(x - 10.0, y - 38.5) < 0.005 ? kVoid : 5.0;
  };
  const std::string damaged = model("damaged.tif", {});
  std::filesystem::resize_file(damaged, 700);
  options_.radius_km = 20.0;
  struct Case {
    std::vector<std::string> elevation;
    std::string expected;
  };
  for (const Case& one : std::vector<Case>{
           {{file("text.tif", "no tiff")}, "text.tif: is no elevation model that GDAL reads"},
           {{folder_ + "/none.tif"}, "none.tif: is no elevation model"},
           {{damaged}, "damaged.tif: is "},
           {{model("elsewhere.tif", {.west = 20.0})},
            "no elevation model has land within 20 km of"},
           {{model("void.tif", at_site)}, "the ground of the site itself is void"},
           {{model("nowhere.tif", none)}, "nowhere.tif: does not state its coordinate system"},
           {{good, model("higher.tif", higher)}, "50 m at 38.6, 10.1: they do not join"},
           {{good, model("beside.tif", beside)}, "they do not join"}}) {
    options_.elevation = one.elevation;
    EXPECT_NE(refused().find(one.expected), std::string::npos) << refused();
    EXPECT_FALSE(std::filesystem::exists(options_.output));
  }
  options_.elevation = {good};
  options_.heights = "";
  EXPECT_NE(refused().find("good.tif: does not say what its heights are above"), std::string::npos);
  options_.heights = "no_grid.gtx";
  EXPECT_NE(refused().find("\"no_grid.gtx\" does not exist"), std::string::npos);
}

TEST_F(LandImportTest, HeightsInFeetBecomeMetres) {
  Model level;
  level.height = [](double, double) { return 1000.0; };
  for (const auto& [unit, metres] :
       {std::pair{"ft", 304.8}, {"US survey foot", 1000.0 * 1200.0 / 3937.0}, {"metre", 1000.0}}) {
    level.unit = unit;
    options_.elevation = {model("level.tif", level)};
    import();
    EXPECT_NEAR(ground(38.5, 10.0)->height_m, metres, 1e-3) << unit;
  }
  level.unit = "fathom";
  options_.elevation = {model("level.tif", level)};
  EXPECT_NE(refused().find("level.tif: its heights are in \"fathom\""), std::string::npos);
}

// DTED states itself that its heights are above the geoid.
TEST_F(LandImportTest, ReadsDted) {
  Model degree{.west = 10.0, .north = 39.0, .step = 1.0 / 120.0, .columns = 121, .rows = 121};
  degree.height = [](double, double) { return 250.0; };
  const std::string source = model("source.tif", degree);
  const std::string dted = folder_ + "/n38e010.dt0";
  auto* tile = static_cast<GDALDataset*>(GDALOpen(source.c_str(), GA_ReadOnly));
  auto* copy = GetGDALDriverManager()->GetDriverByName("DTED")->CreateCopy(
      dted.c_str(), tile, FALSE, nullptr, nullptr, nullptr);
  ASSERT_NE(copy, nullptr);
  GDALClose(copy);
  GDALClose(tile);
  options_.elevation = {dted};
  options_.longitude_deg = 10.2;
  options_.heights = "";
  import();
  EXPECT_NEAR(ground(38.51, 10.21)->height_m, 250.0 + Geoid("egm96_15.gtx").height_m(38.51, 10.21),
              0.1);
}

// Thirty gigabytes of heights in the size of a field: refused before any of them is read.
TEST_F(LandImportTest, TooManyHeightsAreRefused) {
  options_.elevation = {file("fine.vrt",
                             R"(<VRTDataset rasterXSize="90000" rasterYSize="90000">
  <SRS>EPSG:4326</SRS><GeoTransform>9.955, 1e-6, 0, 38.545, 0, -1e-6</GeoTransform>
  <VRTRasterBand dataType="Float32" band="1"/></VRTDataset>)")};
  EXPECT_NE(refused().find("fine.vrt: has too many heights within the radius"), std::string::npos)
      << refused();
}

TEST_F(LandImportTest, ReadsBuildingsOfOpenStreetMap) {
  Model level;
  level.height = [](double, double) { return 50.0; };
  options_.elevation = {model("level.tif", level)};
  std::string osm = R"(<?xml version="1.0"?><osm version="0.6">)";
  const double corners[][2] = {{38.5, 10.0}, {38.5, 10.001}, {38.501, 10.001}, {38.501, 10.0}};
  for (int i = 0; i < 4; ++i) {
    osm += "<node id=\"" + std::to_string(i + 1) + "\" version=\"1\" lat=\"" +
           std::to_string(corners[i][0]) + "\" lon=\"" + std::to_string(corners[i][1]) + "\"/>";
  }
  osm += R"(<way id="9" version="1"><nd ref="1"/><nd ref="2"/><nd ref="3"/><nd ref="4"/>
    <nd ref="1"/><tag k="building" v="yes"/><tag k="building:levels" v="5"/></way></osm>)";
  options_.buildings = {file("town.osm", osm)};
  const std::string notes = import();
  EXPECT_NE(notes.find("town.osm: 1 buildings"), std::string::npos) << notes;
  EXPECT_NEAR(read_terrain_folder(options_.output)
                  .terrain->top(radians(38.5005), radians(10.0005))
                  ->height_m,
              65.0, 1e-3);
}

TEST_F(LandImportTest, AbsurdHeightsAreVoidAndNamed) {
  Model absurd;
  absurd.height = [](double x, double y) {
    if (std::hypot(x - 10.02, y - 38.52) < 0.001) return 32'000.0;
    return std::hypot(x - 9.98, y - 38.52) < 0.001 ? std::nan("") : 5.0;
  };
  options_.elevation = {model("absurd.tif", absurd)};
  const std::string notes = import();
  EXPECT_NE(
      notes.find("1 heights are absurd and count as void, the first is 32000 m at 38.52, 10.02"),
      std::string::npos)
      << notes;
  EXPECT_NE(notes.find("1 heights are void"), std::string::npos) << notes;
  EXPECT_FALSE(ground(38.52, 10.02));
  EXPECT_FALSE(ground(38.52, 9.98));
}

std::string feature(const std::string& properties, double west, double south) {
  const auto at = [&](double x, double y) {
    return "[" + std::to_string(west + x) + "," + std::to_string(south + y) + "]";
  };
  return R"({"type":"Feature","properties":)" + properties +
         R"(,"geometry":{"type":"Polygon","coordinates":[[)" + at(0, 0) + "," + at(.001, 0) + "," +
         at(.001, .001) + "," + at(0, .001) + "," + at(0, 0) + "]]}}";
}

TEST_F(LandImportTest, BuildingsHaveTheirHeightOrThatOfTheirLevels) {
  Model level;
  level.height = [](double, double) { return 50.0; };
  options_.elevation = {model("level.tif", level)};
  options_.buildings = {
      file("houses.geojson", R"({"type":"FeatureCollection","features":[)" +
                                 feature(R"({"height":"12.5 m"})", 10.0, 38.5) + "," +
                                 feature(R"({"building:levels":"4"})", 10.01, 38.5) + "," +
                                 feature("{}", 10.02, 38.5) + "," +
                                 feature(R"({"height":-3})", 10.03, 38.5) + "," +
                                 feature(R"({"height":7})", 15.0, 38.5) + "," +
                                 R"({"type":"Feature","properties":{"height":9},"geometry":)"
                                 R"({"type":"Point","coordinates":[10.04,38.5]}})" +
                                 "]}")};
  options_.woods = {file("woods.geojson", R"({"type":"FeatureCollection","features":[)" +
                                              feature(R"({"height":20})", 9.97, 38.5) + "]}")};
  const std::string notes = import();
  EXPECT_NE(notes.find("houses.geojson: 1 have neither height nor levels, left out, the first is "
                       "feature 2 at 38.5, 10.02"),
            std::string::npos)
      << notes;
  EXPECT_NE(notes.find("houses.geojson: 1 have absurd heights"), std::string::npos) << notes;
  EXPECT_NE(notes.find("houses.geojson: 1 have a height and no area, left out, the first is "
                       "feature 5 at 38.5, 10.04"),
            std::string::npos)
      << notes;
  EXPECT_NE(notes.find("houses.geojson: 2 buildings"), std::string::npos) << notes;
  const auto land = read_terrain_folder(options_.output).terrain;
  const auto top = [&](double longitude_deg) {
    return land->top(radians(38.5005), radians(longitude_deg))->height_m;
  };
  EXPECT_NEAR(top(10.0005), 62.5, 1e-3);
  EXPECT_NEAR(top(10.0105), 62.0, 1e-3);
  EXPECT_NEAR(top(10.0205), 50.0, 1e-3);
  EXPECT_NEAR(top(9.9705), 70.0, 1e-3);
  options_.buildings = {file("cut.geojson", R"({"type":"FeatureCollection","feat)")};
  EXPECT_NE(refused().find("cut.geojson: is no file of polygons"), std::string::npos);
}

TEST(Height, IsReadWithItsUnit) {
  EXPECT_EQ(parse_height_m("12"), 12.0);
  EXPECT_EQ(parse_height_m(" 12.5 m "), 12.5);
  EXPECT_NEAR(parse_height_m("40 ft"), 12.192, 1e-9);
  for (const char* text : {"", "high", "3 storeys", "12,5"}) {
    EXPECT_TRUE(std::isnan(parse_height_m(text))) << text;
  }
}

constexpr const char* kSceneryHeader =
    "station,other,latitude_deg,longitude_deg,height_m,height_sd_m,azimuth_deg,elevation_deg,"
    "range_m,range_sd_m,range_sd_systematic_m\n";

// Two points 0.1 degrees wide, one of them elsewhere.
TEST_F(LandImportTest, SceneryStandsWhereItWasMeasured) {
  Model level;
  level.height = [](double, double) { return 50.0; };
  options_.elevation = {model("level.tif", level)};
  options_.scenery = {file("scenery.csv", std::string(kSceneryHeader) +
                                              "alfa,bravo,38.5,10.0,75.5,0.4,0,1,1000,2,1\n"
                                              "alfa,bravo,37.5,10.0,75.5,0.4,0,1,1000,2,1\n")};
  EXPECT_NE(import().find("scenery.csv: 1 points of measured scenery, 1 elsewhere"),
            std::string::npos);
  const auto land = read_terrain_folder(options_.output).terrain;
  const auto top = [&](double north_m) {
    return *land->top(radians(38.5 + north_m / 111e3), radians(10.0));
  };
  EXPECT_EQ(top(0.8).height_m, 75.5);
  EXPECT_EQ(top(0.8).sd_m, 0.4);
  EXPECT_NEAR(top(1.0).height_m, 50.0, 1e-3);
  EXPECT_NEAR(top(-1.0).height_m, 50.0, 1e-3);
  // From where it was measured, two columns of the map show it: it stands between them.
  const double west_m = 1000.0 * radians(0.025);
  const Geodetic camera{radians(38.5 - 1000.0 / 111e3), radians(10.0 - west_m / 87.2e3), 55.5};
  const HorizonMap map(
      *land, camera,
      {.reach_m = 2000.0, .from_azimuth_rad = radians(-1.0), .sector_rad = radians(2.0)});
  for (const double azimuth_deg : {0.0, 0.025, 0.05}) {
    const auto seen = map.skyline(radians(azimuth_deg));
    ASSERT_TRUE(seen);
    EXPECT_NEAR(seen->distance_m, 1000.0, 3.0) << azimuth_deg;
    EXPECT_NEAR(seen->elevation_rad, 20.0 / 1000.0, 2e-4) << azimuth_deg;
    EXPECT_NEAR(seen->elevation_sd_rad, 0.4 / 1000.0, 2e-5) << azimuth_deg;
  }
  EXPECT_LT(map.skyline(radians(0.2))->elevation_rad, 0.0);
}

TEST_F(LandImportTest, AWrongRowOfSceneryIsNamed) {
  Model level;
  options_.elevation = {model("level.tif", level)};
  options_.scenery = {file(
      "scenery.csv", std::string(kSceneryHeader) + "alfa,bravo,38.5,10.0,nan,0.4,0,1,1000,2,1\n")};
  EXPECT_NE(refused().find("scenery.csv:2: height_m: "), std::string::npos) << refused();
  options_.scenery = {file("scenery.csv", kSceneryHeader)};
  EXPECT_NE(refused().find("scenery.csv: has no rows"), std::string::npos) << refused();
}

// Four tiles of SRTM: a volcano, another island 7 km away, and the sea between.
class RealLandTest : public LandImportTest {
 protected:
  void SetUp() override {
    const char* shared = std::getenv("OLS_SHARED");
    const std::string tiles = std::string(shared != nullptr ? shared : "") + "/data/terrain/";
    if (!std::filesystem::is_directory(tiles)) GTEST_SKIP() << "OLS_SHARED is not set";
    for (const char* tile : {"N38W028", "N38W029", "N39W028", "N39W029"}) {
      options_.elevation.push_back(tiles + tile + ".SRTMGL3.hgt.zip");
    }
    options_.heights = "";
    options_.latitude_deg = 38.65;
    options_.longitude_deg = -28.3;
    options_.radius_km = 60.0;
    notes_ = import();
    land_ = read_terrain_folder(options_.output).terrain;
  }

  std::string notes_;
  std::shared_ptr<const Terrain> land_;
};

TEST_F(RealLandTest, TheSummitIsWhereItIs) {
  EXPECT_NE(notes_.find("with equal heights"), std::string::npos) << notes_;
  // Its highest height, 2304 m above the geoid.
  const double latitude_deg = 38.0 + 562.0 / 1200.0, longitude_deg = -29.0 + 721.0 / 1200.0;
  EXPECT_NEAR(land_->ground(radians(latitude_deg), radians(longitude_deg))->height_m,
              2304.0 + Geoid("egm96_15.gtx").height_m(latitude_deg, longitude_deg), 0.01);
}

// The land along exactly an azimuth: each distance with the highest elevation up to it.
class Profile {
 public:
  Profile(const Surface& land, const LocalFrame& camera, double azimuth_rad) {
    double highest_rad = -kPi;
    for (double d = 1.0; d < 30'500.0; d += std::max(1.0, 0.0005 * d)) {
      Geodetic place = place_at(camera, azimuth_rad, d, 0.0);
      const auto top = land.top(place.latitude_rad, place.longitude_rad);
      if (top) {
        place.height_m = top->height_m;
        highest_rad = std::max(highest_rad, see(camera, place).direction.elevation_rad);
      }
      steps_.emplace_back(d, highest_rad);
    }
  }
  double highest_before(double distance_m) const {
    const auto after = std::ranges::lower_bound(steps_, distance_m, {}, &Pair::first);
    return after == steps_.begin() ? -kPi : after[-1].second;
  }

 private:
  using Pair = std::pair<double, double>;
  std::vector<Pair> steps_;
};

// 10^5 points. Where map and profile disagree, the point is within a cell of what limits its view.
TEST_F(RealLandTest, SeesWhatAProfileOfEverySampleSees) {
  Geodetic camera{radians(38.53), radians(-28.53), 0.0};
  camera.height_m = land_->ground(camera.latitude_rad, camera.longitude_rad)->height_m + 15.0;
  const LocalFrame frame(camera);
  constexpr double kColumn_rad = 2.0 * kPi / 7200;
  std::mt19937 random(42);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  int visible = 0, points = 0, wrong = 0;
  for (int i = 0; i < 200; ++i) {
    const double azimuth_rad = 2.0 * kPi * share(random);
    const HorizonMap map(
        *land_, camera,
        {.from_azimuth_rad = azimuth_rad - kColumn_rad, .sector_rad = 2.0 * kColumn_rad});
    const Profile left(*land_, frame, azimuth_rad - 0.5 * kColumn_rad),
        right(*land_, frame, azimuth_rad + 0.5 * kColumn_rad), own(*land_, frame, azimuth_rad);
    for (int k = 0; k < 500; ++k) {
      const double d = 50.0 + 29'900.0 * share(random), cell_m = std::max(1.0, kColumn_rad * d);
      Geodetic place = place_at(frame, azimuth_rad, d, 0.0);
      const auto top = land_->top(place.latitude_rad, place.longitude_rad);
      if (!top) continue;
      place.height_m = top->height_m + 1.0 + 300.0 * std::pow(share(random), 3);
      place = place_at(frame, azimuth_rad, d, place.height_m);
      const double elevation_rad = see(frame, place).direction.elevation_rad;
      const auto of_all = [&](double at_m) {
        return std::minmax(
            {left.highest_before(at_m), own.highest_before(at_m), right.highest_before(at_m)});
      };
      const bool is_visible =
          map.visible_probability(ecef_from_geodetic(place), Eigen::Matrix3d::Zero()) > 0.5;
      ++points;
      visible += is_visible;
      wrong += is_visible ? elevation_rad < of_all(d - cell_m).first
                          : elevation_rad > of_all(d + cell_m).second;
    }
  }
  EXPECT_EQ(wrong, 0) << "of " << points;
  EXPECT_GT(points, 90'000);
  EXPECT_GT(visible, points / 5);
  EXPECT_LT(visible, points - points / 5);
}

}  // namespace
}  // namespace ols::land
