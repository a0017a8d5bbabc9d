// The filter's inner loop takes no memory from the heap once it runs: what is counted here is every
// operator new of this program, and every aligned piece, which is what cv::Mat asks for.
#include <gtest/gtest.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <new>

#include "edge/tracker/particle_filter.h"
#include "edge/tracker/target_model.h"
#include "tests/unit/edge/tracker/synthetic.h"

namespace {
std::atomic<long> allocations{0};
}

// Not inlined: a compiler that sees through one of them only takes them for mismatched.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

extern "C" int posix_memalign(void** memory, std::size_t alignment, std::size_t size) {
  ++allocations;
  *memory = std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
  return *memory == nullptr ? ENOMEM : 0;
}

namespace ols::tracker {
namespace {

TEST(Allocation, OfAPictureIsCounted) {
  const long before = allocations;
  const cv::Mat picture(64, 64, CV_8U);
  EXPECT_GT(allocations, before);
  EXPECT_FALSE(picture.empty());
}

TEST(Allocation, TheFiltersInnerLoopHasNone) {
  testing::SyntheticScene pictures(testing::Backdrop::kTextured, 1);
  const cv::Point2d at(300.0, 220.0);
  const cv::Mat gray = pictures.picture({400, 300}, at);
  const TrackerConfig config;
  const cv::Rect2d box = testing::SyntheticScene::box_around(at);
  const TargetModel target(config, gray, box);
  Particle first;
  first.pixel = centre_of(box);
  first.size_px = size_of(box);
  ParticleFilter filter;
  filter.particles().assign(300, first);
  MotionModel motion(config);
  motion.begin_frame({Eigen::Matrix3d::Identity(), 0.04}, first.pixel);
  Random random(1);
  const Scene scene = target.make_scene(gray, filter.particles(), box,
                                        ReferenceFrames(config.reference_interval_s));
  long counted = 0;
  for (int frame = 0; frame < 3; ++frame) {
    const long before = allocations;
    filter.advance(motion);
    filter.disturb(motion, random);
    filter.weigh([&](const Particle& p) {
      const Similarity likeness = target.likeness(scene, p.pixel, p.size_px);
      const double out = target.standing_out(scene, p.pixel, p.size_px);
      return target.log_likelihood(likeness, 0.3, out, p.size_px);
    });
    filter.maximum_a_posteriori();
    filter.resample(random);
    counted = allocations - before;
    if (frame == 0) {
      EXPECT_GT(counted, 0);  // the first frame's vectors: the counter counts
    }
  }
  EXPECT_EQ(counted, 0);
}

}  // namespace
}  // namespace ols::tracker
