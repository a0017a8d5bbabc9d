// Scenes without any target, for the false alarms of a detector: what the weather does before a
// camera that stands still. Each is drawn anew from its seed and does not repeat itself: textures
// drift against each other, plants swing by random gusts, and drops, insects and stars are drawn at
// random.
//
// The camera has 1 px = 75 urad (bench_camera()), an aperture of 6 to 18 mm and exposes for 1 to 10
// ms: a thing nearer than 40 m is out of focus by several pixels, and a drop of rain is a streak.
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

  // The next picture before the sensor's noise [grey levels], `interval_s` after the last.
  virtual const cv::Mat1f& next(double interval_s) = 0;
  // How stars move in the picture, as the station computes it; nullopt by day.
  virtual std::optional<Eigen::Vector2d> star_drift_px_s() const { return std::nullopt; }
};

struct WeatherKind {
  std::string name;
  bool before_sky;  // otherwise before the ground
  std::function<std::unique_ptr<Weather>(const cv::Size& picture, std::uint64_t seed)> make;
};
const std::vector<WeatherKind>& weather_kinds();

}  // namespace ols::bench
