#include "tools/calibrate/session_options.h"

#include <gtest/gtest.h>

namespace ols::calibration {
namespace {

TEST(SessionOptions, WhatWasAskedForComesBackAndTheRestIsOfNow) {
  ProcedureOptions then;
  then.name = "field";
  then.station = "old.toml";
  then.references = "r.csv";
  then.instrument = "new";
  then.sweep_poses = 12;
  then.rounds = 3;
  then.stars = 24;
  then.sun = then.overcast = true;
  then.drone = "drone";
  then.drone_points = 9;
  then.ut1.date = "2026-05-29";
  then.pressure_hPa = 980.5;
  ProcedureOptions now;
  now.name = "field";
  now.station = "alfa.toml";
  now.script = "answers";
  const ProcedureOptions o = resumed_options(session_text(then), now, "session.json");
  EXPECT_EQ(o.station, "alfa.toml");
  EXPECT_EQ(o.script, "answers");
  EXPECT_EQ(session_text(o), session_text(then));
  EXPECT_FALSE(o.ut1.minus_utc_s);
}

TEST(SessionOptions, AnotherProcedureAndADamagedFileAreRefused) {
  ProcedureOptions then, now;
  then.name = "sweep";
  now.name = "field";
  EXPECT_THROW(resumed_options(session_text(then), now, "s"), std::runtime_error);
  now.name = "sweep";
  EXPECT_NO_THROW(resumed_options(session_text(then), now, "s"));
  EXPECT_THROW(resumed_options("{}", now, "s"), std::runtime_error);
}

}  // namespace
}  // namespace ols::calibration
