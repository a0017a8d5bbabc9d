#include "edge/camera/frame_numbers.h"

namespace ols::camera {
namespace {

constexpr std::uint64_t kIds = 65535;  // 1..65535

// Steps forward from `last` to `id`; 0 if it did not increase.
std::uint64_t distance(std::uint64_t last, std::uint64_t id) {
  if (id > kIds || last > kIds) return id > last ? id - last : 0;
  const std::uint64_t steps = (id + kIds - last) % kIds;
  return steps <= kIds / 2 ? steps : 0;
}

}  // namespace

FrameNumbers::Step FrameNumbers::next(std::uint64_t id) {
  const std::uint64_t steps = running_ && id != 0 ? distance(last_id_, id) : 0;
  running_ = true;
  last_id_ = id;
  if (steps == 0) return {.number = ++number_, .lost = 0};
  number_ += steps;
  return {.number = number_, .lost = steps - 1};
}

}  // namespace ols::camera
