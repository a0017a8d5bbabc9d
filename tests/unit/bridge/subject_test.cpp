#include "bridge/subject.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace ols::bridge {
namespace {

TEST(Subject, EachFormIsReadAndWrittenTheSame) {
  for (const char* text : {"ols.v1.moravia.airfield.alfa.bearing", "ols.v1.moravia.a-1.b_2.status",
                           "ols.v1.moravia.airfield.alfa.reply", "ols.v1.r.s.alfa.skyline",
                           "ols.v1.moravia.airfield.alfa.cmd.slew", "ols.v1.moravia.target"}) {
    const auto subject = parse_subject(text);
    ASSERT_TRUE(subject) << text;
    EXPECT_EQ(to_text(*subject), text);
  }
  const Subject slew{Kind::kCommand, "r", "s", "alfa", "slew"};
  EXPECT_EQ(*parse_subject("ols.v1.r.s.alfa.cmd.slew"), slew);
}

TEST(Subject, NothingElseIsOne) {
  for (const char* text :
       {"", "ols.v1.", "ols.v2.r.s.a.bearing", "ols.v1.r.s.a.bearing.x", "ols.v1.r.s.a.preview",
        "ols.v1.r.s.a.cmd", "ols.v1.r.s.a.cmd.reboot", "ols.v1.r.s.*.bearing",
        "ols.v1.r.s..bearing", "ols.v1.r.s.a b.bearing", "ols.v1.r.s.>", "ols.v1.r.target.x",
        "ols.v1.*.target", "ols.v1.r.s.a.cmd.slew.x"}) {
    EXPECT_FALSE(parse_subject(text)) << text;
  }
  EXPECT_FALSE(parse_subject("ols.v1." + std::string(41, 'r') + ".target"));
}

TEST(Subject, AChannelAndItsSubjectName) {
  const struct {
    const char *channel, *subject;
  } kPairs[] = {{"OLS_BEARING_alfa", "ols.v1.r.s.alfa.bearing"},
                {"OLS_STATUS_alfa", "ols.v1.r.s.alfa.status"},
                {"OLS_REPLY_alfa", "ols.v1.r.s.alfa.reply"},
                {"OLS_SKYLINE_alfa", "ols.v1.r.s.alfa.skyline"},
                {"OLS_SLEW_alfa", "ols.v1.r.s.alfa.cmd.slew"},
                {"OLS_PTU_alfa", "ols.v1.r.s.alfa.cmd.ptu"},
                {"OLS_TARGET", "ols.v1.r.target"}};
  for (const auto& [channel, text] : kPairs) {
    const auto content = content_of(channel);
    ASSERT_TRUE(content) << channel;
    const auto subject = parse_subject(text);
    EXPECT_EQ(content->kind, subject->kind) << channel;
    EXPECT_EQ(content->station, subject->station);
    EXPECT_EQ(content->command, subject->command);
    EXPECT_EQ(channel_of(*subject), channel);
  }
}

TEST(Subject, WhatStaysInASite) {
  for (const char* channel : {"OLS_TRUST", "OLS_PREVIEW_alfa", "OLS_TARGET_PAPER", "OLS_BEARING_",
                              "OLS_BEARING_a.b", "OLS_BEARING_*", "OTHER"}) {
    EXPECT_FALSE(content_of(channel)) << channel;
  }
}

TEST(Subject, ASelectionHasWhatItNames) {
  const Subject alfa{Kind::kBearing, "r", "s", "alfa"};
  for (const char* text : {"r.s.alfa", "r.*.alfa", "*.*.*"}) {
    EXPECT_TRUE(parse_selection(text).has(alfa)) << text;
  }
  for (const char* text : {"r.s.bravo", "q.s.alfa", "r.t.*"}) {
    EXPECT_FALSE(parse_selection(text).has(alfa)) << text;
  }
  for (const char* text : {"", "r.s", "r.s.a.b", "r.s.a*", "r..a", "r.s.>"}) {
    EXPECT_THROW(parse_selection(text), std::invalid_argument) << text;
  }
}

}  // namespace
}  // namespace ols::bridge
