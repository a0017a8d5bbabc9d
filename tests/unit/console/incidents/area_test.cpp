#include "console/incidents/area.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include "geometry/angles.h"

namespace ols::console {
namespace {

using Json = nlohmann::json;

Json json_with(const Json& changes) {
  Json json =
      Json::parse(R"({"name": "Gate", "polygon": [[11.0, 48.0], [11.01, 48.0], [11.01, 48.01],
      [11.0, 48.01]], "lowest_m": 500, "highest_m": 900, "classes": [], "from": "00:00",
      "to": "00:00"})");
  json.update(changes);
  return json;
}
Area area_with(const Json& changes = Json::object()) { return area_from(json_with(changes)); }

double probability(const Area& area, double longitude_deg, double latitude_deg, double height_m,
                   double sd_m = 1.0) {
  return probability_inside(area, {radians(latitude_deg), radians(longitude_deg), height_m},
                            sd_m * sd_m * Eigen::Matrix3d::Identity())
      .value_or(-1.0);
}

TEST(Area, ContainsWhatIsInsideAtAnyOrderOfCornersAndOnBothSidesOfTheAntimeridian) {
  // A square, in each direction; an L whose inner corner is in its middle; both on the
  // antimeridian.
  const Json square = Json::parse("[[-1, -1], [1, -1], [1, 1], [-1, 1]]");
  Json clockwise = square;
  std::reverse(clockwise.begin(), clockwise.end());
  const Json l = Json::parse("[[-1, -1], [1, -1], [1, 0], [0, 0], [0, 1], [-1, 1]]");
  struct Case {
    Json polygon;  // [hundredths of a degree]
    double east, north, height_m, expected;
  };
  for (const Case& c :
       {Case{square, 0, 0, 700, 1.0}, Case{clockwise, 0, 0, 700, 1.0},
        Case{square, 1.1, 0, 700, 0.0}, Case{clockwise, 0, -1.1, 700, 0.0},
        Case{square, 1, 0, 700, 0.5}, Case{square, 1, 1, 700, 0.25}, Case{square, 0, 0, 900, 0.5},
        Case{square, 0, 0, 490, 0.0}, Case{l, 0, 0, 700, 0.75}, Case{l, 0.5, 0.5, 700, 0.0},
        Case{l, 0.5, -0.5, 700, 1.0}, Case{l, 3000, 0, 700, 0.0}}) {
    for (const double longitude_deg : {11.0, 180.0, -180.0}) {
      Json polygon = c.polygon;
      for (Json& corner : polygon) {
        corner = {std::remainder(longitude_deg + 0.01 * corner[0].get<double>(), 360.0),
                  -35.0 + 0.01 * corner[1].get<double>()};
      }
      EXPECT_NEAR(probability(area_with({{"polygon", polygon}}), longitude_deg + 0.01 * c.east,
                              -35.0 + 0.01 * c.north, c.height_m),
                  c.expected, 1e-4)
          << polygon << " " << c.east << " " << c.north << " " << c.height_m;
    }
  }
}

// Another way to the same: random positions, and whether a line from each crosses the border an odd
// number of times.
TEST(Area, ProbabilityIsThatOfRandomPositionsOnTheEllipsoid) {
  constexpr unsigned kSeed = 40;
  constexpr int kSamples = 20'000;
  RecordProperty("seed", static_cast<int>(kSeed));
  std::mt19937 random(kSeed);
  std::normal_distribution<double> normal;
  const Area area = area_with(
      {{"polygon",
        {{20.0, 70.0}, {20.01, 70.0}, {20.004, 70.002}, {20.01, 70.004}, {20.0, 70.004}}}});
  Eigen::Matrix3d covariance;
  covariance << 1e4, -8e3, 0, -8e3, 2e4, 0, 0, 0, 1e4;
  const Eigen::Matrix3d root = covariance.llt().matrixL();
  const auto is_inside = [&](const Geodetic& at) {
    bool inside = at.height_m > area.lowest_m && at.height_m < area.highest_m;
    bool is_odd = false;
    const double x = degrees(at.longitude_rad), y = degrees(at.latitude_rad);
    for (std::size_t i = 0; i < area.corners_deg.size(); ++i) {
      const auto [ax, ay] = area.corners_deg[i];
      const auto [bx, by] = area.corners_deg[(i + 1) % area.corners_deg.size()];
      if ((ay > y) != (by > y) && x < ax + (y - ay) / (by - ay) * (bx - ax)) is_odd = !is_odd;
    }
    return inside && is_odd;
  };
  for (const Geodetic& mean : {Geodetic{radians(70.001), radians(20.003), 700.0},
                               Geodetic{radians(70.002), radians(20.006), 850.0}}) {
    const LocalFrame frame(mean);
    int inside = 0;
    for (int i = 0; i < kSamples; ++i) {
      const Eigen::Vector3d draw(normal(random), normal(random), normal(random));
      inside += is_inside(geodetic_from_ecef(frame.to_ecef(root * draw))) ? 1 : 0;
    }
    const double share = inside / static_cast<double>(kSamples);
    const double sd = std::sqrt(share * (1.0 - share) / kSamples);
    EXPECT_NEAR(probability_inside(area, mean, covariance).value(), share, 4.0 * sd)
        << "seed " << kSeed;
  }
}

TEST(Area, WhatIsNoPositionIsNeitherInsideNorOutside) {
  EXPECT_EQ(probability(area_with(), NAN, 48.0, 700.0), -1.0);
  EXPECT_EQ(probability(area_with(), 11.005, 48.005, 700.0, NAN), -1.0);
  for (const Eigen::Vector3d& variances :
       {Eigen::Vector3d(-1, 1, 1), Eigen::Vector3d(1, -1, 1), Eigen::Vector3d(1, 1, -1)}) {
    EXPECT_FALSE(probability_inside(area_with(), {radians(48.005), radians(11.005), 700.0},
                                    variances.asDiagonal()));
  }
}

TEST(Area, IsWatchedAtItsTimeAlsoOverMidnight) {
  struct Case {
    const char *from, *to;
    int minute;
    bool expected;
  };
  for (const Case& c : {Case{"00:00", "00:00", 720, true}, Case{"08:00", "16:30", 479, false},
                        Case{"08:00", "16:30", 480, true}, Case{"08:00", "16:30", 990, false},
                        Case{"22:00", "06:00", 1319, false}, Case{"22:00", "06:00", 1320, true},
                        Case{"22:00", "06:00", 0, true}, Case{"22:00", "06:00", 360, false}}) {
    EXPECT_EQ(is_watched(area_with({{"from", c.from}, {"to", c.to}}), c.minute), c.expected)
        << c.from << " " << c.to << " " << c.minute;
  }
}

TEST(Area, ConcernsItsClassesOrAll) {
  EXPECT_TRUE(concerns(area_with(), "bird"));
  const Area drones = area_with({{"classes", {"drone", "unknown"}}});
  EXPECT_TRUE(concerns(drones, "unknown"));
  EXPECT_FALSE(concerns(drones, "bird"));
}

TEST(Area, IsWrittenAsItIsRead) {
  const Json json = json_with({{"classes", {"drone"}}, {"from", "22:05"}, {"to", "06:00"}});
  EXPECT_EQ(json_of(area_from(json)), json);
}

TEST(Area, RefusesWhatIsNone) {
  struct Case {
    Json changes;
    const char* why;
  };
  for (const Case& c : {
           Case{{{"name", ""}}, "name must be a text of 1 to 40 bytes"},
           Case{{{"name", "a\nb"}}, "name must be a text of 1 to 40 bytes"},
           Case{{{"polygon", {{1, 2}, {3, 4}}}}, "polygon must have 3 to 100 corners"},
           Case{{{"polygon", {{1, 2}, {3, 4}, {5}}}},
                "each corner of polygon must be [longitude, latitude]"},
           Case{{{"polygon", {{1, 2}, {3, 4}, {5, 86}}}},
                "a corner's latitude must be a number within -85.0 and 85.0"},
           Case{{{"polygon", {{0, 0}, {1, 1}, {1, 0}, {0, 1}}}}, "polygon crosses itself"},
           Case{{{"polygon", {{0, 0}, {1, 1}, {2, 2}}}}, "polygon encloses nothing"},
           Case{{{"polygon", {{0, 0}, {20, 0}, {0, 1}}}}, "polygon is too large"},
           Case{{{"lowest_m", "0"}}, "lowest_m must be a number within -1000.0 and 100000.0"},
           Case{{{"lowest_m", 900}}, "highest_m must be above lowest_m"},
           Case{{{"classes", {"dragon"}}}, "unknown class \"dragon\""},
           Case{{{"from", "24:00"}}, "from must be a time of day, as 22:30"},
           Case{{{"to", "6:00"}}, "to must be a time of day, as 22:30"},
           Case{{{"colour", 1}}, "unknown key \"colour\""},
       }) {
    try {
      area_with(c.changes);
      ADD_FAILURE() << c.changes;
    } catch (const std::invalid_argument& error) {
      EXPECT_STREQ(error.what(), c.why);
    }
  }
}

}  // namespace
}  // namespace ols::console
