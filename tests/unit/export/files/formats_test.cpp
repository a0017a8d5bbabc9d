#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "export/files/courageous.h"
#include "export/files/document.h"
#include "export/files/geojson.h"
#include "export/files/gpx.h"
#include "export/files/kml.h"
#include "export/files/picture.h"
#include "tests/unit/export/made_records.h"

namespace ols::exports {
namespace {

using testing::HasSubstr;

TEST(DocumentEncoder, WritesAtItsTurnsAndSendsCompanionsOnce) {
  DocumentEncoder encoder({},
                          [](const Picture& picture) {
                            return picture.is_empty() ? std::string()
                                                      : std::to_string(picture.tracks().size());
                          },
                          "-live", {{"link", "other"}});
  const Packets first = encoder.due(kNow_us);
  ASSERT_EQ(first.size(), 1U);
  EXPECT_EQ(first[0].bytes, "other");
  EXPECT_TRUE(encoder.encode(made_target()).empty());
  const Packets second = encoder.due(kNow_us);
  ASSERT_EQ(second.size(), 1U);
  EXPECT_EQ(second[0].bytes, "1");
  EXPECT_EQ(second[0].where, "-live");
  encoder.begin_again();
  EXPECT_EQ(encoder.due(kNow_us).size(), 2U);
}

constexpr std::int64_t kSecond_us = 1'000'000;

TEST(Picture, AnEndAddsNoPoint) {
  Picture picture;
  picture.take(made_target());
  Target end = made_target(7, kSecond_us);
  end.state = TrackState::kEnded;
  picture.take(end);
  const Track& track = picture.tracks().at(end.uid);
  EXPECT_EQ(track.points.size(), 1U);
  EXPECT_EQ(track.last.state, TrackState::kEnded);
}

TEST(Picture, ForgetsWhatIsOlderThanItsHistory) {
  Picture picture({.history_s = 10.0});
  for (int i = 0; i < 20; ++i) picture.take(made_target(7, i * kSecond_us));
  picture.take(made_line());
  picture.forget(kNow_us + 20 * kSecond_us);
  EXPECT_EQ(picture.tracks().begin()->second.points.size(), 10U);
  EXPECT_TRUE(picture.lines().empty());
  picture.forget(kNow_us + 40 * kSecond_us);
  EXPECT_TRUE(picture.is_empty());
}

TEST(Picture, WithoutAHistoryWhatIsLiveStays) {
  Picture picture({.history_s = 0.0});
  picture.take(made_target());
  picture.take(made_line());
  picture.forget(kNow_us + kSecond_us);
  EXPECT_EQ(picture.tracks().size(), 1U);
  EXPECT_EQ(picture.lines().size(), 1U);
}

TEST(Picture, AStationThatIsSilentForMinutesGoes) {
  Picture picture({.history_s = 10.0});
  picture.take(made_station());
  const std::int64_t then_us = picture.stations().begin()->second.utime_us;
  picture.forget(then_us + 200 * kSecond_us);
  EXPECT_EQ(picture.stations().size(), 1U);
  picture.forget(then_us + 301 * kSecond_us);
  EXPECT_TRUE(picture.stations().empty());
}

TEST(Picture, WhatHasNoHeightAboveTheSeaIsLeftOutWhereItIsNeeded) {
  Picture picture({.needs_sea = true});
  Target target = made_target();
  target.place.geoid_m = kUnknown;
  picture.take(target);
  EXPECT_TRUE(picture.is_empty());
  picture.take(made_target());
  EXPECT_EQ(picture.tracks().size(), 1U);
}

TEST(Picture, KeepsEveryPointOfItsHistoryWhileThereIsRoom) {
  Picture picture({.history_s = 60.0, .most_points = 2000});
  for (int i = 0; i < 600; ++i) {
    picture.take(made_target(7, i * kSecond_us / 10));
    picture.take(made_target(8, i * kSecond_us / 10));
  }
  for (const auto& [uid, track] : picture.tracks()) EXPECT_EQ(track.points.size(), 600U);
}

TEST(Picture, ManyTracksShareTheRoomAndKeepTheirNewestPoints) {
  constexpr int kTracks = 10;
  Picture picture({.history_s = 60.0, .most_points = 60 * kTracks});
  for (int i = 0; i < 600; ++i) {
    for (int id = 1; id <= kTracks; ++id) picture.take(made_target(id, i * kSecond_us / 10));
  }
  for (const auto& [uid, track] : picture.tracks()) {
    EXPECT_LE(track.points.size(), 62U);
    EXPECT_GE(track.points.size(), 50U);
    EXPECT_EQ(track.points.back().utime_us, kNow_us + 599 * kSecond_us / 10);
  }
}

TEST(Picture, ALineEndsWhereItPoints) {
  const Place end = end_of(made_line(), 10'000.0);  // east, 2 degrees up
  EXPECT_NEAR(end.latitude_deg, 47.4, 1e-4);
  // 10 km * cos(2 deg) on a parallel of 4 329 km radius.
  EXPECT_NEAR(end.longitude_deg - 13.2, 0.1323, 2e-4);
  // 349 m by the angle, 7.8 m by the Earth's curvature.
  EXPECT_NEAR(end.height_m, 601.0 + 349.0 + 7.8, 0.2);
}

TEST(ExportGeoJson, HeightsAreAboveTheEllipsoid) {
  Picture picture;
  picture.take(made_target());
  picture.take(made_target(7, 1'000'000));
  picture.take(made_station());
  picture.take(made_line());
  const auto document = nlohmann::json::parse(geojson(picture, 5000.0));
  const auto& features = document.at("features");
  ASSERT_EQ(features.size(), 4U);
  EXPECT_EQ(features[0].at("geometry").at("coordinates"),
            nlohmann::json::parse("[13.25, 47.5, 100.0]"));
  EXPECT_EQ(features[0].at("properties").at("height_above_sea_m"), 54.0);
  EXPECT_EQ(features[0].at("properties").at("height_above_ground_m"), 12.3);
  EXPECT_EQ(features[0].at("properties").at("height_above_ground_sd_m"), 1.6);
  EXPECT_EQ(features[0].at("properties").at("covariance_enu_m2"),
            nlohmann::json::parse("[4.0, 1.0, 0.0, 9.0, 0.0, 25.0]"));
  EXPECT_EQ(features[1].at("geometry").at("type"), "LineString");
  EXPECT_EQ(features[1].at("properties").at("coordTimes"),
            nlohmann::json::parse(R"(["2023-11-14T22:13:20.123Z", "2023-11-14T22:13:21.123Z"])"));
  EXPECT_EQ(features[2].at("properties").at("kind"), "station");
  EXPECT_EQ(features[3].at("properties").at("kind"), "line");
}

TEST(ExportGeoJson, WhatIsUnknownIsNull) {
  Picture picture;
  Target target = made_target();
  target.place.geoid_m = target.above_ground_m = kUnknown;
  target.velocity_enu_m_s.fill(kUnknown);
  picture.take(target);
  const auto properties =
      nlohmann::json::parse(geojson(picture, 1.0)).at("features")[0].at("properties");
  EXPECT_TRUE(properties.at("height_above_sea_m").is_null());
  EXPECT_TRUE(properties.at("height_above_ground_m").is_null());
  EXPECT_TRUE(properties.at("speed_m_s").is_null());
}

TEST(ExportGpx, HeightsAreAboveTheSeaAndTheGeoidIsNamed) {
  Picture picture;
  picture.take(made_target());
  picture.take(made_station());
  const std::string text = gpx(picture);
  EXPECT_THAT(text, HasSubstr("<trkpt lat=\"47.50000000\" lon=\"13.25000000\"><ele>54.00</ele>"
                              "<time>2023-11-14T22:13:20.123Z</time>"
                              "<geoidheight>46.00</geoidheight></trkpt>"));
  EXPECT_THAT(text, HasSubstr("<wpt lat=\"47.40000000\""));
}

TEST(ExportGpx, APauseBeginsANewSegment) {
  Picture picture;
  for (const std::int64_t after_s : {0, 1, 2, 8, 9}) {
    picture.take(made_target(7, after_s * 1'000'000));
  }
  const std::string text = gpx(picture);
  EXPECT_THAT(text, HasSubstr("</trkseg><trkseg>"));
  EXPECT_EQ(text.find("</trkseg><trkseg>"), text.rfind("</trkseg><trkseg>"));
}

TEST(ExportKml, HeightsAreAboveTheSea) {
  Picture picture;
  picture.take(made_target());
  picture.take(made_station());
  picture.take(made_line());
  const std::string text = kml(picture, 5000.0);
  EXPECT_THAT(text, HasSubstr("<gx:coord>13.25000000 47.50000000 54.00</gx:coord>"));
  EXPECT_THAT(text, HasSubstr("<when>2023-11-14T22:13:20.123Z</when>"));
  EXPECT_THAT(text, HasSubstr("13.20000000,47.40000000,554.00"));
  EXPECT_THAT(text, HasSubstr("<altitudeMode>absolute</altitudeMode>"));
  EXPECT_THAT(text, HasSubstr("<Data name=\"height_sd_m\"><value>5.00</value></Data>"));
}

TEST(ExportKml, ALinkNamesTheOtherFile) {
  const std::string text = kml_link("a&b-live.kml", 0.5);
  EXPECT_THAT(text, HasSubstr("<href>a&amp;b-live.kml</href>"));
  EXPECT_THAT(text, HasSubstr("<refreshInterval>0.50</refreshInterval>"));
}

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
