#include "export/mqtt/mqtt_encoder.h"

#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/unit/export/made_records.h"

namespace ols::exports {
namespace {

nlohmann::json json_of(const Packet& packet) { return nlohmann::json::parse(packet.bytes); }

TEST(MqttEncoder, ATargetHasASlotAsLongAsItIsThere) {
  MqttEncoder encoder({.slots = 1}, "brno");
  const Packets first = encoder.encode(made_target(1));
  ASSERT_EQ(first.size(), 2U);
  EXPECT_EQ(first[0].where, "ols/brno/targets");
  EXPECT_FALSE(first[0].is_retained);
  EXPECT_EQ(first[1].where, "ols/brno/target/1");
  EXPECT_TRUE(first[1].is_retained);
  EXPECT_EQ(json_of(first[1]).at("height_above_sea_m"), 54.0);
  EXPECT_EQ(json_of(first[1]).at("height_ellipsoid_m"), 100.0);
  EXPECT_EQ(json_of(first[1]).at("height_above_ground_m"), 12.3);
  EXPECT_EQ(encoder.encode(made_target(2)).size(), 1U) << "no slot is free";
  Target end = made_target(1);
  end.state = TrackState::kEnded;
  EXPECT_EQ(json_of(encoder.encode(end)[1]).at("state"), "none");
  EXPECT_EQ(encoder.encode(made_target(2)).size(), 2U);
}

TEST(MqttEncoder, AnIncidentSaysWhetherItIsAnAlarm) {
  MqttEncoder encoder({}, "brno");
  Incident incident = made_incident();
  const Packets packets = encoder.encode_incident(incident);
  ASSERT_EQ(packets.size(), 1U);
  EXPECT_EQ(packets[0].where, "ols/brno/incidents");
  EXPECT_FALSE(packets[0].is_retained);
  EXPECT_EQ(json_of(packets[0]).at("alarm"), "ON");
  EXPECT_EQ(json_of(packets[0]).at("area"), "Gate <1>");
  EXPECT_TRUE(json_of(packets[0]).at("ended").is_null());
  incident.ended_us = kNow_us;
  EXPECT_EQ(json_of(encoder.encode_incident(incident)[0]).at("alarm"), "OFF");
  EXPECT_EQ(json_of(encoder.encode_incident(incident)[0]).at("state"), "left");
}

TEST(MqttEncoder, EntitiesAreToldOnceAndAgainToANewBroker) {
  MqttEncoder encoder({.slots = 2}, "brno");
  const Packets told = encoder.due(0);
  ASSERT_EQ(told.size(), 18U);  // eight entities and the free slot, twice
  EXPECT_EQ(told[0].where, "homeassistant/device_tracker/brno_target_1/config");
  EXPECT_EQ(json_of(told[0]).at("availability_topic"), "ols/brno/status");
  EXPECT_TRUE(encoder.due(0).empty());
  EXPECT_EQ(encoder.encode(made_station()).size(), 5U);
  EXPECT_EQ(encoder.encode(made_station()).size(), 1U);
  encoder.encode(made_target());
  encoder.begin_again();
  EXPECT_EQ(encoder.due(0).size(), 17U) << "a slot that is taken is not told to be free";
  EXPECT_EQ(encoder.encode(made_station()).size(), 5U);
}

TEST(MqttEncoder, WhatIsOldNewsBecomesUnavailable) {
  MqttEncoder encoder({.stale_s = 12.0, .slots = 1}, "brno");
  Packets told = encoder.due(0);
  for (Packet& packet : encoder.encode(made_station())) told.push_back(std::move(packet));
  int expiring = 0;
  for (const Packet& packet : told) {
    if (!packet.where.ends_with("/config")) continue;
    const bool is_place = packet.where.find("device_tracker") != std::string::npos;
    EXPECT_EQ(json_of(packet).contains("expire_after"), !is_place) << packet.where;
    expiring += json_of(packet).value("expire_after", 0) == 12 ? 1 : 0;
  }
  EXPECT_EQ(expiring, 11);
  MqttEncoder never({.stale_s = 0.0, .slots = 1}, "brno");
  EXPECT_FALSE(json_of(never.due(0)[1]).contains("expire_after"));
  EXPECT_TRUE(never.due(3'600'000'000).empty());
}

TEST(MqttEncoder, AFreeSlotIsSaidAgainBeforeItIsOldNews) {
  MqttEncoder encoder({.stale_s = 12.0, .slots = 2}, "brno");
  encoder.due(0);
  encoder.encode(made_target());
  EXPECT_TRUE(encoder.due(3'900'000).empty());
  const Packets again = encoder.due(4'000'000);
  ASSERT_EQ(again.size(), 1U) << "the other one is taken";
  EXPECT_EQ(again[0].where, "ols/brno/target/2");
  EXPECT_EQ(json_of(again[0]).at("state"), "none");
  EXPECT_TRUE(encoder.due(5'000'000).empty());
  EXPECT_EQ(encoder.due(-3'600'000'000).size(), 1U) << "the clock was set back";
}

TEST(MqttEncoder, TwoSitesOnOneBrokerShareNoTopic) {
  std::set<std::string> of_one, of_both;
  for (const char* site : {"brno", "wien"}) {
    MqttEncoder encoder({}, site);
    Packets told = encoder.due(0);
    for (const auto& packets :
         {encoder.encode(made_target()), encoder.encode(made_station()),
          encoder.encode(made_line()), Packets{{"", "", status_topic({}, site)}}}) {
      told.insert(told.end(), packets.begin(), packets.end());
    }
    for (const Packet& packet : told) of_both.insert(packet.where);
    if (of_one.empty()) of_one = of_both;
  }
  EXPECT_EQ(of_both.size(), 2 * of_one.size());
}

TEST(MqttEncoder, EntitiesSayWhatTheyMeasureAndKeepTheirNames) {
  MqttEncoder encoder({.slots = 1}, "Brno.1");
  Packets told = encoder.due(0);
  for (Packet& packet : encoder.encode(made_station())) told.push_back(std::move(packet));
  std::map<std::string, std::string> classes;
  for (const Packet& packet : told) {
    if (!packet.where.ends_with("/config")) continue;
    const auto config = json_of(packet);
    const std::string id = config.at("unique_id");
    const std::string component = packet.where.substr(14, packet.where.find('/', 14) - 14);
    EXPECT_EQ(config.at("default_entity_id"), component + "." + id);
    EXPECT_FALSE(config.contains("object_id"));
    classes[id] = config.value("device_class", "");
    if (classes[id] != "enum") continue;
    const std::string now = id.ends_with("alfa_state") ? "tracking"
                            : id.ends_with("_class")   ? "drone"
                                                       : "none";
    EXPECT_NE(config.at("options").dump().find('"' + now + '"'), std::string::npos) << id;
    EXPECT_FALSE(config.contains("state_class"));
  }
  EXPECT_EQ(classes, (std::map<std::string, std::string>{
                         {"Brno_1_target_1", ""},
                         {"Brno_1_target_1_state", "enum"},
                         {"Brno_1_target_1_class", "enum"},
                         {"Brno_1_target_1_height_above_sea_m", "distance"},
                         {"Brno_1_target_1_height_above_ground_m", "distance"},
                         {"Brno_1_target_1_height_ellipsoid_m", "distance"},
                         {"Brno_1_target_1_speed_m_s", "speed"},
                         {"Brno_1_target_1_gps_accuracy", "distance"},
                         {"Brno_1_station_alfa_state", "enum"},
                         {"Brno_1_station_alfa_azimuth_deg", ""},
                         {"Brno_1_station_alfa_elevation_deg", ""},
                         {"Brno_1_station_alfa_problem", "problem"}}));
}

TEST(MqttEncoder, NamesAreMadeFitForTopics) {
  EXPECT_EQ(topic_word("al/fa +#"), "al_fa___");
  Station station = made_station();
  station.name = "a/b";
  MqttEncoder encoder({}, "brno");
  EXPECT_EQ(encoder.encode(station).back().where, "ols/brno/station/a_b");
}

TEST(MqttEncoder, JsonIsFlat) {
  MqttEncoder encoder({}, "brno");
  for (const Packet& packet :
       {encoder.encode(made_target())[0], encoder.encode(made_station()).back(),
        encoder.encode(made_line())[0]}) {
    for (const auto& value : json_of(packet)) EXPECT_FALSE(value.is_structured()) << packet.bytes;
  }
}

}  // namespace
}  // namespace ols::exports
