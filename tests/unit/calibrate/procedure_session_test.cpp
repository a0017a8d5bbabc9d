#include "tools/calibrate/procedure_session.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "tests/unit/temp_dir.h"

namespace ols::calibration {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(ProcedureSession, AResultIsTakenAlsoOverOneThatWasTakenBefore) {
  const fs::path folder = fs::path(temp_dir()) / "procedure_session";
  fs::create_directories(folder);
  ProcedureSession session(folder, "alfa");
  for (const std::string text : {"first", "second"}) {
    const fs::path result = session.next_result();
    fs::create_directories(result / "plots");
    std::ofstream(result / "instrument.toml") << text;
    std::ofstream(result / "plots" / "gears.svg") << text;
    session.take_result();
    EXPECT_EQ(text_of(folder / "instrument.toml"), text);
    EXPECT_EQ(text_of(folder / "plots" / "gears.svg"), text);
  }
}

TEST(ProcedureSession, WhatWasNotedIsReplayedInOrder) {
  const fs::path folder = fs::path(temp_dir()) / "procedure_session_noted";
  fs::create_directories(folder);
  Order ask;
  ask.kind = Order::Kind::kAsk;
  ask.step = "mast";
  ProcedureSession(folder, "alfa")
      .note({JournalEntry::Kind::kAnswered, "mast", 0, "", {"skip", {}, {}}});
  ProcedureSession later(folder, "alfa");
  later.resume();
  ASSERT_TRUE(later.is_replaying());
  EXPECT_EQ(later.replayed(ask).answer.choice, "skip");
  EXPECT_FALSE(later.is_replaying());
}

}  // namespace
}  // namespace ols::calibration
