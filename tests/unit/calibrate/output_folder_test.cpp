#include "tools/calibrate/output_folder.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <stdexcept>

#include "tests/unit/temp_dir.h"

namespace ols::calibration {
namespace {

namespace fs = std::filesystem;

fs::path fresh(const char* name) {
  const fs::path folder = fs::path(temp_dir()) / name;
  fs::remove_all(folder);
  fs::remove_all(folder.string() + ".partial");
  return folder;
}

std::atomic<int> interrupts = 0, in_the_middle = 0;
char partial[512] = "";

void count(int) {
  ++interrupts;
  if (::access(partial, F_OK) == 0) ++in_the_middle;
}

// SIGINT, again and again, while a folder is written: none arrives before it is whole. Without the
// wait most of them do, because each file is brought to the disk.
TEST(OutputFolder, AnInterruptWaitsUntilAllIsWritten) {
  const fs::path folder = fresh("interrupted");
  const std::string name = folder.string() + ".partial";
  ASSERT_LT(name.copy(partial, sizeof partial - 1), sizeof partial - 1);
  struct sigaction action {
  }, before{};
  action.sa_handler = count;
  ASSERT_EQ(::sigaction(SIGINT, &action, &before), 0);
  sigevent event{};
  event.sigev_notify = SIGEV_SIGNAL;
  event.sigev_signo = SIGINT;
  timer_t timer{};
  ASSERT_EQ(::timer_create(CLOCK_MONOTONIC, &event, &timer), 0);
  constexpr itimerspec kOften{{0, 50'000}, {0, 1}};
  ASSERT_EQ(::timer_settime(timer, 0, &kOften, nullptr), 0);
  std::vector<OutputFile> files;
  for (int i = 0; i < 20; ++i)
    files.push_back({"file" + std::to_string(i), std::string(5000, 'x')});
  write_folder(folder, files);
  ::timer_delete(timer);
  ::sigaction(SIGINT, &before, nullptr);
  EXPECT_GT(interrupts, 0);
  EXPECT_EQ(in_the_middle, 0);
  EXPECT_TRUE(fs::exists(folder / "file19"));
}

TEST(OutputFolder, NothingIsOverwritten) {
  const fs::path folder = fresh("kept");
  EXPECT_EQ(checked_folder(folder.string() + "/"), folder);
  write_folder(folder, {{"a/setup.toml", "x"}});
  EXPECT_TRUE(fs::exists(folder / "a/setup.toml"));
  EXPECT_THROW(checked_folder(folder.string()), std::invalid_argument);
  EXPECT_THROW(checked_folder(""), std::invalid_argument);
  fs::create_directory(fresh("left").string() + ".partial");
  EXPECT_THROW(checked_folder((fs::path(temp_dir()) / "left").string()), std::invalid_argument);
}

}  // namespace
}  // namespace ols::calibration
