#include "export/home/home_encoder.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/unit/export/made_records.h"

namespace ols::exports {
namespace {

nlohmann::json json_of(const Packet& packet) { return nlohmann::json::parse(packet.bytes); }

TEST(HomeEncoder, ATargetHasASlotAsLongAsItIsThere) {
  HomeEncoder encoder({.slots = 1}, "brno");
  const Packets first = encoder.encode(made_target(1));
  ASSERT_EQ(first.size(), 2U);
  EXPECT_EQ(first[0].where, "ols/targets");
  EXPECT_FALSE(first[0].is_retained);
  EXPECT_EQ(first[1].where, "ols/target/1");
  EXPECT_TRUE(first[1].is_retained);
  EXPECT_EQ(json_of(first[1]).at("height_above_sea_m"), 54.0);
  EXPECT_EQ(json_of(first[1]).at("height_ellipsoid_m"), 100.0);
  EXPECT_EQ(encoder.encode(made_target(2)).size(), 1U) << "no slot is free";
  Target end = made_target(1);
  end.state = TrackState::kEnded;
  EXPECT_EQ(json_of(encoder.encode(end)[1]).at("state"), "none");
  EXPECT_EQ(encoder.encode(made_target(2)).size(), 2U);
}

TEST(HomeEncoder, EntitiesAreToldOnceAndAgainToANewBroker) {
  HomeEncoder encoder({.slots = 2}, "brno");
  const Packets told = encoder.turn(0);
  ASSERT_EQ(told.size(), 14U);  // six entities and the free slot, twice
  EXPECT_EQ(told[0].where, "homeassistant/device_tracker/brno_target_1/config");
  EXPECT_EQ(json_of(told[0]).at("availability_topic"), "ols/status");
  EXPECT_TRUE(encoder.turn(0).empty());
  EXPECT_EQ(encoder.encode(made_station()).size(), 5U);
  EXPECT_EQ(encoder.encode(made_station()).size(), 1U);
  encoder.encode(made_target());
  encoder.begin_again();
  EXPECT_EQ(encoder.turn(0).size(), 13U) << "a slot that is taken is not told to be free";
  EXPECT_EQ(encoder.encode(made_station()).size(), 5U);
}

TEST(HomeEncoder, NamesAreMadeFitForTopics) {
  EXPECT_EQ(topic_word("al/fa +#"), "al_fa___");
  Station station = made_station();
  station.name = "a/b";
  HomeEncoder encoder({}, "brno");
  EXPECT_EQ(encoder.encode(station).back().where, "ols/station/a_b");
}

TEST(HomeEncoder, JsonIsFlat) {
  HomeEncoder encoder({}, "brno");
  for (const Packet& packet :
       {encoder.encode(made_target())[0], encoder.encode(made_station()).back(),
        encoder.encode(made_line())[0]}) {
    for (const auto& value : json_of(packet)) EXPECT_FALSE(value.is_structured()) << packet.bytes;
  }
}

}  // namespace
}  // namespace ols::exports
