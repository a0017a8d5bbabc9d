// Scenes without any target, with which the false alarms of a detector are measured: weather in
// front of a camera at rest. Each scene is drawn from its seed and is not periodic: textures drift
// against each other, plants swing in random gusts, and drops, insects and stars are random.
//
// The camera has 1 px = 75 urad (bench_camera()), an aperture of 6 to 18 mm, and exposures of 1 to
// 10 ms. An object nearer than 40 m is therefore blurred over several pixels, and a raindrop is a
// streak.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

namespace ols::bench {

class Weather {
 public:
  Weather() = default;
  virtual ~Weather() = default;
  Weather(const Weather&) = delete;
  Weather& operator=(const Weather&) = delete;

  // The next picture [grey levels] without the sensor's noise, `interval_s` after the last one.
  virtual const cv::Mat1f& next(double interval_s) = 0;
  // The motion of the stars in the picture, as the station computes it; nullopt by day.
  virtual std::optional<Eigen::Vector2d> star_drift_px_s() const { return std::nullopt; }
};

struct WeatherKind {
  std::string name;
  bool before_sky;  // false: the background is the ground
  std::function<std::unique_ptr<Weather>(const cv::Size& picture, std::uint64_t seed)> make;
};
const std::vector<WeatherKind>& weather_kinds();

}  // namespace ols::bench
