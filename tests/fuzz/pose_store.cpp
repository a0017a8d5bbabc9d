// The file of the pose kept over a restart: refused, or a pose that is one and comes back as it is.
#include <cmath>

#include "edge/sensors/persisted_pose.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto read = ols::sensors::persisted_pose_from(ols::fuzz::text(data, size));
  const auto* pose = std::get_if<ols::sensors::PersistedPose>(&read);
  if (pose == nullptr) {
    ols::fuzz::require(!std::get<std::string>(read).empty(), "a refusal says why");
    return 0;
  }
  if (pose->position) {
    ols::fuzz::require(std::abs(pose->position->ground.latitude_rad) < 1.6, "on the Earth");
    ols::fuzz::require((pose->position->sd_enu_m.array() > 0.0).all(), "with its sigmas");
  }
  if (pose->tilt) ols::fuzz::require(pose->tilt->tilt_rad.allFinite(), "a tilt is finite");
  return 0;
}
