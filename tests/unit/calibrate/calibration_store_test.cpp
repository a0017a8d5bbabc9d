#include "tools/calibrate/calibration_store.h"

#include <gtest/gtest.h>

#include <fstream>
#include <set>

#include "tests/unit/temporary_folder.h"

namespace {

std::set<std::string>& synced() {
  static std::set<std::string> paths;
  return paths;
}

}  // namespace

// In place of the library's: notes what is brought to the disk.
extern "C" int fsync(int file) {
  synced().insert(std::filesystem::read_symlink("/proc/self/fd/" + std::to_string(file)).string());
  return 0;
}

namespace ols::calibration {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kNow_us = 1'780'000'000'000'000;

class CalibrationStoreTest : public testing::Test {
 protected:
  // A calibration that a procedure has made.
  void make(const std::string& id) {
    const fs::path running = store.begin("field", kNow_us);
    std::ofstream(running / "instrument.toml") << id;
    std::ofstream(running / "setup.toml") << id;
    store.keep(running, id);
  }
  static HistoryLine line(const std::string& event) { return {kNow_us, event, "", "field", ""}; }

  TemporaryFolder folder;
  CalibrationStore store{fs::path(folder.path()) / "alfa"};
};

TEST_F(CalibrationStoreTest, AtFirstNoneIsInUse) {
  EXPECT_FALSE(store.current());
  EXPECT_FALSE(store.previous());
  EXPECT_TRUE(store.history().empty());
}

// A rectification tells nothing of the setup: the station keeps its calibration.
TEST_F(CalibrationStoreTest, AnInstrumentAloneIsForTheNextSetup) {
  EXPECT_FALSE(store.instrument_file());
  make("11");
  store.use("11", line("accepted"));
  EXPECT_EQ(store.instrument_file(), store.folder() / "current" / "instrument.toml");
  make("22");
  fs::remove(store.folder() / "22" / "setup.toml");
  EXPECT_THROW(store.use("22", line("accepted")), std::runtime_error);
  store.use_instrument("22", line("instrument"));
  EXPECT_EQ(store.current(), "11");
  EXPECT_EQ(fs::canonical(*store.instrument_file()),
            fs::canonical(store.folder() / "22" / "instrument.toml"));
  EXPECT_EQ(store.history().back().event, "instrument");
  make("33");
  store.use("33", line("accepted"));  // its own is the newest
  EXPECT_EQ(store.instrument_file(), store.folder() / "current" / "instrument.toml");
  EXPECT_EQ(store.previous(), "11");
}

TEST_F(CalibrationStoreTest, OneIsUsedAnotherOneAndBack) {
  make("11");
  make("22");
  store.use("11", line("accepted"));
  EXPECT_EQ(store.current(), "11");
  EXPECT_FALSE(store.previous());
  store.use("22", line("accepted"));
  EXPECT_EQ(store.current(), "22");
  EXPECT_EQ(store.previous(), "11");
  store.use("11", line("reverted"));
  EXPECT_EQ(store.current(), "11");
  EXPECT_FALSE(store.previous()) << "going back twice would lead forth";
  std::ifstream file(store.folder() / "current" / "instrument.toml");
  std::string text;
  file >> text;
  EXPECT_EQ(text, "11");
  EXPECT_EQ(store.history().size(), 3U);
}

// The line is written, the links are not yet.
TEST_F(CalibrationStoreTest, ADecisionThatWasCutShortIsCarriedOut) {
  for (const char* id : {"11", "22", "33"}) make(id);
  store.use("11", line("accepted"));
  store.use_instrument("33", line("instrument"));
  store.note({kNow_us, "accepted", "22", "field", "11"});
  EXPECT_EQ(store.previous(), std::nullopt) << "of the one that is still in use";
  CalibrationStore later(store.folder());
  later.lock();
  EXPECT_EQ(later.current(), "22");
  EXPECT_EQ(later.previous(), "11");
  EXPECT_EQ(later.instrument_file(), store.folder() / "current" / "instrument.toml");
}

TEST_F(CalibrationStoreTest, AnInstrumentWhoseLinkIsMissingIsUsed) {
  for (const char* id : {"11", "33"}) make(id);
  store.use("11", line("accepted"));
  store.note({kNow_us, "instrument", "33", "sweep", "11"});
  store.lock();
  EXPECT_EQ(store.current(), "11");
  EXPECT_EQ(fs::canonical(*store.instrument_file()),
            fs::canonical(store.folder() / "33" / "instrument.toml"));
}

TEST_F(CalibrationStoreTest, ADecisionForWhatIsGoneIsNotCarriedOut) {
  for (const char* id : {"11", "22"}) make(id);
  store.use("11", line("accepted"));
  store.note({kNow_us, "accepted", "22", "field", "11"});
  fs::remove_all(store.folder() / "22");
  store.lock();
  EXPECT_EQ(store.current(), "11");
  EXPECT_TRUE(fs::exists(store.folder() / "current" / "instrument.toml"));
}

// Somebody has set the link by hand since.
TEST_F(CalibrationStoreTest, WhatIsDoneIsNotDoneAgain) {
  for (const char* id : {"11", "22", "33"}) {
    make(id);
    store.use(id, line("accepted"));
  }
  fs::remove(store.folder() / "current");
  fs::create_directory_symlink("11", store.folder() / "current");
  store.lock();
  EXPECT_EQ(store.current(), "11");
}

TEST_F(CalibrationStoreTest, GoingBackTwiceLeadsTwoBack) {
  for (const char* id : {"11", "22", "33"}) {
    make(id);
    store.use(id, line("accepted"));
  }
  store.use(*store.previous(), line("reverted"));
  EXPECT_EQ(store.current(), "22");
  store.use(*store.previous(), line("reverted"));
  EXPECT_EQ(store.current(), "11");
}

TEST_F(CalibrationStoreTest, WhatIsKeptIsOnTheDiskBeforeItHasItsName) {
  const fs::path running = store.begin("field", kNow_us);
  fs::create_directory(running / "frames");
  for (const char* name : {"instrument.toml", "frames/000001.png"}) std::ofstream(running / name);
  synced().clear();
  store.keep(running, "11");
  for (const fs::path& path :
       {running / "instrument.toml", running / "frames/000001.png", running / "frames", running}) {
    EXPECT_TRUE(synced().contains(path.string())) << path;
  }
}

TEST_F(CalibrationStoreTest, WhatIsNotThereCannotBeUsed) {
  EXPECT_THROW(store.use("33", line("reverted")), std::runtime_error);
  EXPECT_THROW(store.use("..", line("reverted")), std::runtime_error);
  EXPECT_THROW(store.use("", line("reverted")), std::runtime_error);
  EXPECT_FALSE(store.current());
  EXPECT_TRUE(store.history().empty());
}

TEST_F(CalibrationStoreTest, NothingIsOverwritten) {
  make("11");
  const fs::path running = store.begin("field", kNow_us);
  EXPECT_THROW(store.keep(running, "11"), std::runtime_error);
  EXPECT_TRUE(fs::exists(running));
  const fs::path other = store.begin("field", kNow_us);  // within one second
  EXPECT_NE(other, running);
}

TEST_F(CalibrationStoreTest, AProcedureThatDiedIsSetAsideAndKeepsWhatItHad) {
  const fs::path running = store.begin("field", kNow_us);
  std::ofstream(running / "observations.jsonl") << "{}\n";
  const auto dead = store.lock();
  ASSERT_EQ(dead.size(), 1U);
  EXPECT_EQ(dead[0].filename(), "2026-05-28T20-26-40Z-field.interrupted");
  EXPECT_TRUE(fs::exists(dead[0] / "observations.jsonl"));
  EXPECT_FALSE(fs::exists(running));
}

TEST_F(CalibrationStoreTest, OneProcedureAtATime) {
  store.lock();
  CalibrationStore other(store.folder());
  EXPECT_THROW(other.lock(), std::runtime_error);
}

TEST_F(CalibrationStoreTest, ADamagedLineOfTheHistoryLosesNoOther) {
  store.note({kNow_us, "kept", "11", "field", ""});
  std::ofstream(store.folder() / "history.jsonl", std::ios::app) << "{\"utime_us\": 17\n[]\n{}\n";
  store.note({kNow_us, "kept", "22", "field", ""});
  const auto lines = store.history();
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[1].id, "22");
}

TEST_F(CalibrationStoreTest, OneThatWasSetAsideIsAtWorkAgain) {
  const fs::path first = store.interrupt(store.begin("field", kNow_us));
  const fs::path second = store.interrupt(store.begin("sweep", kNow_us + 5'000'000));
  EXPECT_EQ(store.interrupted(), (std::vector<fs::path>{first, second}));
  const fs::path running = store.resume(first);
  EXPECT_EQ(running.extension(), ".running");
  EXPECT_TRUE(fs::is_directory(running));
  EXPECT_EQ(store.interrupted(), std::vector<fs::path>{second});
}

}  // namespace
}  // namespace ols::calibration
