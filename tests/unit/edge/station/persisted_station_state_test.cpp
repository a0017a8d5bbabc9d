// Every state file in every condition: a station that does not know how it was left starts stopped.
#include "edge/station/persisted_station_state.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/capability.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <thread>

#include "tests/unit/eventually.h"
#include "tests/unit/temp_dir.h"

namespace ols::station {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
namespace fs = std::filesystem;

class PersistedStationStateTest : public testing::Test {
 protected:
  PersistedStationStateTest() {
    root = temp_dir() + "ols_memory_" + std::to_string(::getpid());
    fs::remove_all(root);
    folder = root + "/state";
    fs::create_directories(folder);
  }
  ~PersistedStationStateTest() override { fs::remove_all(root); }

  void put(const char* subject, const std::string& text) const {
    std::ofstream(folder + "/a." + subject) << text;
  }
  std::string content(const char* subject) const {
    std::string text;
    std::getline(std::ifstream(folder + "/a." + subject), text);
    return text;
  }
  PersistedStationState memory(bool has_stop = true) const { return {folder, "a", has_stop}; }

  std::string root, folder;
};

TEST_F(PersistedStationStateTest, WhatIsKnownIsTakenUpWithoutAnAlarm) {
  struct Case {
    const char* hold;
    StationState state;
  };
  for (const Case& c : {Case{"free\n", StationState::kIdle},
                        {"stopped\n", StationState::kStopped},
                        {"emergency\n", StationState::kEmergency}}) {
    put("hold", c.hold);
    put("doubt", "none\n");
    const PersistedStationState m = memory();
    EXPECT_EQ(m.begin(), c.state) << c.hold;
    EXPECT_EQ(m.doubt(), std::nullopt);
    EXPECT_THAT(m.alarms(), IsEmpty());
  }
  put("hold", "free\n");
  const std::vector<std::string> doubts{"none", "reference", "homing", "gears", "homing-gears"};
  for (std::size_t i = 0; i < doubts.size(); ++i) {
    put("doubt", doubts[i] + "\n");
    EXPECT_EQ(memory().doubt(), mount::doubt_from_word(doubts[i])) << doubts[i];
  }
}

// Each condition of a file: what makes it so, and whether the stop may have been pressed.
struct Condition {
  const char* name;
  std::function<void(const std::string& folder, const std::string& file)> make;
  bool unreadable;
};

const std::vector<Condition> kConditions{
    {"missing", [](const auto&, const auto& file) { fs::remove(file); }, false},
    {"empty", [](const auto&, const auto& file) { std::ofstream(file, std::ios::trunc); }, true},
    {"foreign", [](const auto&, const auto& file) { std::ofstream(file) << "holiday\n"; }, true},
    {"half", [](const auto&, const auto& file) { std::ofstream(file) << "emerg"; }, true},
    {"directory",
     [](const auto&, const auto& file) {
       fs::remove(file);
       fs::create_directories(file);
     },
     true},
    // Also for root.
    {"unreadable",
     [](const auto&, const auto& file) {
       fs::remove(file);
       fs::create_symlink(file, file);
     },
     true},
    {"folder missing", [](const auto& folder, const auto&) { fs::remove_all(folder); }, false},
    {"folder is a file",
     [](const auto& folder, const auto&) {
       fs::remove_all(folder);
       std::ofstream{folder} << "x";
     },
     true},
};

TEST_F(PersistedStationStateTest, AHoldThatIsNotKnownStartsStoppedWithAnAlarm) {
  for (const Condition& condition : kConditions) {
    for (const bool has_stop : {false, true}) {
      SCOPED_TRACE(std::string(condition.name) + (has_stop ? ", stop" : ", no stop"));
      fs::remove_all(folder);
      fs::create_directories(folder);
      put("hold", "free\n");
      put("doubt", "none\n");
      condition.make(folder, folder + "/a.hold");
      const PersistedStationState m = memory(has_stop);
      EXPECT_EQ(m.begin(), condition.unreadable && has_stop ? StationState::kEmergency
                                                            : StationState::kStopped);
      EXPECT_THAT(m.alarms(),
                  Contains(HasSubstr("stop: state before the restart is unknown (" + folder)));
      EXPECT_THAT(m.alarms(), Contains(HasSubstr(m.begin() == StationState::kEmergency
                                                     ? "check it, then re-arm it"
                                                     : "check it, then ols-ctl a release")));
    }
  }
}

TEST_F(PersistedStationStateTest, ADoubtThatIsNotKnownIsADoubtWithAnAlarm) {
  for (const Condition& condition : kConditions) {
    SCOPED_TRACE(condition.name);
    fs::remove_all(folder);
    fs::create_directories(folder);
    put("hold", "free\n");
    put("doubt", "none\n");
    condition.make(folder, folder + "/a.doubt");
    PersistedStationState m = memory();
    EXPECT_EQ(m.doubt(), (mount::ReferenceDoubt{condition.unreadable, condition.unreadable}));
    EXPECT_THAT(m.alarms(), Contains(HasSubstr("ptu: reference before the restart is unknown")));
    m.remember(StationState::kIdle, std::nullopt, mount::Reference::kUnknown);
    EXPECT_THAT(m.alarms(), Contains(HasSubstr("ptu: reference before the restart is unknown")))
        << "no unit yet";
    m.remember(StationState::kIdle, std::nullopt, mount::Reference::kTrusted);
    EXPECT_THAT(m.alarms(),
                Not(Contains(HasSubstr("ptu: reference before the restart is unknown"))));
  }
}

TEST_F(PersistedStationStateTest, TheUnknownStaysUnknownOverRestartsUntilAPersonActs) {
  {
    PersistedStationState m = memory();
    EXPECT_EQ(m.begin(), StationState::kStopped);
    m.remember(StationState::kStopped, std::nullopt, mount::Reference::kTrusted);
  }
  ASSERT_EQ(content("hold"), "unknown");
  PersistedStationState m = memory();
  EXPECT_EQ(m.begin(), StationState::kStopped);
  m.remember(StationState::kStopped, std::nullopt, mount::Reference::kTrusted);
  EXPECT_THAT(m.alarms(), Contains(HasSubstr("is unknown (since an earlier start)")));
  m.remember(StationState::kManual, std::nullopt, mount::Reference::kTrusted);
  EXPECT_THAT(m.alarms(), IsEmpty());
  m.remember(StationState::kStopped, std::nullopt, mount::Reference::kTrusted);
  EXPECT_THAT(m.alarms(), IsEmpty()) << "stopped by a person";
  EXPECT_TRUE(eventually([&] { return content("hold") == "stopped"; }));
}

// Pressed, released, not re-armed, killed; the file damaged, or the folder taken away.
TEST_F(PersistedStationStateTest, APressedStopIsNotForgotten) {
  {
    PersistedStationState m = memory();
    m.remember(StationState::kIdle, std::nullopt, mount::Reference::kTrusted);
    m.remember(StationState::kEmergency, std::nullopt, mount::Reference::kTrusted);
  }
  EXPECT_EQ(content("hold"), "emergency");
  EXPECT_EQ(memory().begin(), StationState::kEmergency);
  put("hold", "emer");
  for (int start = 0; start < 2; ++start) {
    PersistedStationState damaged = memory();
    EXPECT_EQ(damaged.begin(), StationState::kEmergency);
    damaged.remember(StationState::kEmergency, std::nullopt, mount::Reference::kTrusted);
    EXPECT_THAT(damaged.alarms(), Contains(HasSubstr("check it, then re-arm it"))) << start;
  }
  fs::remove_all(folder);
  EXPECT_EQ(memory().begin(), StationState::kStopped);
}

TEST_F(PersistedStationStateTest, WithoutAFolderNothingIsKnownAndNothingAlarmsOnceAPersonActed) {
  PersistedStationState m("", "a", true);
  EXPECT_EQ(m.begin(), StationState::kStopped);
  EXPECT_EQ(m.doubt(), mount::ReferenceDoubt{});
  EXPECT_THAT(m.alarms(), Contains("stop: state before the restart is unknown (no state_folder "
                                   "is configured): check it, then ols-ctl a release"));
  m.remember(StationState::kIdle, std::nullopt, mount::Reference::kTrusted);
  EXPECT_THAT(m.alarms(), IsEmpty());
}

TEST_F(PersistedStationStateTest, AFolderThatVanishesIsAnAlarmForAsLong) {
  put("hold", "free\n");
  put("doubt", "none\n");
  PersistedStationState m = memory();
  const auto told = [&] {
    for (const std::string& alarm : m.alarms()) {
      if (alarm.starts_with("stop: state cannot be saved: ")) return true;
    }
    return false;
  };
  ASSERT_TRUE(eventually([&] { return m.alarms().empty(); }));
  fs::rename(folder, folder + ".away");
  EXPECT_TRUE(eventually(told));
  fs::create_directories(folder);
  EXPECT_TRUE(eventually([&] { return !told() && content("hold") == "free"; }));
}

// Of this thread and those that it starts: root, too, is bound by permissions then.
bool heed_permissions() {
  __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
  __user_cap_data_struct data[2]{};
  return ::syscall(SYS_capset, &header, data) == 0;
}

// What it says may be old: the stop that was pressed since could not be written.
TEST_F(PersistedStationStateTest, AFolderThatCannotBeWrittenIsNotBelievedToPermit) {
  put("hold", "free\n");
  put("doubt", "none\n");
  fs::permissions(folder, fs::perms::owner_read | fs::perms::owner_exec);
  bool bound = false, told = false;
  std::jthread([&] {
    bound = heed_permissions();
    if (!bound) return;
    const PersistedStationState m = memory();
    EXPECT_EQ(m.begin(), StationState::kEmergency);
    EXPECT_EQ(memory(false).begin(), StationState::kStopped);
    EXPECT_EQ(m.doubt(), mount::ReferenceDoubt{});
    told = eventually([&] {
      const auto alarms = m.alarms();
      return alarms.size() == 4 &&
             alarms[0].text.starts_with("stop: state before the restart is unknown") &&
             alarms[0].text.find("ermission denied") != std::string::npos &&
             alarms[1].text.starts_with("stop: state cannot be saved: ") &&
             alarms[3].text.starts_with("ptu: reference state cannot be saved: ");
    });
  }).join();
  fs::permissions(folder, fs::perms::owner_all);
  if (!bound) GTEST_SKIP() << "capabilities cannot be dropped here";
  EXPECT_TRUE(told);
}

}  // namespace
}  // namespace ols::station
