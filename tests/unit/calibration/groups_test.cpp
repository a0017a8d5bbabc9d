#include "calibration/groups.h"

#include <gtest/gtest.h>

#include "tests/unit/calibration/scene.h"

namespace ols::calibration {
namespace {

using test::hill;
using test::landmarks_around;

TEST(Network, RefusesWhatItCannotUseByLine) {
  Problem problem = landmarks_around(hill(), hill(), 3);
  problem.observations[4].reference = "nowhere";
  try {
    network_of(problem);
    FAIL();
  } catch (const ObservationRefused& refused) {
    EXPECT_EQ(refused.line(), 5U);
    EXPECT_STREQ(refused.what(), "reference: 'nowhere' is not one of the references");
  }
  problem.observations[4].kind = Kind::kStar;
  problem.observations[4].reference = "";
  EXPECT_THROW(network_of(problem), ObservationRefused);
}

}  // namespace
}  // namespace ols::calibration
