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

// Whether the owner has no standby, so that another region takes the target.
class CutOff : public testing::TestWithParam<bool> {};

TEST_P(CutOff, AnOwnerThatAloneDoesNotReachTheStoreStopsWhenItHearsWhoHasTakenItsTarget) {
  Border border(13);
  Seen seen;
  settle(border, seen, -3000.0, 3.0);
  Node* const owner = border.owners()[0];
  const std::uint64_t epoch = seen.epoch;
  for (Node& node : border.nodes) {
    const bool is_of_its_region = node.name.substr(0, 4) == owner->name.substr(0, 4);
    if (&node != owner && is_of_its_region && GetParam()) node.is_alive = false;
  }
  owner->is_cut = true;
  double both_s = 0.0, marked_s = 0.0;
  seen.two_at_once = 0;
  for (const double end_s = border.now_s + 4.0; border.now_s < end_s;) {
    border.turn(-3000.0, 0.0);
    seen.look(border);
    const auto who = border.publishers();
    if (who.size() > 1) both_s += 0.01;
    if (who.size() == 1 && who[0] == owner && border.owners().empty()) marked_s += 0.01;
  }
  EXPECT_GT(marked_s, 0.05) << "while nobody else has it, it goes on";
  EXPECT_LE(both_s, 0.065) << "until the new owner has published for the first time";
  EXPECT_EQ(seen.two_at_once, 0) << "of both one is marked";
  EXPECT_FALSE(owner->ownership->grant(owner->track_id, border.at(*owner)));
  EXPECT_NE(seen.owner, owner->name);
  EXPECT_GT(seen.epoch, epoch);

  Border::mend(*owner);
  settle(border, seen, -3000.0, 2.0);
  EXPECT_EQ(owner->ownership->counts(border.at(*owner)).lost, 1U);
  EXPECT_EQ(border.publishers().size(), 1U);
  EXPECT_EQ(seen.two_at_once, 0);
  EXPECT_EQ(seen.owner == owner->name, GetParam()) << "another region gives it back";
}

INSTANTIATE_TEST_SUITE_P(WithAndWithoutAStandby, CutOff, testing::Bool());

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

// A fusion alone, which has just taken a target.
struct Alone {
  Alone() {
    ownership.feel_store(true, now);
    pass(0.0);
    const StoreRequest taking = pass(0.5);
    EXPECT_EQ(taking.revision, 0U);
    EXPECT_FALSE(ownership.grant(5, now));
    ownership.answer(taking, StoreAnswer::kDone, 17, now);
    target = taking.target;
  }
  // The request that follows, where there is one.
  StoreRequest pass(double time_s, double longitude_deg = 16.0) {
    now.monotonic_s += time_s;
    ownership.hear(Track{5, {1, 2, 3}, {0, 0, 0}, 2.0, 49.0, longitude_deg}, now);
    const auto requests = ownership.step(now);
    return requests.empty() ? StoreRequest{} : requests[0];
  }
  OwnerRecord of_another(const StoreRequest& request) const {
    OwnerRecord other = request.record;
    other.owner = std::string("b:1");
    return other;
  }

  Ownership ownership{{"a:1", {40.0, 10.0, 50.0, 17.0}, 2000.0}};
  Now now{kStart_us, 10.0};
  std::string target;
};

TEST(Ownership, ItsOwnersTargetsAreGrantedUnderTheirEpoch) {
  Alone one;
  const auto grant = one.ownership.grant(5, one.now);
  ASSERT_TRUE(grant);
  EXPECT_EQ(grant->epoch, 17U);
  EXPECT_EQ(grant->owner, "a:1");
  EXPECT_TRUE(grant->is_confirmed);
  EXPECT_FALSE(one.ownership.grant(6, one.now)) << "another target";
}

TEST(Ownership, ARefusedRenewalEndsItUntilItIsKnownWhoOwnsTheTarget) {
  Alone one;
  const StoreRequest renewal = one.pass(0.5);
  EXPECT_EQ(renewal.revision, 17U);
  one.ownership.answer(renewal, StoreAnswer::kRefused, 0, one.now);
  EXPECT_FALSE(one.ownership.grant(5, one.now)) << "another one publishes it by now";
  EXPECT_TRUE(one.ownership.counts(one.now).is_confirmed) << "the store does answer";
  one.ownership.learn(one.target, one.of_another(renewal), 18, one.now);
  EXPECT_FALSE(one.ownership.grant(5, one.now));
  EXPECT_EQ(one.ownership.counts(one.now).lost, 1U);
}

TEST(Ownership, ARefusalByItsOwnLostRenewalEndsNothing) {
  Alone one;
  StoreRequest lost = one.pass(0.5);
  one.ownership.answer(lost, StoreAnswer::kNone, 0, one.now);  // it was written, as 18
  const StoreRequest renewal = one.pass(0.5);
  EXPECT_EQ(renewal.revision, 17U);
  one.ownership.learn(one.target, lost.record, 18, one.now);
  one.ownership.answer(renewal, StoreAnswer::kRefused, 0, one.now);
  EXPECT_TRUE(one.ownership.grant(5, one.now));
  EXPECT_EQ(one.pass(0.5).revision, 18U);
}

TEST(Ownership, ARecordThatIsGoneIsMadeAnew) {
  Alone one;
  const StoreRequest renewal = one.pass(0.5);
  one.ownership.learn_gone(one.target, one.now);
  one.ownership.answer(renewal, StoreAnswer::kRefused, 0, one.now);
  EXPECT_FALSE(one.ownership.grant(5, one.now));
  const StoreRequest taking = one.pass(0.5);
  EXPECT_EQ(taking.target, one.target);
  EXPECT_EQ(taking.revision, 0U);
}

TEST(Ownership, AnAnswerIsThatOfItsRequest) {
  Alone one;
  const StoreRequest late = one.pass(0.5);
  EXPECT_TRUE(one.pass(2.0).target.empty()) << "one at a time";
  const StoreRequest second = one.pass(1.1);  // the first is given up
  ASSERT_FALSE(second.target.empty());
  EXPECT_FALSE(one.ownership.grant(5, one.now)->is_confirmed);
  one.ownership.answer(late, StoreAnswer::kRefused, 0, one.now);
  EXPECT_TRUE(one.ownership.grant(5, one.now)) << "it says nothing of the second one";
  one.ownership.answer(late, StoreAnswer::kDone, 18, one.now);
  EXPECT_FALSE(one.ownership.grant(5, one.now)->is_confirmed) << "its lease is over";
  one.ownership.answer(second, StoreAnswer::kDone, 19, one.now);
  EXPECT_TRUE(one.ownership.grant(5, one.now)->is_confirmed);
}

TEST(Ownership, AGreaterEpochEndsOnlyWhatTheStoreDoesNotConfirm) {
  Alone one;
  const auto hear = [&one](std::uint64_t epoch) {
    one.ownership.hear(TargetReport{one.target, {1, 2, 3}, {0, 0, 0}, 2.0, epoch}, one.now);
  };
  hear(99);
  EXPECT_TRUE(one.ownership.grant(5, one.now)) << "nobody can have taken it: the epoch is made up";
  const StoreRequest renewal = one.pass(1.4);
  hear(17);
  ASSERT_TRUE(one.ownership.grant(5, one.now)) << "its own epoch";
  EXPECT_FALSE(one.ownership.grant(5, one.now)->is_confirmed);
  hear(18);
  EXPECT_FALSE(one.ownership.grant(5, one.now));
  one.ownership.answer(renewal, StoreAnswer::kNone, 0, one.now);
  EXPECT_FALSE(one.ownership.grant(5, one.now)) << "it is not known better yet";
  one.ownership.answer(one.pass(0.5), StoreAnswer::kDone, 19, one.now);
  EXPECT_TRUE(one.ownership.grant(5, one.now)) << "the store says that nobody has taken it";
}

TEST(Ownership, WhatWasWishedLongAgoIsNoWish) {
  Alone one;
  const auto renew = [&one](std::uint64_t revision, double longitude_deg) {
    const StoreRequest request = one.pass(0.5, longitude_deg);
    one.ownership.answer(request, StoreAnswer::kDone, revision, one.now);
    return request;
  };
  constexpr double kBeyond_deg = 17.01;  // but less than by the margin
  // A watcher that begins anew hears everything again: what was wished of an owner before,
  one.ownership.learn_wish(one.target, "b:1", 16, one.now);
  EXPECT_EQ(renew(100, kBeyond_deg).record.owner, "a:1");
  // and, while the target was in the other cell once, of this one.
  for (std::uint64_t revision = 200; revision <= 900; revision += 100) renew(revision, 16.0);
  one.ownership.learn_wish(one.target, "b:1", 150, one.now);
  EXPECT_EQ(renew(1000, kBeyond_deg).record.owner, "a:1");
  // One that was on its way while two renewals were answered is new.
  one.ownership.learn_wish(one.target, "b:1", 801, one.now);
  const StoreRequest release = one.pass(0.5, kBeyond_deg);
  EXPECT_EQ(release.record.owner, "");
  EXPECT_EQ(release.record.successor, "b:1");
}

TEST(Ownership, AnOwnerThatHearsNoChangesStopsWhenItIsReplaced) {
  Border border(11);
  Seen seen;
  settle(border, seen, -3000.0, 3.0);
  Node* const owner = border.owners()[0];
  owner->is_deaf = true;
  // Without renewals for so long it is replaced; then it asks again.
  owner->is_alive = false;
  settle(border, seen, -3000.0, 1.6);
  owner->is_alive = true;
  seen.two_at_once = 0;
  settle(border, seen, -3000.0, 5.0);
  EXPECT_EQ(seen.two_at_once, 0);
  EXPECT_FALSE(owner->ownership->grant(owner->track_id, border.at(*owner)));
}

}  // namespace
}  // namespace ols::bridge
