// Unwraps the camera's frame numbers, and counts missing frames. Pure.
#pragma once

#include <cstdint>

namespace ols::camera {

class FrameNumbers {
 public:
  struct Step {
    std::uint64_t number = 0;  // never decreases
    std::uint64_t lost = 0;    // number of frames missing since the previous one
  };

  // Takes the number of a frame: 16 bits from 1 to 65535 (GigE Vision 1.x; 0 is skipped), or 64
  // bits. A number that does not increase means that the camera has restarted.
  Step next(std::uint64_t id);

  // Notes that the camera was reopened, so that a gap before its next number does not count as a
  // loss.
  void restart() { running_ = false; }

 private:
  bool running_ = false;
  std::uint64_t last_id_ = 0;
  std::uint64_t number_ = 0;
};

}  // namespace ols::camera
