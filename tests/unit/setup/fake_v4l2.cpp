#include "tests/unit/setup/fake_v4l2.h"

#include <linux/videodev2.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdarg>
#include <optional>
#include <utility>

namespace ols::fake {
namespace {

std::optional<VideoDevice> driven;

int refuse() {
  errno = EINVAL;
  return -1;
}

template <class Key>
auto distinct(Key key) {
  std::vector<decltype(key(VideoMode{}))> found;
  for (const VideoMode& mode : driven->modes) {
    const auto one = key(mode);
    if (std::ranges::find(found, one) == found.end()) found.push_back(one);
  }
  return found;
}

int tell(v4l2_capability& can) {
  driven->card.copy(reinterpret_cast<char*>(can.card), sizeof can.card - 1);
  // A camera's devices together can do more than each of them.
  can.capabilities = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_META_CAPTURE | V4L2_CAP_DEVICE_CAPS;
  can.device_caps = driven->capabilities;
  return 0;
}

int tell(v4l2_fmtdesc& format) {
  const auto formats = distinct([](const VideoMode& mode) { return mode.format; });
  if (format.index >= formats.size()) return refuse();
  format.pixelformat = formats[format.index];
  return 0;
}

int tell(v4l2_frmsizeenum& size) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> sizes;
  for (const VideoMode& mode : driven->modes) {
    const std::pair one{mode.width, mode.height};
    if (mode.format == size.pixel_format && std::ranges::find(sizes, one) == sizes.end())
      sizes.push_back(one);
  }
  if (size.index >= sizes.size() || (driven->is_stepwise && size.index > 0)) return refuse();
  const auto [width, height] = sizes[size.index];
  size.type = driven->is_stepwise ? V4L2_FRMSIZE_TYPE_STEPWISE : V4L2_FRMSIZE_TYPE_DISCRETE;
  if (driven->is_stepwise) {
    size.stepwise = {16, width, 2, 16, height, 2};
  } else {
    size.discrete = {width, height};
  }
  return 0;
}

int tell(v4l2_frmivalenum& period) {
  std::vector<std::uint32_t> rates;
  for (const VideoMode& mode : driven->modes) {
    const bool fits = driven->is_stepwise
                          ? period.width <= mode.width && period.height <= mode.height
                          : period.width == mode.width && period.height == mode.height;
    if (mode.format == period.pixel_format && fits) rates.push_back(mode.rate_hz);
  }
  if (period.index >= rates.size() || (driven->is_stepwise && period.index > 0)) return refuse();
  period.type = driven->is_stepwise ? V4L2_FRMIVAL_TYPE_STEPWISE : V4L2_FRMIVAL_TYPE_DISCRETE;
  if (driven->is_stepwise) {
    period.stepwise = {{1, rates[period.index]}, {1, 1}, {1, 1}};
  } else {
    period.discrete = {1, rates[period.index]};
  }
  return 0;
}

bool is_null(int file) {
  char name[64]{};
  const std::string link = "/proc/self/fd/" + std::to_string(file);
  const ssize_t length = ::readlink(link.c_str(), name, sizeof name - 1);
  return length > 0 && std::string(name) == "/dev/null";
}

}  // namespace

VideoDriver::VideoDriver(VideoDevice device) { driven = std::move(device); }
VideoDriver::~VideoDriver() { driven.reset(); }

int answer(int file, unsigned long request, void* argument) {
  if (!driven || !is_null(file))
    return static_cast<int>(::syscall(SYS_ioctl, file, request, argument));
  switch (request) {
    case VIDIOC_QUERYCAP:
      return tell(*static_cast<v4l2_capability*>(argument));
    case VIDIOC_ENUM_FMT:
      return tell(*static_cast<v4l2_fmtdesc*>(argument));
    case VIDIOC_ENUM_FRAMESIZES:
      return tell(*static_cast<v4l2_frmsizeenum*>(argument));
    case VIDIOC_ENUM_FRAMEINTERVALS:
      return tell(*static_cast<v4l2_frmivalenum*>(argument));
    default:
      return refuse();
  }
}

}  // namespace ols::fake

extern "C" int ioctl(int file, unsigned long request, ...) noexcept {
  va_list rest;
  va_start(rest, request);
  void* argument = va_arg(rest, void*);
  va_end(rest);
  return ols::fake::answer(file, request, argument);
}
