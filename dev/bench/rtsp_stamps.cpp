// Serves pictures that show when they were exposed, by RTSP, and receives them as a station does:
// what is their time wrong by, how old are they, what does a station's core pay.
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <iostream>
#include <random>
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
  std::string url;  // empty: serve
  ols::sim::RtspServerConfig server;
  ols::camera::RtspConfig camera;
  double seconds = 30.0, after_s = 15.0, clock_off_s = 0.0;
};

// A sky with noise of 2 gray levels, drawn once, shifted for each picture.
void serve(const Options& options) {
  const auto& c = options.server;
  cv::Mat sky(c.height_px + 64, c.width_px + 64, CV_8U);
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, 2.0);
  for (int y = 0; y < sky.rows; ++y)
    for (int x = 0; x < sky.cols; ++x)
      sky.at<std::uint8_t>(y, x) =
          static_cast<std::uint8_t>(120.0 + 60.0 * y / sky.rows + noise(random));
  ols::sim::RtspServer server(c, [&](const ols::sim::Exposure& exposure, cv::Mat& gray) {
    const cv::Point shift(static_cast<int>(random() % 64), static_cast<int>(random() % 64));
    sky(cv::Rect(shift, gray.size())).copyTo(gray);
    ols::sim::draw_time(
        exposure.start_monotonic_ns / 1000 + std::llround(0.5e6 * exposure.exposure_s), gray);
  });
  server.set_faults({.clock_off_s = options.clock_off_s});
  std::cout << server.url() << std::endl;
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

void watch(const Options& options) {
  ols::camera::RtspCamera camera(options.camera);
  const double begun_s = ols::clock_monotonic_s(), from_s = begun_s + options.after_s;
  std::vector<double> ages_s, errors_s;
  double square_s2 = 0.0, told_s2 = 0.0, sum_s = 0.0, cpu_from_s = 0.0, counted_s = 0.0;
  int by_reports = 0;
  while (!ols::shutdown_requested() && ols::clock_monotonic_s() < from_s + options.seconds) {
    const auto frame = camera.next(0.2);
    const double now_s = ols::clock_monotonic_s();
    if (!frame || now_s < from_s) continue;
    if (errors_s.empty()) {
      cpu_from_s = cpu_s();
      counted_s = now_s;
    }
    const double true_s = 1e-6 * static_cast<double>(ols::sim::time_in(frame->gray));
    const double error_s = frame->mid_exposure_s - true_s;
    ages_s.push_back(now_s - true_s);
    errors_s.push_back(std::abs(error_s));
    sum_s += error_s;
    square_s2 += error_s * error_s;
    told_s2 += frame->stamp_sd_s * frame->stamp_sd_s;
    by_reports += frame->stamp_source == ols::camera::StampSource::kCamera ? 1 : 0;
  }
  const double n = static_cast<double>(errors_s.size());
  const double over_s = ols::clock_monotonic_s() - counted_s;
  for (const ols::Alarm& alarm : camera.report().alarms) std::cout << alarm.text << "\n";
  std::cout << camera.report().text << "\nframes " << n << ", by sender reports " << by_reports
            << "\nstamp error [ms]: mean " << 1e3 * sum_s / n << ", rms "
            << 1e3 * std::sqrt(square_s2 / n) << ", 95 % " << 1e3 * quantile(errors_s, 0.95)
            << ", worst " << 1e3 * quantile(errors_s, 1.0) << "; told over actual "
            << std::sqrt(told_s2 / square_s2) << "\nage of a picture [ms]: median "
            << 1e3 * quantile(ages_s, 0.5) << ", 95 % " << 1e3 * quantile(ages_s, 0.95) << "\ncore "
            << (cpu_s() - cpu_from_s) / over_s << std::endl;
}

}  // namespace

int main(int argc, char** argv) {
  ols::install_shutdown_handler();
  CLI::App app("Serves pictures by RTSP that show their own time, or with --url measures them.");
  Options o;
  o.server.address = "127.0.0.1";
  o.server.delay_s = 0.0;
  app.add_option("--url", o.url, "measure this stream");
  app.add_option("--port", o.server.port, "of the server")->capture_default_str();
  app.add_option("--width", o.server.width_px, "[px]")->capture_default_str();
  app.add_option("--height", o.server.height_px, "[px]")->capture_default_str();
  app.add_option("--rate", o.server.frame_rate_hz, "[Hz]")->capture_default_str();
  app.add_option("--clock-off", o.clock_off_s, "[s] of the served camera's UTC")
      ->capture_default_str();
  app.add_option("--seconds", o.seconds, "[s] measured")->capture_default_str();
  app.add_option("--after", o.after_s, "[s] before that")->capture_default_str();
  app.add_option("--delay", o.camera.clock.delay_s, "[s] delay_s")->capture_default_str();
  app.add_option("--delay-sd", o.camera.clock.delay_sd_s, "[s] delay_sd_s")->capture_default_str();
  app.add_option("--report-sd", o.camera.clock.report_sd_s, "[s] report_sd_s")
      ->capture_default_str();
  return ols::run_command(app, argc, argv, "ols-bench-rtsp", [&] {
    o.camera.url = o.url;
    o.camera.width_px = o.server.width_px;
    o.camera.height_px = o.server.height_px;
    o.camera.frame_rate_hz = o.server.frame_rate_hz;
    o.url.empty() ? serve(o) : watch(o);
    return 0;
  });
}
