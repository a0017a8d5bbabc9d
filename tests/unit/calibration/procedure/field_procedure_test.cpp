#include "calibration/procedure/field_procedure.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace ols::calibration {
namespace {

// Takes so many pictures and is done.
class Counting : public Stage {
 public:
  explicit Counting(int pictures) : pictures_(pictures) {}
  std::optional<Order> next() override {
    if (done_ >= pictures_) return std::nullopt;
    Order order;
    order.step = "picture " + std::to_string(done_ + 1);
    return order;
  }
  void taken(const Taken&) override { ++done_; }
  void not_taken(const std::string& why) override {
    remark(why);
    ++done_;
  }
  void answered(const Answer&) override {}
  std::vector<Observation> observations() const override {
    return std::vector<Observation>(static_cast<std::size_t>(done_));
  }
  double progress() const override { return static_cast<double>(done_) / pictures_; }
  void again() { ++pictures_; }

 private:
  int pictures_, done_ = 0;
};

class FieldProcedureTest : public testing::Test {
 protected:
  FieldProcedureTest() {
    std::vector<std::unique_ptr<Stage>> stages;
    stages.push_back(std::make_unique<Counting>(2));
    stages.push_back(std::make_unique<Counting>(1));
    last = static_cast<Counting*>(stages.back().get());
    procedure =
        std::make_unique<FieldProcedure>(std::move(stages), [this](const std::string& name) {
          redone = name;
          last->again();
        });
  }
  int take_all() {
    int pictures = 0;
    for (; procedure->next() && !procedure->next()->step.empty() &&
           procedure->next()->kind == Order::Kind::kShoot;
         ++pictures) {
      procedure->taken({});
    }
    return pictures;
  }
  static AdjustedResult result(bool failed = false) { return {failed, !failed, "text", "spire"}; }
  bool offers(const std::string& choice) {
    const auto order = procedure->next();
    return order && std::ranges::count(order->question.choices, choice) == 1;
  }

  Counting* last = nullptr;
  std::string redone;
  std::unique_ptr<FieldProcedure> procedure;
};

TEST_F(FieldProcedureTest, StagesComeInOrderThenTheAdjustmentThenThePerson) {
  EXPECT_EQ(procedure->progress(), 0.0);
  EXPECT_EQ(take_all(), 3);
  EXPECT_FALSE(procedure->next());
  EXPECT_TRUE(procedure->wants_adjustment());
  EXPECT_EQ(procedure->observations().size(), 3U);
  procedure->adjusted(result());
  EXPECT_TRUE(offers("accept") && offers("redo") && offers("keep"));
  EXPECT_EQ(procedure->outcome(), Outcome::kRunning);  // never by itself
  procedure->answered({"accept", {}, {}});
  EXPECT_EQ(procedure->outcome(), Outcome::kAccepted);
  EXPECT_FALSE(procedure->next());
}

TEST_F(FieldProcedureTest, TheOldOneMayBeKept) {
  take_all();
  procedure->adjusted(result());
  procedure->answered({"keep", {}, {}});
  EXPECT_EQ(procedure->outcome(), Outcome::kKeptOld);
}

TEST_F(FieldProcedureTest, WhatFailedCannotBeAccepted) {
  take_all();
  procedure->adjusted(result(true));
  EXPECT_FALSE(offers("accept"));
  procedure->answered({"accept", {}, {}});
  EXPECT_EQ(procedure->outcome(), Outcome::kRunning);
}

TEST_F(FieldProcedureTest, TheWorstIsSightedAgainAndAdjustedAgain) {
  take_all();
  procedure->adjusted(result());
  procedure->answered({"redo", {}, {}});
  EXPECT_EQ(redone, "spire");
  EXPECT_EQ(take_all(), 1);
  EXPECT_TRUE(procedure->wants_adjustment());
}

TEST_F(FieldProcedureTest, AnAbortEndsItAtAnyTime) {
  procedure->taken({});
  procedure->answered({"abort", {}, {}});
  EXPECT_EQ(procedure->outcome(), Outcome::kAborted);
  EXPECT_FALSE(procedure->next());
  EXPECT_EQ(procedure->observations().size(), 1U);  // what it had is there
}

TEST_F(FieldProcedureTest, RemarksOfAllStagesArePassedOnOnce) {
  procedure->not_taken("a van");
  EXPECT_EQ(procedure->take_remarks(), std::vector<std::string>{"a van"});
  EXPECT_TRUE(procedure->take_remarks().empty());
}

TEST(FieldProcedure, WithoutStagesThereIsNone) {
  EXPECT_THROW(FieldProcedure({}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace ols::calibration
