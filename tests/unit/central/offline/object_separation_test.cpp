#include "central/offline/object_separation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/central/scene.h"

namespace ols::fusion {
namespace {

using Eigen::Vector3d;
using test::measurement_of;
using test::ray_to;

constexpr std::int64_t kStart = 1'600'000'000'000'000;

Vector3d place_of(int object, double t_s) {
  return {object == 0 ? -60.0 + 5.0 * t_s : 60.0 - 5.0 * t_s, 40.0 * object, 80.0 + 20.0 * object};
}

// Four stations see each of the objects in every exposure; belief says which object it was.
std::vector<BearingMeasurement> recording(int objects, double seconds) {
  std::vector<BearingMeasurement> measurements;
  for (int i = 0; i < std::lround(30.0 * seconds); ++i) {
    for (std::size_t k = 0; k < 4; ++k) {
      for (int object = 0; object < objects; ++object) {
        const Ray ray = ray_to(std::string(1, static_cast<char>('a' + k)), test::square()[k],
                               place_of(object, i / 30.0));
        measurements.push_back(measurement_of(ray, kStart + std::llround(i / 30.0 * 1e6)));
        measurements.back().belief = object == 0 ? 1.0 : 0.9;
      }
    }
  }
  return measurements;
}

MutableBearings pointers(std::vector<BearingMeasurement>& measurements) {
  MutableBearings all;
  for (BearingMeasurement& measurement : measurements) all.push_back(&measurement);
  return all;
}

TEST(ObjectSeparation, SeesSeveralObjectsInOneExposure) {
  auto two = recording(2, 0.1);
  EXPECT_TRUE(shows_several_objects(pointers(two)));
  auto one = recording(1, 0.1);
  EXPECT_FALSE(shows_several_objects(pointers(one)));
  one.push_back(one.front());  // given twice, it is one
  EXPECT_FALSE(shows_several_objects(pointers(one)));
}

TEST(ObjectSeparation, GivesEachObjectItsOwnBearings) {
  auto measurements = recording(2, 4.0);
  std::size_t told = 0;
  const SeparatedBearings separated =
      separate_objects(pointers(measurements), FusionConfig(), [&] { ++told; });
  EXPECT_EQ(told, measurements.size());
  ASSERT_EQ(separated.objects.size(), 2U);
  std::size_t labelled = 0;
  for (const auto& [id, bearings] : separated.objects) {
    labelled += bearings.size();
    for (const BearingMeasurement* bearing : bearings) {
      EXPECT_EQ(bearing->belief, bearings.front()->belief) << "object " << id;
    }
  }
  EXPECT_EQ(labelled + separated.unexplained, measurements.size());
  EXPECT_GT(labelled, measurements.size() * 9 / 10);
}

TEST(ObjectSeparation, CountsWhatItLeavesOut) {
  auto measurements = recording(1, 2.0);
  measurements.push_back(measurements.front());
  measurements.push_back(measurements.front());
  measurements[9].belief = 0.01;
  const SeparatedBearings separated =
      separate_objects(pointers(measurements), FusionConfig(), nullptr);
  EXPECT_EQ(separated.duplicate, 2U);
  EXPECT_EQ(separated.low_belief, 1U);
}

}  // namespace
}  // namespace ols::fusion
