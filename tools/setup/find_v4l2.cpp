#include "tools/setup/find_v4l2.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/videodev2.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "base/config/toml_text.h"
#include "base/text/plain_text.h"
#include "tools/setup/find_devices.h"

namespace ols::setup {
namespace {

using camera::V4l2Format;

constexpr int kWidest_px = 1920, kHighest_px = 1080;
constexpr double kSlow_hz = 15.0, kFast_hz = 30.0;

std::optional<V4l2Format> format_of(std::uint32_t code) {
  constexpr std::array kJpeg{V4L2_PIX_FMT_MJPEG, V4L2_PIX_FMT_JPEG};
  constexpr std::array kRaw{V4L2_PIX_FMT_YUYV, V4L2_PIX_FMT_UYVY,  V4L2_PIX_FMT_GREY,
                            V4L2_PIX_FMT_NV12, V4L2_PIX_FMT_RGB24, V4L2_PIX_FMT_BGR24};
  if (std::ranges::find(kJpeg, code) != kJpeg.end()) return V4l2Format::kMjpeg;
  if (std::ranges::find(kRaw, code) != kRaw.end()) return V4l2Format::kRaw;
  return std::nullopt;
}

double rate_hz(const v4l2_fract& period) {
  return period.numerator == 0 ? 0.0 : static_cast<double>(period.denominator) / period.numerator;
}

class Device {
 public:
  explicit Device(const std::string& path)
      : file_(::open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC)) {}
  ~Device() {
    if (file_ >= 0) ::close(file_);
  }
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  // Empty: it is no camera. A camera's second device has only data about the pictures.
  std::string name() const {
    v4l2_capability can{};
    if (!ask(VIDIOC_QUERYCAP, can)) return {};
    const std::uint32_t here =
        (can.capabilities & V4L2_CAP_DEVICE_CAPS) != 0 ? can.device_caps : can.capabilities;
    if ((here & V4L2_CAP_VIDEO_CAPTURE) == 0) return {};
    const auto end = std::ranges::find(can.card, 0);
    const std::string card(can.card, end);
    return card.empty() ? "camera" : plain_text(card);
  }

  std::vector<V4l2Mode> modes() const {
    std::vector<V4l2Mode> modes;
    v4l2_fmtdesc format{};
    format.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    for (; ask(VIDIOC_ENUM_FMT, format); ++format.index) {
      if (const auto known = format_of(format.pixelformat))
        add_sizes(format.pixelformat, *known, modes);
    }
    return modes;
  }

 private:
  template <class Answer>
  bool ask(unsigned long request, Answer& answer) const {
    return file_ >= 0 && ::ioctl(file_, request, &answer) == 0;
  }

  void add_sizes(std::uint32_t code, V4l2Format format, std::vector<V4l2Mode>& modes) const {
    v4l2_frmsizeenum size{};
    size.pixel_format = code;
    for (; ask(VIDIOC_ENUM_FRAMESIZES, size); ++size.index) {
      if (size.type == V4L2_FRMSIZE_TYPE_DISCRETE) {
        add_rates(code,
                  {format, static_cast<int>(size.discrete.width),
                   static_cast<int>(size.discrete.height), 0.0},
                  modes);
        continue;
      }
      const int width_px = std::min<int>(kWidest_px, static_cast<int>(size.stepwise.max_width));
      const int height_px = std::min<int>(kHighest_px, static_cast<int>(size.stepwise.max_height));
      add_rates(code, {format, width_px, height_px, 0.0}, modes);
      return;  // one answer describes all
    }
  }

  void add_rates(std::uint32_t code, V4l2Mode mode, std::vector<V4l2Mode>& modes) const {
    v4l2_frmivalenum period{};
    period.pixel_format = code;
    period.width = static_cast<std::uint32_t>(mode.width_px);
    period.height = static_cast<std::uint32_t>(mode.height_px);
    for (; ask(VIDIOC_ENUM_FRAMEINTERVALS, period); ++period.index) {
      const bool one = period.type == V4L2_FRMIVAL_TYPE_DISCRETE;
      mode.frame_rate_hz = rate_hz(one ? period.discrete : period.stepwise.min);
      modes.push_back(mode);
      if (!one) return;
    }
  }

  int file_;
};

}  // namespace

std::optional<V4l2Mode> best_mode(const std::vector<V4l2Mode>& modes) {
  const auto worth = [](const V4l2Mode& mode) {
    const bool fits = mode.width_px <= kWidest_px && mode.height_px <= kHighest_px;
    const bool is_fast = mode.frame_rate_hz >= kSlow_hz;
    const bool is_too_fast = mode.frame_rate_hz > kFast_hz;
    return std::tuple(fits, is_fast, mode.width_px * mode.height_px,
                      mode.format == V4l2Format::kRaw, !is_too_fast,
                      is_too_fast ? -mode.frame_rate_hz : mode.frame_rate_hz);
  };
  const auto best = std::ranges::max_element(modes, {}, worth);
  if (best == modes.end() || best->width_px > kWidest_px || best->height_px > kHighest_px ||
      best->frame_rate_hz <= 0.0)
    return std::nullopt;
  return *best;
}

std::vector<std::string> v4l2_devices() {
  auto devices = devices_in("/dev/v4l/by-id", "");
  return devices.empty() ? devices_in("/dev", "video") : devices;
}

std::vector<Found> find_v4l2(const std::vector<std::string>& devices) {
  std::vector<Found> found;
  for (const std::string& path : devices) {
    const Device device(path);
    const std::string name = device.name();
    if (name.empty()) continue;
    const auto mode = best_mode(device.modes());
    if (!mode) continue;
    const bool is_raw = mode->format == V4l2Format::kRaw;
    found.push_back({fmt::format("{} at {}: {} x {}, {:g} Hz", name, path, mode->width_px,
                                 mode->height_px, mode->frame_rate_hz),
                     {{"station.camera.kind", toml_text("v4l2")},
                      {"station.camera.device", toml_text(path)},
                      {"station.camera.format", toml_text(is_raw ? "raw" : "mjpeg")},
                      {"station.camera.width_px", fmt::format("{}", mode->width_px)},
                      {"station.camera.height_px", fmt::format("{}", mode->height_px)},
                      {"station.camera.frame_rate_hz", fmt::format("{:g}", mode->frame_rate_hz)}}});
  }
  return found;
}

}  // namespace ols::setup
