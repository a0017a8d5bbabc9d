#include "cue/cot_reader.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cue/text_time.h"
#include "export/tak/cot_text.h"

namespace ols::cues {
namespace {

const CotTypes kAll{"a-"};

std::string event(const std::string& detail = "", const std::string& point = "") {
  return "<?xml version='1.0'?><event version='2.0' uid='ANDROID-1' type='a-h-A-M' how='m-g' "
         "time='2026-11-23T10:15:30.250Z' start='2026-11-23T10:15:30.250Z' "
         "stale='2026-11-23T10:16:30Z'>" +
         (point.empty() ? "<point lat='49.2' lon='16.6' hae='410.5' ce='8.0' le='12.0'/>" : point) +
         "<detail>" + detail + "</detail></event>";
}

Report report(const Reading& reading) {
  const auto* found = std::get_if<Report>(&reading);
  if (found != nullptr) return *found;
  ADD_FAILURE() << to_string(std::get<Refused>(reading).why);
  return {};
}

Refusal refusal(const Reading& reading) {
  const auto* found = std::get_if<Refused>(&reading);
  return found == nullptr ? Refusal::kCount : found->why;
}

exports::CotEvent own_event() {
  exports::CotEvent event;
  event.type = "a-u-A";
  event.uid = "RADAR.7";
  event.how = "m-r";
  event.callsign = "seven";
  event.utime_us = 1'795'428'930'250'000;
  event.stale_us = event.utime_us + 10'000'000;
  event.point = {49.2, 16.6, 410.5, 0.0};
  event.ce_m = 8.0;
  event.le_m = 12.0;
  event.speed_m_s = 10.0;
  event.course_deg = 90.0;
  return event;
}

TEST(CotReader, AnEventAsXmlIsRead) {
  const Report found = report(cot_reading(
      event("<contact callsign='Anna &amp; Bob'/><track speed='20.0' course='180.0'/>"), kAll));
  EXPECT_EQ(found.name, "ANDROID-1");
  EXPECT_EQ(found.label, "Anna & Bob");
  EXPECT_EQ(found.utime_us, *utime_of_iso("2026-11-23T10:15:30.250Z"));
  EXPECT_EQ(found.stale_us, *utime_of_iso("2026-11-23T10:16:30Z"));
  EXPECT_EQ(found.latitude_deg, 49.2);
  EXPECT_EQ(found.longitude_deg, 16.6);
  EXPECT_EQ(found.height_m, 410.5);
  EXPECT_EQ(found.horizontal_sd_m, 8.0);
  EXPECT_EQ(found.vertical_sd_m, 12.0);
  ASSERT_TRUE(found.velocity_enu_m_s);
  EXPECT_NEAR((*found.velocity_enu_m_s)[0], 0.0, 1e-9);
  EXPECT_NEAR((*found.velocity_enu_m_s)[1], -20.0, 1e-9);
}

// Written by the encoder of ols-export, which others' programs have judged.
TEST(CotReader, BothEncodingsOfAnEventSayTheSame) {
  const exports::CotEvent sent = own_event();
  const auto mesh = exports::TakFraming::kMesh;
  for (const std::string& bytes : {cot_xml(sent), cot_protobuf(sent, mesh)}) {
    const Report found = report(cot_reading(bytes, kAll));
    EXPECT_EQ(found.name, "RADAR.7");
    EXPECT_EQ(found.label, "seven");
    EXPECT_EQ(found.utime_us, sent.utime_us);
    EXPECT_EQ(found.stale_us, sent.stale_us);
    EXPECT_DOUBLE_EQ(found.latitude_deg, 49.2);
    EXPECT_DOUBLE_EQ(found.height_m, 410.5);
    EXPECT_DOUBLE_EQ(found.vertical_sd_m.value_or(0.0), 12.0);
    ASSERT_TRUE(found.velocity_enu_m_s);
    EXPECT_NEAR((*found.velocity_enu_m_s)[0], 10.0, 1e-6);
  }
}

TEST(CotReader, WhatIsNotKnownIsNotInvented) {
  const Report found = report(cot_reading(
      event("", "<point lat='49.2' lon='16.6' hae='410.5' ce='9999999.0' le='9999999.0'/>"), kAll));
  EXPECT_FALSE(found.horizontal_sd_m);
  EXPECT_FALSE(found.vertical_sd_m);
  EXPECT_FALSE(found.velocity_enu_m_s);
  EXPECT_EQ(refusal(cot_reading(
                event("", "<point lat='49.2' lon='16.6' hae='9999999.0' ce='1' le='1'/>"), kAll)),
            Refusal::kNoHeight);
  // What is no number is not finite, which the desk refuses by name.
  const Report odd =
      report(cot_reading(event("", "<point lat='NaN' lon='x' hae='410.5' ce='1' le='1'/>"), kAll));
  EXPECT_TRUE(std::isnan(odd.latitude_deg));
  EXPECT_TRUE(std::isnan(odd.longitude_deg));
}

// Else our own exports, heard on the group, would lead our own stations in a circle.
TEST(CotReader, OurOwnExportsAreNoCues) {
  EXPECT_EQ(refusal(cot_reading(event("<_ols_ state='confirmed'/>"), kAll)), Refusal::kOwn);
  exports::CotEvent sent = own_event();
  sent.detail = "<_ols_ state=\"confirmed\"/>";
  for (const std::string& bytes : {cot_xml(sent), cot_protobuf(sent, exports::TakFraming::kMesh)}) {
    EXPECT_EQ(refusal(cot_reading(bytes, kAll)), Refusal::kOwn);
  }
}

TEST(CotReader, OnlyWantedTypesCount) {
  EXPECT_EQ(refusal(cot_reading(event(), {"a-f-", "b-"})), Refusal::kOtherType);
  EXPECT_EQ(report(cot_reading(event(), {"b-", "a-h-A"})).name, "ANDROID-1");
}

TEST(CotReader, AnythingElseIsMalformed) {
  const std::string entities =
      "<!DOCTYPE x [<!ENTITY a 'ANDROID-1'>]><event uid='&a;' type='a-h-A' "
      "time='2026-11-23T10:15:30Z' stale='2026-11-23T10:16:30Z'>"
      "<point lat='1' lon='1' hae='1' ce='1' le='1'/></event>";
  for (const std::string& bytes :
       {std::string(), std::string("<event"), std::string("<event/>"), std::string("\xbf\x01\xbf"),
        std::string("\xbf\x01\xbf\xff\xff"), std::string("rubbish"), entities,
        event().substr(0, event().size() / 2)}) {
    EXPECT_EQ(refusal(cot_reading(bytes, kAll)), Refusal::kMalformed) << bytes;
  }
}

}  // namespace
}  // namespace ols::cues
