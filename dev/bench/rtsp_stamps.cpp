// Serves pictures that show when they were exposed, by RTSP, and receives them as a station does:
// what is their time wrong by, how old are they, what does a station's core pay.
//
// By arrivals, the errors of one connection are one error: that of its delay. So told over actual
// needs several cameras, which --url names one by one.
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <iostream>
#include <random>
#include <stdexcept>
#include <thread>
#include <vector>

#include "base/process/clocks.h"
#include "base/process/command_line.h"
#include "base/process/shutdown.h"
#include "edge/camera/rtsp/rtsp_camera.h"
#include "sim/camera/rtsp_server.h"
#include "sim/camera/time_in_picture.h"

namespace {

struct Options {
  std::vector<std::string> urls;  // empty: serve
  int cameras = 1;                // served, at successive ports
  ols::sim::RtspServerConfig server;
  ols::camera::RtspConfig camera;
  double seconds = 30.0, after_s = 15.0, calibrate_s = 0.0, delay_error_s = 0.0, clock_off_s = 0.0;
};

// A sky with noise of 2 gray levels, drawn once, shifted for each picture.
class Sky {
 public:
  explicit Sky(cv::Size size) : sky_(size + cv::Size(64, 64), CV_8U) {
    std::normal_distribution<double> noise(0.0, 2.0);
    for (int y = 0; y < sky_.rows; ++y)
      for (int x = 0; x < sky_.cols; ++x)
        sky_.at<std::uint8_t>(y, x) =
            static_cast<std::uint8_t>(120.0 + 60.0 * y / sky_.rows + noise(random_));
  }
  void draw(const ols::sim::Exposure& exposure, cv::Mat& gray) {
    const cv::Point shift(static_cast<int>(random_() % 64), static_cast<int>(random_() % 64));
    sky_(cv::Rect(shift, gray.size())).copyTo(gray);
    ols::sim::draw_time(
        exposure.start_monotonic_ns / 1000 + std::llround(0.5e6 * exposure.exposure_s), gray);
  }

 private:
  std::mt19937 random_{1};
  cv::Mat sky_;
};

void serve(const Options& options) {
  std::vector<std::unique_ptr<ols::sim::RtspServer>> servers;
  for (int i = 0; i < options.cameras; ++i) {
    auto config = options.server;
    config.port += i;
    const auto sky = std::make_shared<Sky>(cv::Size(config.width_px, config.height_px));
    const auto draw = [sky](const auto& exposure, cv::Mat& gray) { sky->draw(exposure, gray); };
    servers.push_back(std::make_unique<ols::sim::RtspServer>(config, draw));
    servers.back()->set_faults({.clock_off_s = options.clock_off_s});
    std::cout << servers.back()->url() << std::endl;
  }
  while (!ols::shutdown_requested()) std::this_thread::sleep_for(std::chrono::milliseconds(100));
}

double cpu_s() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  return static_cast<double>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
         1e-6 * static_cast<double>(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return std::nan("");
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

struct Measured {
  std::vector<double> ages_s, errors_s;
  double told_s2 = 0.0;
  int by_reports = 0;
  std::string text;  // the camera's own report, and its alarms
};

// Sets the delay that the sender reports of this time imply, and its 1-sigma. The reports of these
// cameras are exact.
void calibrate(ols::camera::RtspConfig& config, double seconds) {
  ols::camera::RtspCamera camera(config);
  const double until_s = ols::clock_monotonic_s() + seconds;
  while (!ols::shutdown_requested() && ols::clock_monotonic_s() < until_s) camera.next(0.2);
  const auto report = camera.report();
  const auto& readings = report.readings;
  if (!readings.contains("camera_delay_s"))
    throw std::runtime_error(config.url + ": " + report.text);
  config.clock.delay_s = readings.at("camera_delay_s");
  config.clock.delay_sd_s = std::sqrt(std::max(
      0.0, std::pow(readings.at("camera_delay_sd_s"), 2) - std::pow(config.clock.report_sd_s, 2)));
}

// `late`: whether the error of the calibrated delay makes pictures seem late, not early.
Measured watch(const Options& options, const std::string& url, bool late) {
  auto config = options.camera;
  config.url = url;
  if (options.calibrate_s > 0.0) {
    calibrate(config, options.calibrate_s);
    config.clock.delay_s += (late ? -1.0 : 1.0) * options.delay_error_s;
    config.clock.delay_sd_s = std::hypot(config.clock.delay_sd_s, options.delay_error_s);
    // Reports of a picture that came hours before its exposure are not believed.
    config.clock.report_delay_s = -1e4;
  }
  ols::camera::RtspCamera camera(config);
  const double from_s = ols::clock_monotonic_s() + options.after_s;
  Measured measured;
  while (!ols::shutdown_requested() && ols::clock_monotonic_s() < from_s + options.seconds) {
    const auto frame = camera.next(0.2);
    const double now_s = ols::clock_monotonic_s();
    if (!frame || now_s < from_s) continue;
    const double true_s = 1e-6 * static_cast<double>(ols::sim::time_in(frame->gray));
    measured.ages_s.push_back(now_s - true_s);
    measured.errors_s.push_back(frame->mid_exposure_s - true_s);
    measured.told_s2 += frame->stamp_sd_s * frame->stamp_sd_s;
    measured.by_reports += frame->stamp_source == ols::camera::StampSource::kCamera ? 1 : 0;
  }
  for (const ols::Alarm& alarm : camera.report().alarms) measured.text += alarm.text + "\n";
  measured.text += camera.report().text;
  return measured;
}

// Of all cameras together.
void say(const std::vector<Measured>& cameras, double core) {
  std::vector<double> ages_s, errors_s;
  double square_s2 = 0.0, told_s2 = 0.0, sum_s = 0.0;
  int by_reports = 0;
  for (const Measured& camera : cameras) {
    ages_s.insert(ages_s.end(), camera.ages_s.begin(), camera.ages_s.end());
    double own_s = 0.0;
    for (const double error_s : camera.errors_s) {
      errors_s.push_back(std::abs(error_s));
      own_s += error_s;
      square_s2 += error_s * error_s;
    }
    sum_s += own_s;
    told_s2 += camera.told_s2;
    by_reports += camera.by_reports;
    const double count = static_cast<double>(camera.errors_s.size());
    std::cout << camera.text << ": mean error [ms] " << 1e3 * own_s / count << ", told "
              << 1e3 * std::sqrt(camera.told_s2 / count) << "\n";
  }
  const double n = static_cast<double>(errors_s.size());
  std::cout << "frames " << n << ", by sender reports " << by_reports << "\nstamp error [ms]: mean "
            << 1e3 * sum_s / n << ", rms " << 1e3 * std::sqrt(square_s2 / n) << ", 95 % "
            << 1e3 * quantile(errors_s, 0.95) << ", worst " << 1e3 * quantile(errors_s, 1.0)
            << "; told over actual " << std::sqrt(told_s2 / square_s2)
            << "\nage of a picture [ms]: median " << 1e3 * quantile(ages_s, 0.5) << ", 95 % "
            << 1e3 * quantile(ages_s, 0.95) << "\ncore " << core << std::endl;
}

void watch_all(const Options& options) {
  std::vector<Measured> cameras(options.urls.size());
  const double begun_s = ols::clock_monotonic_s();
  {
    std::vector<std::jthread> threads;
    for (std::size_t i = 0; i < cameras.size(); ++i)
      threads.emplace_back([&, i] { cameras[i] = watch(options, options.urls[i], i % 2 == 1); });
  }
  say(cameras, cpu_s() / (ols::clock_monotonic_s() - begun_s));
}

}  // namespace

int main(int argc, char** argv) {
  ols::install_shutdown_handler();
  CLI::App app("Serves pictures by RTSP that show their own time, or with --url measures them.");
  Options o;
  o.server.address = "127.0.0.1";
  o.server.delay_s = 0.0;
  app.add_option("--url", o.urls, "measure this stream; may be repeated");
  app.add_option("--cameras", o.cameras, "served, at this port and those after it")
      ->capture_default_str();
  app.add_option("--port", o.server.port, "of the server")->capture_default_str();
  app.add_option("--width", o.server.width_px, "[px]")->capture_default_str();
  app.add_option("--height", o.server.height_px, "[px]")->capture_default_str();
  app.add_option("--rate", o.server.frame_rate_hz, "[Hz]")->capture_default_str();
  app.add_option("--clock-off", o.clock_off_s, "[s] of the served camera's UTC")
      ->capture_default_str();
  app.add_option("--seconds", o.seconds, "[s] measured")->capture_default_str();
  app.add_option("--after", o.after_s, "[s] before that")->capture_default_str();
  app.add_option("--calibrate", o.calibrate_s,
                 "[s] by sender reports first, for the delay and its 1-sigma; then by arrivals "
                 "alone, with these")
      ->capture_default_str();
  app.add_option(
         "--delay-error", o.delay_error_s,
         "[s] by which --calibrate makes the delay wrong, either way in turn; it is part of "
         "the 1-sigma")
      ->capture_default_str();
  app.add_option("--delay", o.camera.clock.delay_s, "[s] delay_s")->capture_default_str();
  app.add_option("--delay-sd", o.camera.clock.delay_sd_s, "[s] delay_sd_s")->capture_default_str();
  app.add_option("--report-sd", o.camera.clock.report_sd_s, "[s] report_sd_s")
      ->capture_default_str();
  return ols::run_command(app, argc, argv, "ols-bench-rtsp", [&] {
    o.camera.width_px = o.server.width_px;
    o.camera.height_px = o.server.height_px;
    o.camera.frame_rate_hz = o.server.frame_rate_hz;
    o.urls.empty() ? serve(o) : watch_all(o);
    return 0;
  });
}
