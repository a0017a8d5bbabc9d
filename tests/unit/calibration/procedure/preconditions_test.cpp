#include "calibration/procedure/preconditions.h"

#include <gtest/gtest.h>

#include <functional>

#include "conditions/alarms.h"

namespace ols::calibration {
namespace {

StationFacts good() {
  StationFacts facts;
  facts.camera_works = facts.unit_works = facts.limits_known = true;
  facts.has_position = facts.has_tilt = facts.clock_synchronised = true;
  facts.clock_error_s = 0.001;
  facts.image_width_px = 1280;
  facts.image_height_px = 960;
  return facts;
}
const Wanted kWanted{0.8, false, false, 1280, 960};

TEST(Preconditions, AStationInOrderMayBegin) {
  EXPECT_EQ(first_hindrance(preconditions(good(), kWanted)), "");
}

TEST(Preconditions, EachHindranceIsNamed) {
  const std::vector<std::pair<std::function<void(StationFacts&)>, std::string>> cases{
      {[](StationFacts& f) { f.emergency = true; }, "emergency stop"},
      {[](StationFacts& f) { f.stopped = true; }, "stopped"},
      {[](StationFacts& f) { f.held_by_hand = true; }, "manual operation: release it"},
      {[](StationFacts& f) { f.status_gap_s = 2.0; }, "status comes every 2.0 s"},
      {[](StationFacts& f) { f.follows_target = true; }, "follows a target"},
      {[](StationFacts& f) { f.unit_works = false; }, "pan-tilt unit does not work"},
      {[](StationFacts& f) { f.moves = false; }, "mount is fixed"},
      {[](StationFacts& f) { f.limits_known = false; }, "home it"},
      {[](StationFacts& f) { f.camera_works = false; }, "camera does not work"},
      {[](StationFacts& f) { f.image_width_px = 640; }, "640 x 960"},
      {[](StationFacts& f) { f.has_position = false; }, "position is not known"}};
  for (const auto& [spoil, word] : cases) {
    StationFacts facts = good();
    spoil(facts);
    EXPECT_NE(first_hindrance(preconditions(facts, kWanted)).find(word), std::string::npos) << word;
  }
}

TEST(Preconditions, ADeviceOfAnotherSerialNumberIsNamed) {
  StationFacts facts = good();
  facts.alarms = {{"disk: full"}, alarm::other_device("camera", "C8", "C7")};
  EXPECT_EQ(first_hindrance(preconditions(facts, kWanted))
                .find("another camera than configured: it says 'C8', [serials] has 'C7': correct"),
            0U);
}

TEST(Preconditions, TheClockMattersForTheSkyOnly) {
  StationFacts facts = good();
  facts.clock_synchronised = false;
  EXPECT_EQ(first_hindrance(preconditions(facts, kWanted)), "");
  Wanted stars = kWanted;
  stars.absolute_time = true;
  EXPECT_NE(first_hindrance(preconditions(facts, stars)).find("not synchronised"),
            std::string::npos);
  facts = good();
  facts.clock_error_s = 0.3;
  EXPECT_NE(first_hindrance(preconditions(facts, stars)), "");
}

TEST(Preconditions, WhereTheSunIsUpTheHeadingMustBeKnown) {
  StationFacts facts = good();
  facts.heading_sd_deg = 10.0;
  EXPECT_EQ(first_hindrance(preconditions(facts, kWanted)), "") << "at night";
  Wanted by_day = kWanted;
  by_day.sun_kept_out = true;
  EXPECT_NE(first_hindrance(preconditions(facts, by_day)).find("known to 10 deg only"),
            std::string::npos);
  facts.heading_sd_deg = 0.5;
  EXPECT_EQ(first_hindrance(preconditions(facts, by_day)), "") << "a compass will do";
}

TEST(Preconditions, AnAlarmAndABubbleAreOnlySaid) {
  StationFacts facts = good();
  facts.has_tilt = false;
  facts.alarms = alarms_of({"disk: nearly full"});
  const auto all = preconditions(facts, kWanted);
  EXPECT_EQ(first_hindrance(all), "");
  EXPECT_NE(all.back().sentence.find("disk: nearly full"), std::string::npos);
}

}  // namespace
}  // namespace ols::calibration
