// ols-bench-false-alarms: what a station's detector confirms in hours of weather without a target.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "dev/bench/program.h"
#include "dev/bench/synthetic_scene.h"
#include "dev/bench/weather.h"
#include "edge/detector/detector_work.h"
#include "geometry/chi_square.h"

namespace {

using ols::bench::WeatherKind;
using ols::detector::Tracklet;

constexpr double kWatch_s = 120.0;  // of one detector before one scene
constexpr double kRate_hz = 10.0;   // of a station by default

struct Arguments {
  std::vector<std::string> kinds;
  double hours = 1.0;
  int width_px = 640;
  double false_an_hour = 1.0;
  std::uint64_t seed = 1;
  std::string output, pictures;
};

void declare(CLI::App& app, Arguments& arguments) {
  std::vector<std::string> names;
  for (const WeatherKind& kind : ols::bench::weather_kinds()) names.push_back(kind.name);
  app.add_option("--weather", arguments.kinds, "only these, for example clouds,stars")
      ->delimiter(',')
      ->check(CLI::IsMember(names));
  app.add_option("--hours", arguments.hours, "simulated hours of each, in watches of two minutes")
      ->check(CLI::Range(0.03, 1000.0))
      ->capture_default_str();
  app.add_option("--width", arguments.width_px, "of the pictures [px]; the height is 3/4 of it")
      ->check(CLI::Range(320, 1280))
      ->capture_default_str();
  app.add_option("--false-alarms", arguments.false_an_hour, "the setting: allowed in an hour")
      ->check(CLI::Range(1e-3, 1e4))
      ->capture_default_str();
  app.add_option("--seed", arguments.seed, "of the first watch")->capture_default_str();
  app.add_option("--output", arguments.output, "CSV, a row for each confirmed tracklet");
  app.add_option("--pictures", arguments.pictures,
                 "folder for a picture in which each tracklet was confirmed (PNG)");
}

// Which way of the detector a confirmed tracklet came.
enum class Way { kDim, kClear, kTravelling };
constexpr std::array<const char*, 3> kWays{"dim", "clear", "travelling"};

Way way_of(const Tracklet& tracklet) {
  if (tracklet.path()) return Way::kDim;
  return tracklet.confirmed_clear() ? Way::kClear : Way::kTravelling;
}

class Tally {
 public:
  void count(Way way) { ++ways_.at(static_cast<std::size_t>(way)); }
  void add_watch() { hours_ += kWatch_s / 3600.0; }
  void print(const WeatherKind& kind) const {
    int count = 0;
    for (const int way : ways_) count += way;
    const auto bound = [this](double level, int degrees) {
      return degrees == 0 ? 0.0 : 0.5 * ols::chi_square_critical(level, degrees) / hours_;
    };
    std::printf("| %s | %s | %.2f | %d | %.2f | %.2f to %.2f | %d | %d | %d |\n", kind.name.c_str(),
                kind.before_sky ? "sky" : "ground", hours_, count, count / hours_,
                bound(0.975, 2 * count), bound(0.025, 2 * count + 2), ways_[0], ways_[1], ways_[2]);
    std::fflush(stdout);
  }

 private:
  double hours_ = 0.0;
  std::array<int, kWays.size()> ways_{};
};

class Bench {
 public:
  explicit Bench(const Arguments& arguments)
      : arguments_(arguments), size_(arguments.width_px, arguments.width_px * 3 / 4) {
    config_.tracklets.false_an_hour = arguments.false_an_hour;
    if (!arguments.pictures.empty()) std::filesystem::create_directories(arguments.pictures);
    if (arguments.output.empty()) return;
    rows_.open(arguments.output);
    rows_ << "weather,seed,time_s,x,y,w,h,signal,way\n";
  }

  void run(const WeatherKind& kind) {
    Tally tally;
    const auto watches =
        static_cast<std::uint64_t>(std::lround(arguments_.hours * 3600 / kWatch_s));
    for (std::uint64_t i = 0; i < watches; ++i) {
      watch(kind, arguments_.seed + i, tally);
      tally.add_watch();
      std::cerr << kind.name << ' ' << i + 1 << " of " << watches << '\n';
    }
    tally.print(kind);
  }

 private:
  void watch(const WeatherKind& kind, std::uint64_t seed, Tally& tally) {
    const auto weather = kind.make(size_, seed);
    ols::tracker::Random random(seed);
    ols::detector::PictureDetector detector(config_);
    std::set<long> known;
    ols::detector::Stars stars;
    if (const auto drift = weather->star_drift_px_s()) {
      stars = {true, Eigen::Matrix3d::Identity()};
      stars.motion->topRightCorner<2, 1>() = *drift / kRate_hz;
    }
    for (int i = 0; i < static_cast<int>(kWatch_s * kRate_hz); ++i) {
      const cv::Mat gray = noise_.develop(weather->next(1.0 / kRate_hz), random);
      // The mount stands still and says so.
      const auto found = detector.look({gray, i / kRate_hz, Eigen::Matrix3d::Identity(), stars});
      for (const Tracklet& tracklet : found.confirmed) {
        if (!known.insert(tracklet.id()).second) continue;
        tally.count(way_of(tracklet));
        note(kind, seed, i, tracklet, gray);
      }
    }
  }

  void note(const WeatherKind& kind, std::uint64_t seed, int image, const Tracklet& tracklet,
            const cv::Mat& gray) {
    const char* way = kWays.at(static_cast<std::size_t>(way_of(tracklet)));
    const Eigen::Vector2d &at = tracklet.pixel(), &size = tracklet.size_px();
    rows_ << kind.name << ',' << seed << ',' << image / kRate_hz << ',' << at.x() << ',' << at.y()
          << ',' << size.x() << ',' << size.y() << ',' << tracklet.signal_to_noise() << ',' << way
          << '\n';
    rows_.flush();
    if (arguments_.pictures.empty()) return;
    const std::string name = kind.name + '_' + std::to_string(seed) + '_' + std::to_string(image) +
                             '_' + std::to_string(tracklet.id()) + ".png";
    if (!cv::imwrite(arguments_.pictures + '/' + name, gray))
      throw std::runtime_error(name + ": cannot be written");
  }

  Arguments arguments_;
  cv::Size size_;
  ols::detector::DetectorConfig config_;
  ols::bench::PixelNoise noise_;
  std::ofstream rows_;
};

void run(const Arguments& arguments) {
  Bench bench(arguments);
  std::printf(
      "%d x %d px, %.0f images a second, noise of %.1f grey levels, seeds from %lu; setting: %g "
      "an hour\n",
      arguments.width_px, arguments.width_px * 3 / 4, kRate_hz, ols::bench::kNoiseSd,
      static_cast<unsigned long>(arguments.seed), arguments.false_an_hour);
  std::printf(
      "| weather | before | hours | confirmed | an hour | 95 %% of it | dim | clear | travelling "
      "|\n"
      "|---|---|---|---|---|---|---|---|---|\n");
  for (const WeatherKind& kind : ols::bench::weather_kinds()) {
    const auto& wanted = arguments.kinds;
    if (wanted.empty() || std::ranges::find(wanted, kind.name) != wanted.end()) bench.run(kind);
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Counts what the detector confirms in weather without a target.",
               "ols-bench-false-alarms");
  Arguments arguments;
  declare(app, arguments);
  cv::setNumThreads(1);
  return ols::bench::run_program(app, argc, argv, [&] { run(arguments); });
}
