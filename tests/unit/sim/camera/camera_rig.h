// A simulated camera and the station's driver of it on 127.0.0.1, and functions that wait for them.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstring>
#include <ctime>
#include <functional>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <thread>

#include "edge/camera/aravis/aravis_camera.h"
#include "sim/camera/simulated_camera.h"

namespace ols {

inline constexpr double kDeadline_s = 60.0;
inline constexpr int kWidth = 320, kHeight = 240;
inline constexpr double kExposure_s = 0.004;

inline double clock_s(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

inline void pause() { std::this_thread::sleep_for(std::chrono::milliseconds(2)); }

// Writes the exposure into the first pixels of its picture.
inline void sign(const sim::Exposure& exposure, cv::Mat& picture) {
  std::memcpy(picture.data, &exposure, sizeof exposure);
}
inline sim::Exposure exposure_of(const camera::Frame& frame) {
  sim::Exposure exposure;
  std::memcpy(&exposure, frame.gray.data, sizeof exposure);
  return exposure;
}
inline double true_middle_s(const camera::Frame& frame) {
  const sim::Exposure exposure = exposure_of(frame);
  return 1e-9 * static_cast<double>(exposure.start_monotonic_ns) + 0.5 * exposure.exposure_s;
}

// Draws a ramp, and writes the exposure into it.
inline void draw(const sim::Exposure& exposure, cv::Mat& picture) {
  for (int y = 0; y < picture.rows; ++y)
    for (int x = 0; x < picture.cols; ++x)
      picture.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>((x + 2 * y) / 8);
  sign(exposure, picture);
}

struct Serve {
  int width_px = kWidth, height_px = kHeight;
  sim::gige::FeatureNames names = sim::gige::FeatureNames::kGt1290c;
  bool tick_frequency = true;
  std::function<void(const sim::Exposure&, cv::Mat&)> paint = draw;
};

inline std::unique_ptr<sim::SimulatedCamera> serve(const Serve& how = {}) {
  sim::SimulatedCameraConfig config;
  config.address = "127.0.0.1";
  config.serial = std::string("T1");
  config.width_px = how.width_px;
  config.height_px = how.height_px;
  config.names = how.names;
  config.tick_frequency = how.tick_frequency;
  return std::make_unique<sim::SimulatedCamera>(config, how.paint);
}

inline camera::AravisConfig station_camera() {
  camera::AravisConfig config;
  config.device = "127.0.0.1";
  config.width_px = kWidth;
  config.height_px = kHeight;
  config.exposure_us = 1e6 * kExposure_s;
  config.frame_rate_hz = 20.0;
  config.retry_s = 0.1;
  config.no_frame_timeout_s = 1.0;
  return config;
}

inline std::optional<camera::Frame> frame_of(camera::AravisCamera& camera) {
  const double end_s = clock_s(CLOCK_MONOTONIC) + kDeadline_s;
  while (clock_s(CLOCK_MONOTONIC) < end_s)
    if (auto frame = camera.next(0.5)) return frame;
  return std::nullopt;
}

inline bool becomes(camera::AravisCamera& camera, const std::function<bool()>& true_now) {
  const double end_s = clock_s(CLOCK_MONOTONIC) + kDeadline_s;
  while (clock_s(CLOCK_MONOTONIC) < end_s) {
    if (true_now()) return true;
    camera.next(0.05);
  }
  return false;
}

inline bool has_alarm(const camera::AravisCamera& camera, const std::string& part) {
  const auto alarms = camera.report().alarms;
  return std::any_of(alarms.begin(), alarms.end(), [&](const std::string& alarm) {
    return alarm.find(part) != std::string::npos;
  });
}

}  // namespace ols
