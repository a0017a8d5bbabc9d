#include "edge/station/fault_log.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "conditions/alarms.h"

namespace ols::station {
namespace {

constexpr std::int64_t kSecond = 1'000'000;

TEST(FaultLog, KeepsTheNewestWithItsTime) {
  FaultLog log;
  EXPECT_EQ(log.text(), "");
  EXPECT_EQ(log.utime_us(), 0);
  log.note("camera", "gone", 1, 10 * kSecond);
  log.note("ptu", "silent", 1, 20 * kSecond);
  log.note("camera", "gone", 1, 30 * kSecond);  // the same one, still there
  EXPECT_EQ(log.text(), "ptu: silent");
  EXPECT_EQ(log.utime_us(), 20 * kSecond);
  log.note("ptu", "", 0, 40 * kSecond);
  EXPECT_EQ(log.text(), "ptu: silent") << "it stays when it is over";
}

TEST(FaultLog, ARetryInTheSameWordsHidesNothing) {
  FaultLog log;
  log.note("ptu", "cannot be opened", 1, kSecond);
  log.note_event("command", "slew refused: stale", 1, 2 * kSecond);
  for (int i = 2; i < 50; ++i) log.note("ptu", "cannot be opened", i, (1 + i) * kSecond);
  EXPECT_EQ(log.text(), "slew refused: stale");
  log.note("ptu", "cannot be opened", 60, 200 * kSecond);
  EXPECT_EQ(log.text(), "ptu: cannot be opened") << "after a while it is another one";
}

TEST(FaultLog, EachRefusedCommandCounts) {
  FaultLog log;
  log.note_event("command", "point refused: unreachable", 1, kSecond);
  log.note("ptu", "reset", 1, 2 * kSecond);
  log.note_event("command", "point refused: unreachable", 2, 3 * kSecond);
  EXPECT_EQ(log.text(), "point refused: unreachable");
  EXPECT_EQ(log.utime_us(), 3 * kSecond);
}

TEST(FaultLog, AnAlarmIsATroubleWhenItBegins) {
  FaultLog log;
  log.note_alarms({alarm::gnss_silent("5 s", "position kept")}, kSecond);
  log.note("ptu", "reset", 1, 2 * kSecond);
  log.note_alarms({alarm::gnss_silent("6 s", "position kept")}, 3 * kSecond);
  EXPECT_EQ(log.text(), "ptu: reset") << "the same alarm, a second older";
  log.note_alarms({}, 4 * kSecond);
  EXPECT_EQ(log.text(), "ptu: reset");
  log.note_alarms({alarm::gnss_silent("5 s", "position kept")}, 5 * kSecond);
  EXPECT_EQ(log.text(), "gnss: silent for 5 s, position kept");
}

std::vector<std::string> news(FaultLog& log) {
  std::vector<std::string> found;
  for (const News& item : log.take_event())
    found.push_back(std::string(item.event.bad ? "! " : "") + item.event.text);
  return found;
}
using Texts = std::vector<std::string>;

TEST(FaultLog, TroublesAreNewsOnce) {
  FaultLog log;
  log.note("ptu", "reply garbled", 1, kSecond);
  log.note_event("command", "SLEW refused: stale", 1, kSecond);
  EXPECT_EQ(news(log), (Texts{"! ptu: reply garbled", "! command: SLEW refused: stale"}));
  log.note("ptu", "reply garbled", 2, 2 * kSecond);
  log.note_event("command", "SLEW refused: stale", 1, 2 * kSecond);
  EXPECT_EQ(news(log), Texts{});
}

TEST(FaultLog, AlarmsAreNewsWhenTheyComeAndWhenTheyGo) {
  FaultLog log;
  log.note_alarms({alarm::gnss_silent("5 s", "position kept")}, kSecond);
  EXPECT_EQ(news(log), (Texts{"! alarm: gnss: silent for 5 s, position kept"}));
  log.note_alarms({alarm::gnss_silent("61 s", "position kept")}, 2 * kSecond);
  EXPECT_EQ(news(log), Texts{});
  log.note_alarms({}, 3 * kSecond);
  EXPECT_EQ(news(log), (Texts{"over: gnss: silent for 61 s, position kept"}));
}

TEST(FaultLog, AnotherStateIsNews) {
  FaultLog log;
  log.note_state("camera", {"absent", "no such camera", true});
  log.note_state("camera", {"absent", "not found", true});
  log.note_state("camera", {"ok", ""});
  log.note_state("station", {"tracking", ""});
  EXPECT_EQ(news(log), (Texts{"! camera absent: no such camera", "camera ok", "station tracking"}));
  EXPECT_EQ(log.text(), "") << "a state alone is no trouble";
}

}  // namespace
}  // namespace ols::station
