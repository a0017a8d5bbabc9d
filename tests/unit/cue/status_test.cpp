#include "cue/status.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace ols::cues {
namespace {

CueStatus status() {
  InputCounts counts;
  counts.taken = 12;
  counts.refused = {{"stale", 2}, {"own", 1}};
  counts.last_refusal = "x: stale";
  return {.utime_us = 5,
          .cues = 3,
          .alarms = {},
          .counters = {{"bus_lost", 0.0}},
          .inputs = {{.name = "tak",
                      .is_open = true,
                      .trouble = "",
                      .openings = 1,
                      .failures = 0,
                      .bytes = 100,
                      .counts = counts},
                     {.name = "adsb",
                      .is_open = false,
                      .trouble = "a:30003: no answer",
                      .openings = 0,
                      .failures = 4,
                      .bytes = 0,
                      .counts = {}}}};
}

TEST(CueStatus, IsALineForAPerson) {
  EXPECT_EQ(in_one_line(status()),
            "3 cues; tak: 12 taken, 3 refused (last x: stale); adsb: a:30003: no answer");
}

TEST(CueStatus, IsJsonForAProgram) {
  const auto json = nlohmann::json::parse(to_json(status()));
  EXPECT_EQ(json["cues"], 3);
  EXPECT_EQ(json["inputs"]["tak"]["refused"]["stale"], 2);
  EXPECT_EQ(json["inputs"]["tak"]["last_refusal"], "x: stale");
  EXPECT_EQ(json["inputs"]["adsb"]["failures"], 4);
  EXPECT_EQ(json["inputs"]["adsb"]["open"], false);
}

}  // namespace
}  // namespace ols::cues
