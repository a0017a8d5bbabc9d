#include <gtest/gtest.h>

#include "tests/unit/on_the_bus.h"
#include "wire/fusion_status.h"
#include "wire/station_status.h"
#include "wire/target.h"

namespace ols::wire {
namespace {

ols_msg::station_status_t of_alfa() {
  auto status = made<ols_msg::station_status_t>();
  status.station = "alfa";
  return status;
}

TEST(HeardStatus, IsOfTheStationWhoseChannelItIsOn) {
  EXPECT_EQ(decode_status(on("OLS_STATUS_alfa", of_alfa()))->station, "alfa");
  EXPECT_FALSE(decode_status(on("OLS_STATUS_bravo", of_alfa())));
}

TEST(HeardStatus, IsOfThisSchemaAndWhole) {
  ols_msg::station_status_t other = of_alfa();
  ++other.schema_version;
  EXPECT_FALSE(decode_status(on("OLS_STATUS_alfa", other)));
  BusMessage cut = on("OLS_STATUS_alfa", of_alfa());
  cut.payload.pop_back();
  EXPECT_FALSE(decode_status(cut));
}

TEST(HeardFusionStatus, MovesNoCursorAndIsOfThisSchema) {
  auto status = made<ols_msg::fusion_status_t>();
  status.cues = 1;
  status.cue_id = {"tak.\x1b[2J"};
  status.cue_label.resize(1);
  status.cue_state = {ols_msg::fusion_status_t::CUE_SEARCHED};
  status.cue_target_id.resize(1);
  for (auto* values :
       {&status.cue_age_s, &status.cue_latitude_deg, &status.cue_longitude_deg,
        &status.cue_height_m, &status.cue_horizontal_sd_m, &status.cue_vertical_sd_m}) {
    values->resize(1);
  }
  const auto heard = decode_fusion_status(on("OLS_FUSION_STATUS", status));
  ASSERT_TRUE(heard);
  EXPECT_EQ(heard->cue_id.at(0), "tak.?[2J");
  EXPECT_STREQ(cue_state_name(heard->cue_state.at(0)), "searched");
  ++status.schema_version;
  EXPECT_FALSE(decode_fusion_status(on("OLS_FUSION_STATUS", status)));
}

TEST(HeardStatus, MovesNoCursor) {
  ols_msg::station_status_t status = of_alfa();
  status.last_error = "a\x1b[2J";
  status.alarm = {"b\nc"};
  status.alarms = 1;
  const auto heard = decode_status(on("OLS_STATUS_alfa", status));
  ASSERT_TRUE(heard);
  EXPECT_EQ(heard->last_error, "a?[2J");
  EXPECT_EQ(heard->alarm.at(0), "b?c");
}

// As a log of before has it (lcmtypes/README.md).
TEST(HeardTarget, OfBeforeItGrewLacksWhatItDidNotSay) {
  ols_msg::target_v1_t former{};
  former.target_id = 7;
  former.estimator = "filter";
  former.latitude_deg = 49.0;
  former.stations = 1;
  former.station = {"alfa"};
  former.used = {1};
  former.weight = {0.5};
  former.age_s = {0.25};
  former.schema_version = ols_msg::target_t::SCHEMA_VERSION;
  BusMessage message = on("OLS_TARGET", former);
  const auto target = decode_target(message);
  ASSERT_TRUE(target);
  EXPECT_EQ(target->estimator, "filter");
  EXPECT_EQ(target->age_s, std::vector{0.25});
  EXPECT_EQ(object_class_of(target->object_class), ObjectClass::kUnknown);
  EXPECT_EQ(target->size_m, 0.0);
  EXPECT_FALSE(target->has_height_above_ground);
  EXPECT_TRUE(has_position(*target));
  message.payload.push_back(0);
  EXPECT_FALSE(decode_target(message)) << "more than the message";
  message.payload.resize(message.payload.size() - 2);
  EXPECT_FALSE(decode_target(message)) << "cut";
}

}  // namespace
}  // namespace ols::wire
