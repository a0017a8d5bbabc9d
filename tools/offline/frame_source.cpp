#include "tools/offline/frame_source.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace ols {
namespace {

namespace fs = std::filesystem;

bool is_picture(const fs::path& path) {
  std::string kind = path.extension().string();
  std::transform(kind.begin(), kind.end(), kind.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  static const std::vector<std::string> kinds{".png", ".jpg", ".jpeg", ".bmp",
                                              ".pgm", ".ppm", ".tif",  ".tiff"};
  return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
}

std::vector<std::string> pictures_of_folder(const fs::path& folder) {
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file() && is_picture(entry.path())) files.push_back(entry.path().string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

// A name with one %d, %6d or %06d in it.
struct Pattern {
  std::string before;
  std::size_t digits = 0;
  std::string after;
};

std::optional<Pattern> parse_pattern(const std::string& text) {
  const std::size_t percent = text.find('%');
  if (percent == std::string::npos) return std::nullopt;
  std::size_t end = percent + 1;
  std::size_t digits = 0;
  for (; end < text.size() && text[end] >= '0' && text[end] <= '9' && digits < 100; ++end) {
    digits = 10 * digits + static_cast<std::size_t>(text[end] - '0');
  }
  if (end == text.size() || text[end] != 'd') return std::nullopt;
  return Pattern{text.substr(0, percent), digits, text.substr(end + 1)};
}

// The files of `frames/%06d.png`, from the first number that there is, without a gap.
std::vector<std::string> pictures_of_pattern(const Pattern& pattern) {
  constexpr int kLatestFirst = 100000;
  const auto name = [&](int number) {
    std::string text = std::to_string(number);
    if (text.size() < pattern.digits) text.insert(0, pattern.digits - text.size(), '0');
    return pattern.before + text + pattern.after;
  };
  int number = 0;
  while (number < kLatestFirst && !fs::exists(name(number))) ++number;
  std::vector<std::string> files;
  for (; fs::exists(name(number)); ++number) files.push_back(name(number));
  return files;
}

cv::Mat to_gray(const cv::Mat& picture) {
  if (picture.channels() == 1) return picture;
  cv::Mat gray;
  cv::cvtColor(picture, gray, picture.channels() == 4 ? cv::COLOR_BGRA2GRAY : cv::COLOR_BGR2GRAY);
  return gray;
}

}  // namespace

FrameSource::FrameSource(const std::string& input) : input_(input) {
  const std::optional<Pattern> pattern = parse_pattern(input);
  if (fs::is_directory(input)) {
    files_ = pictures_of_folder(input);
    if (files_.empty()) throw FrameSourceError(input + ": no pictures in this folder");
  } else if (!fs::exists(input) && pattern) {
    files_ = pictures_of_pattern(*pattern);
    if (files_.empty()) throw FrameSourceError(input + ": no picture matches this pattern");
  } else if (!fs::exists(input)) {
    throw FrameSourceError(input + ": no such file or folder");
  } else {
    if (!clip_.open(input)) throw FrameSourceError(input + ": cannot be read as a clip");
    const double rate = clip_.get(cv::CAP_PROP_FPS);
    if (std::isfinite(rate) && rate > 0.1 && rate < 10000.0) frames_per_second_ = rate;
    const double count = clip_.get(cv::CAP_PROP_FRAME_COUNT);
    if (std::isfinite(count) && count > 0.0) announced_ = std::lround(count);
  }
}

std::optional<cv::Mat> FrameSource::next() {
  std::optional<cv::Mat> picture = files_.empty() ? next_of_clip() : next_file();
  if (picture) ++read_;
  return picture;
}

std::optional<cv::Mat> FrameSource::next_of_clip() {
  cv::Mat picture;
  if (clip_.read(picture) && !picture.empty()) return to_gray(picture);
  // Containers count a frame or two that no decoder gives: only more is a damaged clip.
  constexpr long kTolerated = 2;
  if (read_ == 0 || read_ + kTolerated < announced_) {
    throw FrameSourceError(input_ + ": ends or is damaged after " + std::to_string(read_) + " of " +
                           std::to_string(announced_) + " frames");
  }
  return std::nullopt;
}

std::optional<cv::Mat> FrameSource::next_file() {
  const auto index = static_cast<std::size_t>(read_);
  if (index >= files_.size()) return std::nullopt;
  const cv::Mat picture = cv::imread(files_[index], cv::IMREAD_GRAYSCALE);
  if (picture.empty()) throw FrameSourceError(files_[index] + ": cannot be read as a picture");
  return picture;
}

}  // namespace ols
