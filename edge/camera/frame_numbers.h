// Extends the camera's frame numbers beyond their 16 bits, and counts missing frames. Pure.
#pragma once

#include <cstdint>

namespace ols::camera {

class FrameNumbers {
 public:
  struct Step {
    std::uint64_t number = 0;  // never decreases
    std::uint64_t lost = 0;    // number of frames missing since the previous one
  };

  // Takes a frame's number from the camera. It has 16 bits and runs from 1 to 65535 (GigE Vision
  // 1.x, which skips 0), or it has 64 bits. A 16-bit number has increased if it is up to 32767
  // steps ahead, beyond 65535 too. A number that has not increased means that the camera has
  // restarted its numbering.
  Step next(std::uint64_t id);

  // Notes that the camera was reopened. Numbers that are missing before its next frame then do not
  // count as lost.
  void restart() { running_ = false; }

 private:
  bool running_ = false;
  std::uint64_t last_id_ = 0;
  std::uint64_t number_ = 0;
};

}  // namespace ols::camera
