#include "console/incidents/incident_book.h"

#include <gtest/gtest.h>

#include "conditions/sayings.h"

namespace ols::console {
namespace {

const Json kGate = Json::parse(R"({"name": "Gate", "polygon": [[11.0, 48.0], [11.01, 48.0],
    [11.01, 48.01], [11.0, 48.01]], "lowest_m": 0, "highest_m": 900, "classes": [],
    "from": "00:00", "to": "00:00"})");

ReceivedTarget target_at(double latitude_deg, const std::string& state = "confirmed") {
  return {.what = ReceivedTarget::What::kPosition,
          .boot_id = -5,
          .id = "3",
          .fields = {{"state", state},
                     {"utime_us", 7},
                     {"class", "drone"},
                     {"class_probability", 0.9},
                     {"covariance_enu_m2", {1, 0, 0, 1, 0, 1}},
                     {"stations",
                      {{{"id", "alfa"}, {"used", true}}, {{"id", "bravo"}, {"used", false}}}}},
          .latitude_deg = latitude_deg,
          .longitude_deg = 11.005,
          .height_m = 100.0};
}

constexpr double kInside_deg = 48.005, kOutside_deg = 48.5;

struct Site {
  IncidentBook book{IncidentRecording{}};
  Picture picture{.station = "alfa",
                  .header = {{"utime_us", 8}, {"full_px", {1280, 960}}, {"box_px", {1, 2, 3, 4}}},
                  .bytes = "jpeg"};
  bool has_picture = true;

  Site() { EXPECT_EQ(book.change({.area = kGate}), ""); }
  void receive(const ReceivedTarget& target, double now_s = 0.0) {
    book.receive(target, 0, now_s);
    book.turn(now_s, [this](const std::string& station) {
      return has_picture && station == "alfa" ? &picture : nullptr;
    });
  }
};

TEST(IncidentBook, AnIncidentHasAlarmPictureAndRecordingsAtTheStationsThatSawIt) {
  Site site;
  site.has_picture = false;
  site.receive(target_at(kInside_deg, "tentative"));
  EXPECT_TRUE(site.book.alarms().empty());
  site.receive(target_at(kInside_deg));
  ASSERT_EQ(site.book.alarms().size(), 1U);
  EXPECT_EQ(site.book.alarms()[0].text, "area Gate: drone 3 is inside");
  const auto orders = site.book.take_recordings();
  ASSERT_EQ(orders.size(), 1U);
  EXPECT_EQ(orders[0].station, "alfa");
  EXPECT_EQ(orders[0].label, "incident-1");
  EXPECT_EQ(orders[0].after_s, IncidentRecording{}.after_s);
  EXPECT_EQ(site.book.picture(1), nullptr);
  site.has_picture = true;
  site.picture.header["utime_us"] = 7 - 1'000'001;
  site.receive(target_at(kInside_deg));
  EXPECT_EQ(site.book.picture(1), nullptr) << "it was taken long before";
  site.picture.header["utime_us"] = 7 - 1'000'000;
  site.receive(target_at(kInside_deg));
  EXPECT_EQ(*site.book.picture(1), "jpeg");
  EXPECT_EQ(site.book.watch().incidents().at(1).picture.at("box_px"), Json({1, 2, 3, 4}));
  const IncidentBook::News news = site.book.take_news();
  EXPECT_TRUE(news.areas);
  EXPECT_TRUE(news.incidents.contains(1));
  EXPECT_TRUE(news.pictures.contains(1));
  site.receive(target_at(kOutside_deg));
  site.receive(target_at(kOutside_deg), IncidentWatch::kLeaves_s);
  EXPECT_TRUE(site.book.alarms().empty());
  site.receive(target_at(kInside_deg));
  EXPECT_TRUE(site.book.take_recordings().empty()) << "it was recorded when it first came in";
}

TEST(IncidentBook, ADismissedOneIsNoAlarmAndADroppedOneHasLeft) {
  Site site;
  site.receive(target_at(kInside_deg));
  EXPECT_EQ(site.book.judge({1, Judgement::kDismissed}, "ana", 9), "");
  EXPECT_EQ(site.book.judge({2, Judgement::kDismissed}, "ana", 9), outcome::no_such_incident());
  EXPECT_TRUE(site.book.alarms().empty());
  EXPECT_TRUE(site.book.watch().incidents().at(1).is_inside());
  ReceivedTarget dropped = target_at(kInside_deg);
  dropped.what = ReceivedTarget::What::kDropped;
  site.receive(dropped);
  EXPECT_FALSE(site.book.watch().incidents().at(1).is_inside());
}

TEST(IncidentBook, RefusesChangesInWords) {
  Site site;
  Json bad = kGate;
  bad["from"] = "soon";
  EXPECT_EQ(site.book.change({.area = bad}),
            outcome::area_is_wrong("from must be a time of day, as 22:30"));
  EXPECT_EQ(site.book.change({.area = {}, .name = "Roof"}), outcome::no_such_area());
  EXPECT_EQ(site.book.change({.area = {}, .name = "Gate"}), "");
  EXPECT_TRUE(site.book.watch().areas().empty());
  for (std::size_t i = 0; i < IncidentWatch::kMostAreas; ++i) {
    Json area = kGate;
    area["name"] = std::to_string(i);
    EXPECT_EQ(site.book.change({.area = area}), "");
  }
  EXPECT_EQ(site.book.change({.area = kGate}), outcome::too_many_areas());
  site.book.resume({.areas = {}, .may_change_areas = false}, 0.0);
  EXPECT_EQ(site.book.change({.area = kGate}), outcome::areas_unreadable());
}

}  // namespace
}  // namespace ols::console
