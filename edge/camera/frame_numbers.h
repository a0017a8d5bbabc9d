// The camera's frame numbers, unwrapped, and the frames that are missing between them. Pure.
#pragma once

#include <cstdint>

namespace ols::camera {

class FrameNumbers {
 public:
  struct Step {
    std::uint64_t number = 0;  // never goes back
    std::uint64_t lost = 0;    // frames missing since the one before
  };

  // The number that came with a frame: 16 bits running from 1 to 65535 (GigE Vision 1.x; 0 is
  // skipped) or 64 bits. One that does not go forward means that the camera began again.
  Step next(std::uint64_t id);

  // The camera was opened again: its next number follows on without a loss.
  void restart() { running_ = false; }

 private:
  bool running_ = false;
  std::uint64_t last_id_ = 0;
  std::uint64_t number_ = 0;
};

}  // namespace ols::camera
