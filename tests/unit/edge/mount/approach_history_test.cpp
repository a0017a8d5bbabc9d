#include "edge/mount/approach_history.h"

#include <gtest/gtest.h>

namespace ols::mount {
namespace {

constexpr double kStep = 5.61e-5;

class ApproachTest : public testing::Test {
 protected:
  // One sample each 25 ms, in counts.
  void pass(double pan, double tilt) {
    history.add(time_s, {pan * kStep, tilt * kStep});
    time_s += 0.025;
  }
  Approach now() const { return history.at(time_s); }
  ApproachHistory history{{kStep, kStep}};
  double time_s = 100.0;
};

TEST_F(ApproachTest, IsUnknownUntilTheUnitHasMoved) {
  pass(100, 50);
  pass(101, 50);
  EXPECT_EQ(now().pan, 0) << "a count is noise of the reading";
  pass(103, 50);
  EXPECT_EQ(now().pan, 1);
  EXPECT_EQ(now().tilt, 0);
}

TEST_F(ApproachTest, StaysWhileTheUnitStandsAndTurnsWithIt) {
  for (const int pan : {0, 100, 200, 200, 199, 200, 201}) pass(pan, -pan);
  EXPECT_EQ(now().pan, 1);
  EXPECT_EQ(now().tilt, -1);
  time_s += 1000.0;
  EXPECT_EQ(now().pan, 1) << "it stands for long";
  pass(190, -201);
  EXPECT_EQ(now().pan, -1);
  EXPECT_EQ(now().tilt, -1);
}

TEST_F(ApproachTest, AnExposureHasTheOneOfItsInstant) {
  for (const int pan : {0, 100, 200}) pass(pan, 0);
  const double before_s = time_s - 0.05;
  for (const int pan : {150, 100, 50}) pass(pan, 0);
  EXPECT_EQ(history.at(before_s - 0.001).pan, 1);
  EXPECT_EQ(now().pan, -1);
}

TEST_F(ApproachTest, ForgetsWithItsAngles) {
  for (const int pan : {0, 100}) pass(pan, pan);
  history.clear();
  EXPECT_EQ(now().pan, 0);
  pass(500, 500);
  EXPECT_EQ(now().pan, 0) << "the jump is no motion";
}

TEST_F(ApproachTest, KeepsNoEndlessList) {
  for (int i = 0; i < 100000; ++i) pass(i % 2 == 0 ? 0 : 100, 0);
  EXPECT_NE(history.at(time_s).pan, 0);
  EXPECT_EQ(history.at(100.1).pan, 0) << "what is older than any bearing is dropped";
}

}  // namespace
}  // namespace ols::mount
