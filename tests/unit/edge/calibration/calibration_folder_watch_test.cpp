#include "edge/calibration/calibration_folder_watch.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/unit/edge/calibration/calibration_files.h"
#include "tests/unit/eventually.h"

namespace ols::station {
namespace {

namespace fs = std::filesystem;

class CalibrationFolderWatchTest : public testing::Test {
 protected:
  CalibrationFolderWatchTest() {
    second_.setup = std::string(test::kSetup) + "# another\n";
    second_.write();
    link(first_.path);
  }
  ~CalibrationFolderWatchTest() override { fs::remove(link_); }
  // As `ols-calibrate` accepts one: by one rename.
  void link(const std::string& folder) const {
    fs::create_directory_symlink(folder, link_ + ".next");
    fs::rename(link_ + ".next", link_);
  }
  StationSettings configured() const {
    StationSettings settings = test::settings();
    settings.calibration_folder = link_;
    return settings;
  }
  // Turns until its thread has read, in real time.
  void look(CalibrationFolderWatch& next) {
    eventually([&] {
      next.look(now_s_ += 1.5);
      return next.waiting() || !next.alarm().empty();
    });
  }

  test::CalibrationFolder first_{"next_calibration_1_"}, second_{"next_calibration_2_"};
  std::string link_ =
      (fs::temp_directory_path() / ("next_calibration_" + std::to_string(::getpid()))).string();
  double now_s_ = 100.0;
};

TEST_F(CalibrationFolderWatchTest, TheOneThatWasThereAtTheBeginningIsNoNews) {
  CalibrationFolderWatch next(configured());
  for (int i = 0; i < 20; ++i) next.look(now_s_ += 1.5);
  EXPECT_FALSE(next.waiting());
  EXPECT_EQ(next.alarm(), "");
}

TEST_F(CalibrationFolderWatchTest, AnAcceptedOneWaitsAndSaysSo) {
  CalibrationFolderWatch next(configured());
  link(second_.path);
  look(next);
  ASSERT_TRUE(next.waiting());
  EXPECT_EQ(next.waiting()->id, read_calibration(second_.path, configured()).id);
  EXPECT_NE(next.alarm().text.find("accepted, not yet in use"), std::string::npos);
  next.forget();
  next.look(now_s_ += 1.5);
  EXPECT_FALSE(next.waiting());
  EXPECT_EQ(next.alarm(), "");
}

TEST_F(CalibrationFolderWatchTest, TheFirstOneEverIsNoticed) {
  fs::remove(link_);
  CalibrationFolderWatch next(configured());
  next.look(now_s_);
  link(first_.path);
  look(next);
  EXPECT_TRUE(next.waiting());
}

TEST_F(CalibrationFolderWatchTest, OneThatCannotBeReadIsNamedUntilThereIsAnother) {
  second_.put("instrument.toml", "rubbish = 1\n");
  CalibrationFolderWatch next(configured());
  link(second_.path);
  look(next);
  EXPECT_FALSE(next.waiting());
  EXPECT_NE(next.alarm().text.find("instrument.toml:1: rubbish"), std::string::npos);
  link(first_.path);
  eventually([&] {
    next.look(now_s_ += 1.5);
    return next.waiting() != nullptr;
  });
  EXPECT_EQ(next.alarm().text.find("rubbish"), std::string::npos);
}

}  // namespace
}  // namespace ols::station
