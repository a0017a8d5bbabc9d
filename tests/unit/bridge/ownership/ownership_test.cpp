#include "bridge/ownership/ownership.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "border.h"

namespace ols::bridge {
namespace {

constexpr double kSpeed_m_s = 300.0;

// What a receiver sees of a run.
struct Seen {
  double longest_gap_s = 0.0, last_s = -1.0;
  int two_at_once = 0, names = 0, changes = 0, epochs_back = 0;
  std::string name, owner;
  std::uint64_t epoch = 0;

  void look(Border& border) {
    std::vector<Grant> grants;
    const auto who = border.owners(&grants);
    if (who.size() > 1) ++two_at_once;
    if (who.empty()) return;
    if (last_s >= 0.0) longest_gap_s = std::max(longest_gap_s, border.now_s - last_s);
    last_s = border.now_s;
    if (grants[0].id != name) ++names;
    if (who[0]->name != owner) ++changes;
    if (grants[0].epoch < epoch) ++epochs_back;
    name = grants[0].id;
    owner = who[0]->name;
    epoch = grants[0].epoch;
  }
};

// The target stands there.
void settle(Border& border, Seen& seen, double east_m, double time_s) {
  for (const double end_s = border.now_s + time_s; border.now_s < end_s;) {
    border.turn(east_m, 0.0);
    seen.look(border);
  }
}

// From one side to the other; at `kill_s` of it who owns the target is killed, for 4 s.
void cross(Border& border, Seen& seen, double from_m, double kill_s) {
  const double speed_m_s = from_m < 0.0 ? kSpeed_m_s : -kSpeed_m_s;
  double east_m = from_m;
  const double start_s = border.now_s;
  Node* killed = nullptr;
  while (east_m * speed_m_s < std::abs(from_m) * kSpeed_m_s) {
    border.turn(east_m, speed_m_s);
    east_m += speed_m_s * 0.01;
    const double time_s = border.now_s - start_s;
    if (kill_s >= 0.0 && killed == nullptr && time_s > kill_s) {
      if (const auto who = border.owners(); !who.empty()) {
        killed = who[0];
        killed->is_alive = false;
      }
    }
    if (killed != nullptr && !killed->is_alive && time_s > kill_s + 4.0) killed->start();
    seen.look(border);
  }
  if (killed != nullptr && !killed->is_alive) killed->start();
}

class Crossings : public testing::TestWithParam<std::uint64_t> {};

TEST_P(Crossings, AHundredWithAFusionKilledInHalfOfThem) {
  Border border(GetParam());
  Seen seen;
  settle(border, seen, -3000.0, 3.0);
  EXPECT_EQ(seen.owner.substr(0, 4), "west");
  int kept = 0, other_side = 0;
  for (int i = 0; i < 100; ++i) {
    const std::string name = seen.name;
    const double from_m = i % 2 == 0 ? -3000.0 : 3000.0;
    cross(border, seen, from_m, i % 4 < 2 ? 20.0 * border.uniform() : -1.0);
    settle(border, seen, -from_m, 2.0);
    kept += seen.name == name ? 1 : 0;
    other_side += seen.owner.substr(0, 4) == (from_m < 0.0 ? "east" : "west") ? 1 : 0;
  }
  std::printf("longest gap %.2f s, two at once %d, names kept %d of 100, owners changed %d\n",
              seen.longest_gap_s, seen.two_at_once, kept, seen.changes);
  EXPECT_EQ(seen.two_at_once, 0);
  EXPECT_LE(seen.longest_gap_s, 2.0);
  EXPECT_GE(kept, 99);
  EXPECT_EQ(other_side, 100) << "each ends with an owner whose region it is in";
  EXPECT_EQ(seen.epochs_back, 0);
}

INSTANTIATE_TEST_SUITE_P(Seeds, Crossings, testing::Values(20, 21, 22, 23, 24));

TEST(Ownership, NearTheBorderNothingChanges) {
  Border border(3);
  Seen seen;
  settle(border, seen, -3000.0, 3.0);
  seen.changes = 0;
  const auto fly = [&](double from_m, double to_m) {
    const double speed_m_s = to_m > from_m ? kSpeed_m_s : -kSpeed_m_s;
    for (double east_m = from_m; (to_m - east_m) * speed_m_s > 0.0; east_m += 0.01 * speed_m_s) {
      border.turn(east_m, speed_m_s);
      seen.look(border);
    }
  };
  fly(-3000.0, 1900.0);
  for (int i = 0; i < 5; ++i) {
    fly(1900.0, -1900.0);
    fly(-1900.0, 1900.0);
  }
  EXPECT_EQ(seen.changes, 0) << "less than the margin beyond it";
  EXPECT_EQ(seen.owner.substr(0, 4), "west");
}

TEST(Ownership, AHandOverLeavesHardlyAGap) {
  Border border(5);
  Seen seen;
  settle(border, seen, -3000.0, 3.0);
  seen.longest_gap_s = 0.0;
  cross(border, seen, -3000.0, -1.0);
  settle(border, seen, 3000.0, 2.0);
  EXPECT_EQ(seen.owner.substr(0, 4), "east");
  EXPECT_LT(seen.longest_gap_s, 0.3);
}

TEST(Ownership, WithoutTheStoreTheOwnerGoesOnMarkedAndNothingChanges) {
  Border border(7);
  Seen seen;
  settle(border, seen, -3000.0, 3.0);
  Node* const owner = border.owners()[0];
  border.store.is_down = true;
  settle(border, seen, -3000.0, 3.0);
  EXPECT_TRUE(border.owners().empty()) << "nobody is confirmed";
  cross(border, seen, -3000.0, -1.0);
  const auto grant = owner->ownership->grant(owner->track_id, border.at(*owner));
  ASSERT_TRUE(grant) << "it goes on";
  EXPECT_FALSE(grant->is_confirmed);
  EXPECT_FALSE(owner->ownership->counts(border.at(*owner)).is_confirmed);
  const std::uint64_t epoch = grant->epoch;
  EXPECT_EQ(owner->ownership->counts(border.at(*owner)).epoch, epoch);
  for (Node& node : border.nodes) {
    if (&node == owner) continue;
    EXPECT_FALSE(node.ownership->grant(node.track_id, border.at(node))) << node.name;
  }
  border.store.is_down = false;
  Seen after;
  settle(border, after, 500.0, 3.0);
  EXPECT_EQ(after.owner, owner->name) << "who was the owner is it still";
  EXPECT_EQ(after.epoch, epoch);
  EXPECT_EQ(after.two_at_once, 0);
}

TEST(Ownership, AFusionThatLosesItsTargetGivesItUpAtOnce) {
  Border border(9);
  Seen seen;
  settle(border, seen, -3000.0, 3.0);
  Node* const owner = border.owners()[0];
  const std::string name = seen.name;
  const std::int64_t id = owner->track_id;
  owner->track_id = id + 1;  // it is a new target to its fusion
  seen.longest_gap_s = 0.0;
  settle(border, seen, -3000.0, 4.0);
  EXPECT_LT(seen.longest_gap_s, 1.2);
  EXPECT_EQ(seen.name, name);
  EXPECT_EQ(seen.two_at_once, 0);
  EXPECT_FALSE(owner->ownership->grant(id, border.at(*owner)));
}

TEST(Ownership, ARefusedRenewalIsNotConfirmed) {
  Ownership ownership({"a:1", {-90.0, -180.0, 90.0, 180.0}, 2000.0});
  Now now{kStart_us, 10.0};
  ownership.feel_store(true, now);
  const auto pass = [&](double time_s) {
    now.monotonic_s += time_s;
    ownership.hear(Track{5, {1, 2, 3}, {0, 0, 0}, 2.0, 49.0, 16.0}, now);
    return ownership.step(now);
  };
  pass(0.0);
  const auto taking = pass(0.5);
  ASSERT_EQ(taking.size(), 1U);
  EXPECT_EQ(taking[0].revision, 0U);
  EXPECT_FALSE(ownership.grant(5, now));
  ownership.answer(taking[0].target, StoreAnswer::kDone, 17, now);
  ASSERT_TRUE(ownership.grant(5, now));
  EXPECT_EQ(ownership.grant(5, now)->epoch, 17U);
  EXPECT_TRUE(ownership.grant(5, now)->is_confirmed);
  EXPECT_FALSE(ownership.grant(6, now)) << "another target";
  const auto renewal = pass(0.5);
  ASSERT_EQ(renewal.size(), 1U);
  EXPECT_EQ(renewal[0].revision, 17U);
  ownership.answer(renewal[0].target, StoreAnswer::kRefused, 0, now);
  EXPECT_FALSE(ownership.grant(5, now)->is_confirmed);
  OwnerRecord other = renewal[0].record;
  other.owner = "b:1";
  ownership.learn(renewal[0].target, other, 18, now);
  EXPECT_FALSE(ownership.grant(5, now));
  EXPECT_EQ(ownership.counts(now).lost, 1U);
}

}  // namespace
}  // namespace ols::bridge
