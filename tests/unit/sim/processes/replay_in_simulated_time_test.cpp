// The fusion's whole process in simulated time, with whole stations: what it publishes live, and
// what it makes of the recording.
#include <map>
#include <memory>
#include <set>
#include <vector>

#include "base/bus/log_reader.h"
#include "central/app/fusion_process.h"
#include "ols_msg/slew_t.hpp"
#include "tests/unit/edge/process/station_in_simulated_time.h"
#include "tests/unit/on_the_bus.h"
#include "tools/logger/log_writer.h"
#include "wire/fusion_status.h"
#include "wire/target.h"

namespace ols::fusion {
namespace {

using station::test::Command;
using station::test::kBus;
constexpr const char *kReplayBus = "memq://replay", *kSlewBus = "memq://slews";
constexpr std::int64_t kStart_us = 1'700'000'000'000'000;
constexpr std::int64_t kLive = 71, kOther = 72, kReplayed = 73;  // boots

struct Raw {
  const std::vector<std::uint8_t>& bytes;
  int getEncodedSize() const { return static_cast<int>(bytes.size()); }
  int encode(void* to, int /*offset*/, int size) const {
    std::ranges::copy(bytes, static_cast<std::uint8_t*>(to));
    return size;
  }
};

// What the fusions on a bus publish, by boot.
struct Heard {
  struct Told {
    // Each target but for its boot and its number, as it is encoded: to the last bit.
    std::multiset<std::vector<std::uint8_t>> targets;
    std::map<std::int64_t, Eigen::Vector3d> located_ecef_m;  // by time
    std::size_t slews = 0;
    ols_msg::fusion_status_t status{};

    double count(const std::string& name) const { return station::test::counter_of(status, name); }
    bool says(const std::string& words) const { return station::test::alarms_of(status, words); }
  };

  explicit Heard(const std::string& url) : bus(url) {
    bus.subscribe("OLS_TARGET.*", [this](const BusMessage& message) { hear_target(message); });
    bus.subscribe("OLS_SLEW_.*", [this](const BusMessage& message) {
      ols_msg::slew_t slew{};
      if (decode_of_schema(message, slew)) ++told[slew.boot_id].slews;
    });
    bus.subscribe(std::string(kFusionStatusChannel), [this](const BusMessage& message) {
      if (auto status = wire::decode_fusion_status(message)) {
        told[status->boot_id].status = std::move(*status);
      }
    });
  }
  void hear_target(const BusMessage& message) {
    ols_msg::target_t target{};
    if (const auto former = wire::decode_target(message)) {
      target = *former;
    } else if (!decode_of_schema(message, target)) {
      return;
    }
    Told& told_by = told[std::exchange(target.boot_id, 0)];
    target.sequence = 0;
    told_by.targets.insert(encoded(target));
    if (message.channel != kTargetChannel || !wire::has_position(target)) return;
    told_by.located_ecef_m[target.utime] = Eigen::Vector3d(target.position_ecef_m);
  }
  void hear() {
    while (bus.handle(0) > 0) {
    }
  }

  LcmBus bus;
  std::map<std::int64_t, Told> told;
};

FusionSettings settings(const std::string& url) {
  FusionSettings settings;
  settings.lcm_url = url;
  settings.fusion.handover.mode = HandoverMode::kAutomatic;
  return settings;
}

// `at_once`: so many bearings wait when the fusion takes its turn.
Heard::Told replayed(const std::string& log, std::size_t at_once, bool as_replay = true) {
  FusionProcess process(settings(kReplayBus),
                        {.slew_url = kSlewBus, .replay = as_replay, .boot_id = kReplayed});
  LcmBus player(kReplayBus);
  Heard heard(kReplayBus), slews(kSlewBus);
  LogReader reader(log);
  std::size_t bearings = 0;
  while (const auto message = reader.next()) {
    player.publish(message->channel, Raw{message->payload});
    if (!message->channel.starts_with(kBearingChannel) || ++bearings % at_once != 0) continue;
    process.turn();
    heard.hear();
  }
  if (bearings % at_once != 0) process.turn();
  heard.hear();
  slews.hear();
  EXPECT_EQ(heard.told[kReplayed].slews, 0U) << "it would move a real unit";
  heard.told[kReplayed].slews = slews.told[kReplayed].slews;
  return heard.told[kReplayed];
}

class FusedSite : public station::test::StationInSimulatedTime {
 protected:
  // A drone that never leaves the views of two stations.
  FusedSite()
      : StationInSimulatedTime(station::test::passing_drone(20.0, {6.0, 3.0, 0.0})),
        second_(world_, 1, settings_of("bravo"), time_),
        writer_(log_),
        recorder_(kBus),
        heard_(kBus) {
    recorder_.subscribe("OLS_.*", [this](const BusMessage& message) { writer_.write(message); });
    bus_.subscribe(station_channel(kStatusChannel, "bravo"), [this](const BusMessage& message) {
      if (auto heard = wire::decode_status(message)) status_ = std::move(*heard);
    });
    status_ = {};
    EXPECT_TRUE(time_.pass(station::test::kHoming_s, [this] {
      return status_.station == "bravo" && wire::device_state(status_, "ptu") == ok_;
    }));
    live_.emplace(settings(kBus), FusionProcessOptions{.slew_url = kBus, .boot_id = kLive});
    time_.at_each_step([this](double) {
      if (!stands_) live_->turn();
      if (over_) return;
      recorder_.handle(0);
      heard_.hear();
    });
  }
  bool locates() {
    const std::size_t before = live().located_ecef_m.size();
    return time_.pass(kPatience_s, [&] { return live().located_ecef_m.size() > before + 20; });
  }
  Heard::Told& live() { return heard_.told[kLive]; }

  static constexpr double kPatience_s = station::test::kPatience_s;
  sim::SimulatedStation second_;
  const std::string log_ = folder_ / "run.lcmlog";
  logger::LogWriter writer_;
  LcmBus recorder_;
  Heard heard_;
  std::optional<FusionProcess> live_;
  bool stands_ = false;  // the fusion, while messages arrive
  bool over_ = false;    // what is recorded and compared
};

TEST_F(FusedSite, AReplayGivesTheTargetsOfTheLiveRunAndThoseThatCameTooLateThen) {
  ASSERT_TRUE(look_at_middle(0) && look_at_middle(1));
  ASSERT_TRUE(locates());
  for (const char* station : {"alfa", "bravo"}) {
    EXPECT_TRUE(give(Command::COMMAND_RELEASE, 0.0, station)) << "from then on the fusion leads it";
  }
  ASSERT_TRUE(time_.pass(kPatience_s, [this] { return live().slews > 5; }));
  const std::int64_t utime_us = live().located_ecef_m.rbegin()->first;
  const auto truth = world_.target(0, 1e-6 * static_cast<double>(utime_us - kStart_us));
  EXPECT_LT((live().located_ecef_m[utime_us] - truth.p_ecef).norm(), 2.0);
  stands_ = true;
  time_.pass(4.0);
  stands_ = false;
  time_.pass(1.0);
  EXPECT_TRUE(live().says("messages wait"));
  ASSERT_TRUE(locates());
  time_.pass(1.5);  // until the status that counts
  const double withheld = live().count("targets_withheld");
  EXPECT_GT(withheld, 10.0);
  over_ = true;
  time_.pass(3.0);  // then nothing of it is of the present
  writer_.flush();
  for (const std::size_t at_once : {1U, 50U}) {
    const Heard::Told again = replayed(log_, at_once);
    EXPECT_TRUE(std::ranges::includes(again.targets, live().targets));
    EXPECT_EQ(static_cast<double>(again.targets.size() - live().targets.size()), withheld);
    EXPECT_GT(again.slews, 0U);
    EXPECT_EQ(again.count("other_fusions"), 0.0) << "that is the one of then";
  }
  const Heard::Told old = replayed(log_, 1, false);
  EXPECT_GT(old.count("targets_withheld"), withheld);
  EXPECT_GT(old.count("slews_withheld"), 0.0);
  EXPECT_EQ(old.slews, 0U);
  EXPECT_TRUE(old.targets.empty());
  EXPECT_TRUE(old.says("from this host's clock"));
}

TEST(TwoFusions, SayThatThereIsAnother) {
  sim::SimulatedTime time(kStart_us);
  Heard heard(kBus);
  const auto started = [](std::int64_t boot) {
    return std::make_unique<FusionProcess>(settings(kBus),
                                           FusionProcessOptions{.slew_url = kBus, .boot_id = boot});
  };
  const auto first = started(kLive);
  std::unique_ptr<FusionProcess> second;
  time.at_each_step([&](double) {
    first->turn();
    if (second) second->turn();
    heard.hear();
  });
  const auto says = [&](std::int64_t boot) { return heard.told[boot].says("another fusion"); };
  time.pass(2.5);
  EXPECT_EQ(heard.told[kLive].status.alarm, std::vector<std::string>{});
  second = started(kOther);
  EXPECT_TRUE(time.pass(20.0, [&] { return says(kLive) && says(kOther); }));
  EXPECT_GT(heard.told[kLive].count("other_fusions"), 0.0);
  EXPECT_NE(heard.told[kLive].status.last_error.find("another fusion"), std::string::npos);
  second.reset();
  EXPECT_TRUE(time.pass(20.0, [&] { return !says(kLive); }));
}

// It was recorded before any message had grown, by another site.
TEST(Replay, OfFormerMessagesGivesTheirTargets) {
  sim::SimulatedTime time(kStart_us);
  const Heard::Told again = replayed(OLS_GOLDEN_LOG, 1);
  Heard recorded("memq://recorded");
  LogReader reader(OLS_GOLDEN_LOG);
  while (const auto message = reader.next()) recorded.hear_target(*message);
  ASSERT_EQ(recorded.told.size(), 1U);
  std::vector<double> apart_m;
  for (const auto& [utime_us, ecef_m] : recorded.told.begin()->second.located_ecef_m) {
    const auto found = again.located_ecef_m.find(utime_us);
    if (found != again.located_ecef_m.end()) apart_m.push_back((found->second - ecef_m).norm());
  }
  ASSERT_GT(apart_m.size(), 10U);
  std::ranges::sort(apart_m);
  EXPECT_LT(apart_m[apart_m.size() / 2], 1.0);
}

}  // namespace
}  // namespace ols::fusion
