// A fake camera driver: ioctl(), linked in place of the C library's. No test machine has a camera.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace ols::fake {

struct VideoMode {
  std::uint32_t format = 0;  // V4L2_PIX_FMT_...
  std::uint32_t width = 0, height = 0;
  std::uint32_t rate_hz = 0;
};

struct VideoDevice {
  std::string card;
  std::uint32_t capabilities = 0;  // V4L2_CAP_...
  std::vector<VideoMode> modes{};  // modes of a format stand together
  bool is_stepwise = false;        // sizes and rates from these to smaller ones
};

// While it lives, each opened /dev/null is this camera.
class VideoDriver {
 public:
  explicit VideoDriver(VideoDevice device);
  ~VideoDriver();
  VideoDriver(const VideoDriver&) = delete;
  VideoDriver& operator=(const VideoDriver&) = delete;
};

}  // namespace ols::fake
