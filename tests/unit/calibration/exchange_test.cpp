#include "calibration/exchange.h"

#include <gtest/gtest.h>

#include "tests/unit/calibration/scene.h"

namespace ols::calibration {
namespace {

using test::crooked;
using test::just_put_up;
using test::landmarks_around;
using test::rejected;

TEST(Exchange, NamesTwoLandmarksThatAreExchanged) {
  Problem problem = landmarks_around(crooked(), just_put_up(), 7);
  std::swap(problem.references["landmark1"], problem.references["landmark4"]);
  const Adjustment adjustment(network_of(problem));
  const Calibration found = calibrate(adjustment);
  EXPECT_EQ(rejected(adjustment, found), (std::vector<std::string>{"landmark1", "landmark4"}));
  EXPECT_EQ(exchanged_landmarks(problem, adjustment, found),
            std::vector<std::string>{"landmarks 'landmark1' and 'landmark4' seem to be exchanged"});
}

}  // namespace
}  // namespace ols::calibration
