// Frames of the night sky, taken by a station with the errors of a new unit.
#pragma once

#include <algorithm>
#include <random>
#include <vector>

#include "calibration/star_identification.h"
#include "geometry/pixel_prediction.h"
#include "tests/unit/calibration/scene.h"

namespace ols::calibration::test {

inline constexpr std::int64_t kNight_us = 1'780'000'000'000'000;  // 2026-05-28, 20:26 UTC

struct NightSky {
  StationModel truth;
  StationPrior station;  // the prior, which has another heading and no errors
  std::vector<StarFrame> frames;
  // HIP number of each detection; 0: a false detection.
  std::vector<std::vector<std::int32_t>> stars;
};

struct NightOptions {
  int frames = 3, stars = 10, false_detections = 5;
  double sd_px = 0.3;
  double focal_change = 0.0;
  double tilt_sd_rad = 0.5 * kPi / 180.0;
};

// A unit drawn at random from the prior of a station.
inline StationModel drawn(std::mt19937_64& random, const StationPrior& prior) {
  std::normal_distribution<double> normal;
  ModelParameters by = ModelParameters::Zero();
  for (int k = 0; k < kModelParameters; ++k) {
    const double sd = std::sqrt(prior.covariance(k, k));
    const bool of_wide_lenses = k == kK3 || k == kK4;
    if (sd > 0.0 || !of_wide_lenses) by[k] = sd * normal(random);
  }
  by[kHeading] = std::uniform_real_distribution<double>(0.0, 2.0 * kPi)(random);
  return changed(prior.model, by);
}

inline void add_frame(std::mt19937_64& random, const NightOptions& options, NightSky& sky,
                      const UnitReading& reading, std::int64_t utime_us) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> x(0.0, 1279.0), y(0.0, 959.0);
  StationModel model = sky.truth;
  model.geometry.chain.pan_zero_rad += sky.station.pose_sd_rad * normal(random);
  model.geometry.chain.tilt_zero_rad += sky.station.pose_sd_rad * normal(random);
  std::vector<Star> stars;
  for (const TableStar& star : star_table()) stars.push_back(star_of(star));
  const Geodetic& place = model.geometry.position;
  std::vector<std::pair<Eigen::Vector2d, std::int32_t>> seen;
  for (const auto& [i, direction] :
       stars_between(stars, 10.0, 60.0, utime_us, place, standard_air(place.height_m), {})) {
    const Eigen::Vector3d enu = R_ecef_enu(place).transpose() * direction.ecef;
    const auto image = predict_pixel(model, reading, {enu, 0.0});
    if (!image || image->pixel.x() < 0.0 || image->pixel.x() > 1279.0 || image->pixel.y() < 0.0 ||
        image->pixel.y() > 959.0) {
      continue;
    }
    const Eigen::Vector2d noise(normal(random), normal(random));
    seen.emplace_back(image->pixel + options.sd_px * noise, star_table()[i].hip);
  }
  std::ranges::shuffle(seen, random);
  if (seen.size() > static_cast<std::size_t>(options.stars)) {
    seen.resize(static_cast<std::size_t>(options.stars));
  }
  for (int k = 0; k < options.false_detections; ++k) {
    seen.emplace_back(Eigen::Vector2d(x(random), y(random)), 0);
  }
  std::ranges::shuffle(seen, random);
  StarFrame frame{reading, utime_us, {}};
  std::vector<std::int32_t> numbers;
  for (const auto& [pixel, hip] : seen) {
    frame.pixels.push_back(pixel);
    numbers.push_back(hip);
  }
  sky.frames.push_back(std::move(frame));
  sky.stars.push_back(std::move(numbers));
}

inline NightSky night_sky(std::uint64_t seed, const NightOptions& options = {}) {
  std::mt19937_64 random(seed);
  NightSky sky;
  sky.station = prior_of(hill());
  sky.station.covariance(kFocal, kFocal) =
      std::pow(0.003 * sky.station.model.geometry.camera.fx_px, 2);
  for (const int k : {kTiltX, kTiltY}) {
    sky.station.covariance(k, k) = options.tilt_sd_rad * options.tilt_sd_rad;
  }
  sky.truth = drawn(random, sky.station);
  std::uniform_real_distribution<double> pan(-150.0, 150.0), tilt(15.0, 30.0);
  const std::int64_t at_us =
      kNight_us + std::uniform_int_distribution<std::int64_t>(0, 31'000'000'000'000)(random);
  for (int f = 0; f < options.frames; ++f) {
    UnitReading reading;
    reading.pan.counts = std::round(pan(random) / 360.0 * 112000.0);
    reading.tilt.counts = std::round(tilt(random) / 360.0 * 112000.0);
    add_frame(random, options, sky, reading, at_us + f * 3'000'000);
  }
  return sky;
}

// The detections as sightings of stars with names; none of them may be false.
inline Problem named_stars(const NightSky& sky) {
  Problem problem;
  problem.names = {"alfa"};
  problem.stations = {sky.station};
  for (std::size_t f = 0; f < sky.frames.size(); ++f) {
    for (std::size_t k = 0; k < sky.frames[f].pixels.size(); ++k) {
      Observation one;
      one.kind = Kind::kStar;
      one.utime_us = sky.frames[f].utime_us;
      one.reading = sky.frames[f].reading;
      one.pixel = sky.frames[f].pixels[k];
      one.sd_px = 0.3;
      one.reference = "HIP " + std::to_string(sky.stars[f][k]);
      problem.references[one.reference] = star_of(*table_star(one.reference));
      problem.observations.push_back(one);
    }
  }
  return problem;
}

inline StarConditions conditions_of(const NightSky& sky) {
  return {.air = standard_air(sky.station.model.geometry.position.height_m), .earth = {}};
}

// The number of detections that were identified as a wrong star.
inline int wrong_names(const NightSky& sky, const StarIdentification& found) {
  int wrong = 0;
  for (const IdentifiedStar& one : found.stars) {
    wrong += sky.stars[one.frame][one.detection] == one.star.hip ? 0 : 1;
  }
  return wrong;
}

}  // namespace ols::calibration::test
