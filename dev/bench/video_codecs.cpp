// ols-bench-video: what a station's video costs a link, as JPEGs and as H.264 that is as true to
// the picture: the scenario's pictures of a station that follows the target, in simulated time, so
// that the figures are the same on any computer. The stream is decoded by ffmpeg, not by its own
// library.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <string>
#include <utility>
#include <vector>

#include "base/command_line.h"
#include "edge/video/h264_encoder.h"
#include "geometry/sight.h"
#include "sim/renderer.h"
#include "sim/scenario.h"

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

struct Arguments {
  std::string scenario = "sim/scenarios/overview.toml";
  int frames = 90, width_px = 960;
  double rate_hz = 15.0;
  bool stands = false;
  std::vector<int> qualities = {45, 65, 85};
};

struct Cost {
  double bytes = 0.0;  // of a picture, mean
  double psnr_db = 0.0;
  double made_ms = 0.0;
};

// As the first station sees the target, or past which it flies while the station stands.
std::vector<cv::Mat> pictures(const Arguments& arguments) {
  const ols::sim::World world(ols::sim::load_scenario(arguments.scenario), 1);
  const auto renderers = ols::sim::make_renderers(world);
  std::vector<cv::Mat> made;
  ols::PanTilt still;
  for (int i = 0; i < arguments.frames; ++i) {
    const double time_s = 20.0 + i / arguments.rate_hz;
    const auto aim = ols::aim_at(world.stations()[0].truth, world.target(0, time_s).p_ecef);
    if (i == 0) still = aim.value();
    ols::sim::ExposureTruth exposure;
    exposure.mid_s = time_s;
    exposure.exposure_s = 0.002;
    exposure.start = exposure.mid = exposure.end = arguments.stands ? still : aim.value();
    exposure.frame = static_cast<std::uint64_t>(i);
    cv::Mat gray, small;
    renderers[0]->draw(exposure, gray);
    const double scale = static_cast<double>(arguments.width_px) / gray.cols;
    cv::resize(gray, small, {arguments.width_px, 2 * static_cast<int>(gray.rows * scale / 2)}, 0, 0,
               cv::INTER_AREA);
    made.push_back(small);
  }
  return made;
}

double squared_error(const cv::Mat& a, const cv::Mat& b) {
  const double norm = cv::norm(a, b, cv::NORM_L2);
  return norm * norm / static_cast<double>(a.total());
}

double decibels(double mean_squared_error) {
  return 10.0 * std::log10(255.0 * 255.0 / mean_squared_error);
}

double since_ms(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

Cost of_jpeg(const std::vector<cv::Mat>& all, int quality) {
  Cost cost;
  double error = 0.0;
  for (const cv::Mat& one : all) {
    std::vector<std::uint8_t> bytes;
    const auto start = Clock::now();
    cv::imencode(".jpg", one, bytes, {cv::IMWRITE_JPEG_QUALITY, quality});
    cost.made_ms += since_ms(start);
    cost.bytes += static_cast<double>(bytes.size());
    error += squared_error(one, cv::imdecode(bytes, cv::IMREAD_GRAYSCALE));
  }
  const auto count = static_cast<double>(all.size());
  return {cost.bytes / count, decibels(error / count), cost.made_ms / count};
}

// The last is the picture behind the last unit: all must come out.
Cost of_stream(const std::vector<cv::Mat>& all, int quality) {
  const fs::path file = fs::temp_directory_path() / "ols-bench-video.h264";
  std::ofstream out(file, std::ios::binary);
  ols::video::H264Encoder encoder;
  Cost cost;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto start = Clock::now();
    const auto unit = encoder.encode(all[i], quality, i % 90 == 0, static_cast<std::int64_t>(i));
    cost.made_ms += since_ms(start);
    cost.bytes += static_cast<double>(unit.size());
    out.write(reinterpret_cast<const char*>(unit.data()),
              static_cast<std::streamsize>(unit.size()));
  }
  out.close();
  cv::VideoCapture decoder(file.string(), cv::CAP_FFMPEG);
  double error = 0.0;
  std::size_t decoded = 0;
  for (cv::Mat colour, gray; decoded < all.size() && decoder.read(colour); ++decoded) {
    cv::extractChannel(colour, gray, 1);
    error += squared_error(all[decoded], gray);
  }
  fs::remove(file);
  if (decoded != all.size()) throw std::runtime_error("ffmpeg decodes not all of the stream");
  const auto count = static_cast<double>(all.size());
  return {cost.bytes / count, decibels(error / count), cost.made_ms / count};
}

// Bytes of a stream at this PSNR, between two of its qualities; by the logarithm.
double bytes_at(const std::vector<Cost>& stream, double psnr_db) {
  for (std::size_t i = 1; i < stream.size(); ++i) {
    if (stream[i].psnr_db < psnr_db && i + 1 < stream.size()) continue;
    const Cost &a = stream[i - 1], &b = stream[i];
    const double share = (psnr_db - a.psnr_db) / (b.psnr_db - a.psnr_db);
    return std::exp(std::log(a.bytes) + share * std::log(b.bytes / a.bytes));
  }
  return NAN;
}

int run(const Arguments& arguments) {
  const auto all = pictures(arguments);
  const double kbit = 8e-3 * arguments.rate_hz;
  std::vector<Cost> stream;
  std::printf("%-8s %8s %9s %10s %8s\n", "codec", "quality", "PSNR dB", "kbit/s", "ms");
  for (int quality = 5; quality <= 100; quality += 10) {
    stream.push_back(of_stream(all, quality));
    const Cost& c = stream.back();
    std::printf("%-8s %8d %9.1f %10.0f %8.1f\n", "H.264", quality, c.psnr_db, kbit * c.bytes,
                c.made_ms);
  }
  for (const int quality : arguments.qualities) {
    const Cost c = of_jpeg(all, quality);
    const double same = bytes_at(stream, c.psnr_db);
    std::printf("%-8s %8d %9.1f %10.0f %8.1f   H.264 as true: %.0f kbit/s, 1/%.1f\n", "JPEG",
                quality, c.psnr_db, kbit * c.bytes, c.made_ms, kbit * same, c.bytes / same);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"The rate of a station's video as JPEGs, and as H.264 that is as true to it"};
  Arguments arguments;
  app.add_option("--scenario", arguments.scenario, "scenario file (TOML)")->capture_default_str();
  app.add_option("--frames", arguments.frames, "pictures")
      ->check(CLI::Range(2, 10000))
      ->capture_default_str();
  app.add_option("--width", arguments.width_px, "[px] of a picture; even")->capture_default_str();
  app.add_option("--rate", arguments.rate_hz, "[Hz]")->capture_default_str();
  app.add_flag("--stands", arguments.stands, "the station does not follow the target");
  if (const auto status = ols::parse_command_line(app, argc, argv, "ols-bench-video")) {
    return *status;
  }
  try {
    return run(arguments);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "ols-bench-video: %s\n", error.what());
    return 1;
  }
}
