#include "tools/setup/camera_picture.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <vector>

#include "base/config/toml_text.h"
#include "base/files/atomic_file.h"
#include "base/process/clocks.h"
#include "base/text/plain_text.h"
#include "edge/config/device_kinds.h"

namespace ols::setup {
namespace {

// Some cameras send a picture that can be decoded alone only every ten seconds.
constexpr double kFirstPicture_s = 15.0;
constexpr double kFault_s = 8.0;    // a fault that lasts so long stays
constexpr double kSettles_s = 1.0;  // automatic exposure
constexpr int kMostColumns = 100;

// The section [camera] of the answers, in which files are those of the host.
std::string camera_section(const Host& host, const Values& values) {
  Values section = of_table(values, "station.camera");
  for (auto& [key, value] : section) {
    if (key == "password_file") value = toml_text(host.path(text_in(value).value_or("")));
  }
  return "[camera]\n" + as_toml(section);
}

struct Taken {
  cv::Mat gray;        // empty: there is none
  std::string report;  // of the camera
};

Taken take_picture(const camera::CameraKind& kind) {
  const auto camera = kind.open(false);
  Taken taken;
  const double began_s = clock_monotonic_s();
  double end_s = began_s + kFirstPicture_s;
  while (clock_monotonic_s() < end_s) {
    auto frame = camera->next(0.1);
    const bool is_faulty = camera->report().state == device::DeviceState::kFault;
    if (!frame && is_faulty && clock_monotonic_s() > began_s + kFault_s) break;
    if (!frame) continue;
    if (taken.gray.empty()) end_s = clock_monotonic_s() + kSettles_s;
    taken.gray = frame->gray;
  }
  const auto report = camera->report();
  taken.report = report.last_error.empty() ? report.text : report.last_error;
  return taken;
}

void keep(const cv::Mat& gray, const std::string& path) {
  constexpr int kQuality = 90;
  std::vector<unsigned char> jpeg;
  cv::imencode(".jpg", gray, jpeg, {cv::IMWRITE_JPEG_QUALITY, kQuality});
  AtomicFile file(path);
  file.stream().write(reinterpret_cast<const char*>(jpeg.data()),
                      static_cast<std::streamsize>(jpeg.size()));
  file.commit();
}

// Of the terminal; 0: the output is none.
int columns() {
  winsize size{};
  if (::isatty(STDOUT_FILENO) == 0 || ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0) return 0;
  return std::min<int>(size.ws_col, kMostColumns);
}

// The terminal's colours 232 to 255 are the grays between black and white.
int gray_colour(int brightness) { return 232 + brightness * 23 / 255; }

}  // namespace

std::string half_blocks(const cv::Mat& gray, int columns) {
  const int width = std::clamp(columns, 1, gray.cols);
  const int rows = std::max(1, (gray.rows * width / gray.cols + 1) / 2);
  cv::Mat small;
  cv::resize(gray, small, {width, 2 * rows}, 0.0, 0.0, cv::INTER_AREA);
  std::string text;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < width; ++column)
      text += fmt::format("\x1b[38;5;{};48;5;{}m\u2580",
                          gray_colour(small.at<unsigned char>(2 * row, column)),
                          gray_colour(small.at<unsigned char>(2 * row + 1, column)));
    text += "\x1b[0m\n";
  }
  return text;
}

void show_picture(const Host& host, const std::string& station, const Values& values) try {
  station::ChosenCamera camera(station::camera_kinds());
  config::Section whole;
  whole.sections.push_back(camera.section("camera", ""));
  ConfigFile file(camera_section(host, values), "the camera");
  config::read(whole, file.root());
  const Taken taken = take_picture(*camera);
  if (taken.gray.empty()) {
    std::printf("no picture of the camera: %s\n", plain_text(taken.report).c_str());
    return;
  }
  const std::string path = std::filesystem::current_path() / (station + "-camera.jpg");
  keep(taken.gray, path);
  if (const int width = columns()) std::printf("%s", half_blocks(taken.gray, width).c_str());
  std::printf("picture of the camera, %d x %d: %s\n", taken.gray.cols, taken.gray.rows,
              path.c_str());
} catch (const std::exception& trouble) {
  std::printf("no picture of the camera: %s\n", plain_text(trouble.what()).c_str());
}

}  // namespace ols::setup
