#include "export/files/courageous.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "tests/unit/export/made_records.h"

namespace ols::exports {
namespace {

TEST(Courageous, TracksAndDetections) {
  Picture picture;
  picture.take(made_target());
  picture.take(made_station());
  picture.take(made_line());
  const auto document = nlohmann::json::parse(courageous(picture, "brno", {}));
  const auto& record = document.at("tracks")[0].at("records")[0];
  EXPECT_EQ(record.at("location").at("$type"), "Position3d");
  EXPECT_EQ(record.at("location").at("height_amsl"), 54.0);
  EXPECT_EQ(record.at("time"), 1'700'000'000'123);
  EXPECT_EQ(record.at("velocity").at("up"), -1.5);
  const auto& seen = document.at("detection")[0].at("records")[0];
  EXPECT_EQ(seen.at("location").at("bearing"), 90.0);
  EXPECT_EQ(seen.at("cuas_location").at("height_amsl"), 555.0);
  EXPECT_EQ(document.at("static_cuas_location").at("height_amsl"), 554.0);
}

TEST(Courageous, TargetsOfSeveralRunsOfTheFusionHaveNumbersOfTheirOwn) {
  Picture picture;
  picture.take(made_station());
  std::set<std::uint64_t> numbers;
  for (const char* uid : {"brno.target.1.1", "brno.target.2.1", "brno.target.3.1"}) {
    Target target = made_target(1);
    target.uid = uid;
    picture.take(target);
    const auto document = nlohmann::json::parse(courageous(picture, "brno", {}));
    for (const auto& track : document.at("tracks"))
      numbers.insert(track.at("uas_id").get<std::uint64_t>());
  }
  EXPECT_EQ(numbers.size(), 3U) << "each has one, and keeps it";
  EXPECT_LT(*numbers.rbegin(), std::uint64_t{1} << 53U);
}

TEST(Courageous, ATargetsPlaceIsNeverThatOfTheSystem) {
  Picture picture;
  EXPECT_EQ(courageous(picture, "brno", {50.0, 14.0, 300.0}), "") << "nothing is known yet";
  picture.take(made_target());
  EXPECT_EQ(courageous(picture, "brno", {}), "");
  const auto document = nlohmann::json::parse(courageous(picture, "brno", {50.0, 14.0, 300.0}));
  EXPECT_EQ(document.at("static_cuas_location"),
            nlohmann::json::parse(R"({"lat": 50.0, "lon": 14.0, "height_amsl": 300.0})"));
}

}  // namespace
}  // namespace ols::exports
