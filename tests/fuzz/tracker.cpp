// The tracker, driven by whatever comes: frames of any size, format, content and time, boxes,
// homographies, hints. It neither crashes nor gives a number that is none; and what it refuses
// leaves it as it was: a second tracker that is spared all of that gives the same to the last bit.
#include "edge/tracker/tracker.h"

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "tests/fuzz/fuzz_input.h"

namespace {

using ols::fuzz::Input;
using ols::fuzz::require;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A number of any kind: mostly reasonable, sometimes not.
double number(Input& input, double scale) {
  const std::uint8_t kind = input.byte();
  if (kind < 200) return scale * (input.byte() / 128.0 - 0.5);
  if (kind < 240) return 1e3 * scale * (input.byte() - 128.0);
  static constexpr std::array kOdd{0.0, -0.0, kNan, kInfinity, -kInfinity, 1e300, -1e300, 1e-300};
  if (kind < 248) return kOdd[kind - 240U];
  double any = 0.0;
  const std::string_view bytes = input.take(sizeof any);
  std::memcpy(&any, bytes.data(), bytes.size());
  return any;
}

void fill(cv::Mat& image, Input& input) {
  const std::uint8_t kind = input.byte();
  image.setTo(cv::Scalar::all(kind));
  if (image.depth() != CV_8U) return;
  cv::RNG noise(kind);
  if (kind % 4 == 1) noise.fill(image, cv::RNG::NORMAL, 128.0, kind / 4.0);
  if (kind % 4 == 2) {
    for (int row = 0; row < image.rows; ++row) {
      const std::string_view bytes = input.take(4);
      for (std::size_t i = 0; i < bytes.size(); ++i) {
        image.row(row).setTo(cv::Scalar::all(static_cast<std::uint8_t>(bytes[i])));
      }
    }
  }
  if (kind % 4 == 3) {
    // Something that moves, before noise.
    noise.fill(image, cv::RNG::NORMAL, 90.0, 4.0);
    const cv::Rect spot(input.byte() % image.cols, input.byte() % image.rows, 9, 7);
    image(spot & cv::Rect({}, image.size())).setTo(cv::Scalar::all(230));
  }
}

cv::Mat frame(Input& input, const cv::Size& usual) {
  const std::uint8_t kind = input.byte();
  cv::Size size = usual;
  if (kind >= 240) size = {1 + input.byte() % 200, 1 + input.byte() % 200};
  if (kind == 255) return {};
  static constexpr std::array kTypes{CV_8UC3, CV_16UC1, CV_32FC1, CV_8UC4, CV_8SC1, CV_64FC1};
  const int type = kind >= 230 && kind < 236 ? kTypes[kind - 230U] : CV_8UC1;
  cv::Mat image(size, type);
  fill(image, input);
  // A part of a larger picture: its rows do not follow one another in memory.
  if (kind == 238) return cv::Mat(image, cv::Rect(0, 0, 1 + size.width / 2, size.height));
  return image;
}

double next_time(Input& input, double time_s) {
  const std::uint8_t kind = input.byte();
  if (kind < 200) return time_s + 1.0 / 30.0;
  return time_s + number(input, 1.0);
}

std::optional<Eigen::Matrix3d> homography(Input& input) {
  const std::uint8_t kind = input.byte();
  if (kind < 128) return std::nullopt;
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  matrix(0, 2) = number(input, 40.0);
  matrix(1, 2) = number(input, 40.0);
  if (kind < 200) return matrix;
  for (double& element : matrix.reshaped()) element = number(input, 2.0);
  return matrix;
}

void check(const ols::tracker::TrackerOutput& output) {
  require(output.pixel.allFinite(), "the pixel is finite");
  require(output.covariance_px2.allFinite(), "the covariance is finite");
  const auto& c = output.covariance_px2;
  require(c(0, 0) > 0.0 && c(1, 1) > 0.0 && c.determinant() > 0.0, "the covariance is positive");
  require(std::abs(c(0, 1) - c(1, 0)) <= 1e-9 * (c(0, 0) + c(1, 1)), "it is symmetric");
  require(output.belief >= 0.0 && output.belief <= 1.0, "the belief is within 0..1");
  require(std::isfinite(output.box.x) && std::isfinite(output.box.y), "the box is finite");
  require(output.box.width > 0.0 && output.box.width < 1e6 && output.box.height > 0.0 &&
              output.box.height < 1e6,
          "the box has a size");
}

bool equal(const ols::tracker::TrackerOutput& a, const ols::tracker::TrackerOutput& b) {
  return a.pixel == b.pixel && a.box == b.box && a.belief == b.belief &&
         a.covariance_px2 == b.covariance_px2;
}

ols::tracker::TrackerConfig config(std::uint8_t kind) {
  ols::tracker::TrackerConfig config;
  config.mode =
      kind % 2 == 0 ? ols::tracker::TrackerMode::kFull : ols::tracker::TrackerMode::kPaper;
  config.particles = 40;                                   // as good here, and fast
  if (kind / 2 % 2 == 1) config.ego_motion_width_px = 80;  // smaller than most pictures here
  return config;
}

class Twins {
 public:
  Twins(std::uint8_t kind, const cv::Size& usual)
      : usual_(usual),
        large_(kind / 4 % 2 == 1),
        tracker_(config(kind), 1),
        spared_(config(kind), 1) {}

  void step(Input& input) {
    const std::uint8_t action = input.byte();
    if (action >= 250) return hint(input);
    const double time_s = next_time(input, time_s_);
    const ols::tracker::TrackerInput given{frame(input, usual_), time_s, homography(input)};
    const cv::Mat before = given.gray.clone();
    const bool taken = action < 40 ? begin(given, input) : track(given);
    require(before.empty() || cv::norm(before, given.gray, cv::NORM_INF) == 0.0 ||
                before.depth() >= CV_32F,
            "the frame is not modified");
    if (taken) time_s_ = time_s;
  }

 private:
  bool begin(const ols::tracker::TrackerInput& given, Input& input) {
    const double cols = given.gray.cols, rows = given.gray.rows;
    const double wide = large_ ? cols / 16.0 : 1.0, high = large_ ? rows / 16.0 : 1.0;
    const double x = 0.5 * cols + number(input, cols), y = 0.5 * rows + number(input, rows);
    const double width = wide * (8.0 + number(input, 16.0));
    const cv::Rect2d box(x, y, width, high * (8.0 + number(input, 16.0)));
    if (tracker_.initialise(given, box)) return false;
    require(!spared_.initialise(given, box), "what one takes the other takes");
    return true;
  }

  bool track(const ols::tracker::TrackerInput& given) {
    const ols::tracker::TrackerResult result = tracker_.track(given);
    require(result.output.has_value() != result.error.has_value(), "an output or an error");
    if (result.error) return false;
    check(*result.output);
    const ols::tracker::TrackerResult other = spared_.track(given);
    require(other.output && equal(*result.output, *other.output),
            "a refused frame leaves the tracker as it was");
    return true;
  }

  void hint(Input& input) {
    const Eigen::Vector2d pixel(number(input, 200.0), number(input, 200.0));
    const double sd_px = number(input, 40.0);
    tracker_.search_near(pixel, sd_px);
    spared_.search_near(pixel, sd_px);
  }

  cv::Size usual_;
  bool large_;  // boxes up to the whole picture
  ols::tracker::Tracker tracker_, spared_;
  double time_s_ = 0.0;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr int kMostSteps = 12;
  static const bool one_thread = (cv::setNumThreads(1), true);
  static_cast<void>(one_thread);
  Input input(data, size);
  const std::uint8_t kind = input.byte();
  const cv::Size usual(1 + input.byte() % 128, 1 + input.byte() % 128);
  Twins twins(kind, usual);
  for (int i = 0; i < kMostSteps && !input.empty(); ++i) twins.step(input);
  return 0;
}
