#include "export/files/courageous.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/unit/export/made_records.h"

namespace ols::exports {
namespace {

TEST(Courageous, TracksAndDetections) {
  Picture picture;
  picture.take(made_target());
  picture.take(made_station());
  picture.take(made_line());
  const auto document = nlohmann::json::parse(courageous(picture, "brno"));
  const auto& record = document.at("tracks")[0].at("records")[0];
  EXPECT_EQ(record.at("location").at("$type"), "Position3d");
  EXPECT_EQ(record.at("location").at("height_amsl"), 54.0);
  EXPECT_EQ(record.at("time"), 1'700'000'000'123);
  EXPECT_EQ(record.at("velocity").at("up"), -1.5);
  EXPECT_EQ(document.at("tracks")[0].at("uas_id"), 7);
  const auto& seen = document.at("detection")[0].at("records")[0];
  EXPECT_EQ(seen.at("location").at("bearing"), 90.0);
  EXPECT_EQ(seen.at("cuas_location").at("height_amsl"), 555.0);
  EXPECT_EQ(document.at("static_cuas_location").at("height_amsl"), 554.0);
}

TEST(Courageous, NothingKnownIsNoDocument) { EXPECT_EQ(courageous(Picture{}, "brno"), ""); }

}  // namespace
}  // namespace ols::exports
