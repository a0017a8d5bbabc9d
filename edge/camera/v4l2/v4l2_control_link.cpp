#include "edge/camera/v4l2/v4l2_control_link.h"

#include <fcntl.h>
#include <linux/videodev2.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace ols::camera {
namespace {

std::string name_of(const v4l2_queryctrl& control) {
  std::string name;
  for (const auto byte : control.name) {
    if (byte == 0) break;
    name += static_cast<char>(byte);
  }
  return v4l2_control_name(name);
}

}  // namespace

std::vector<V4l2Control> v4l2_controls_of(const std::string& device) {
  std::vector<V4l2Control> controls;
  const int file = ::open(device.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
  if (file < 0) return controls;
  v4l2_queryctrl control{};
  control.id = V4L2_CTRL_FLAG_NEXT_CTRL;
  while (::ioctl(file, VIDIOC_QUERYCTRL, &control) == 0) {
    const bool is_one =
        control.type != V4L2_CTRL_TYPE_CTRL_CLASS && (control.flags & V4L2_CTRL_FLAG_DISABLED) == 0;
    if (is_one) controls.push_back({name_of(control), control.minimum, control.maximum});
    control.id |= V4L2_CTRL_FLAG_NEXT_CTRL;
  }
  ::close(file);
  return controls;
}

}  // namespace ols::camera
