#include "tools/offline/frame_source.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <set>
#include <string_view>

namespace ols::offline {
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

std::string_view leading_digits(std::string_view text) {
  return text.substr(0, std::min(text.find_first_not_of("0123456789"), text.size()));
}

// Natural order: 2.png before 10.png; equal numbers compare as text.
bool before_in_order(std::string_view a, std::string_view b) {
  const std::string_view whole_a = a, whole_b = b;
  while (!a.empty() && !b.empty()) {
    std::string_view number_a = leading_digits(a), number_b = leading_digits(b);
    if (number_a.empty() || number_b.empty()) {
      if (a.front() != b.front()) return a.front() < b.front();
      a.remove_prefix(1);
      b.remove_prefix(1);
      continue;
    }
    a.remove_prefix(number_a.size());
    b.remove_prefix(number_b.size());
    number_a.remove_prefix(std::min(number_a.find_first_not_of('0'), number_a.size()));
    number_b.remove_prefix(std::min(number_b.find_first_not_of('0'), number_b.size()));
    if (number_a.size() != number_b.size()) return number_a.size() < number_b.size();
    if (number_a != number_b) return number_a < number_b;
  }
  if (a.empty() != b.empty()) return a.empty();
  return whole_a < whole_b;
}

std::vector<std::string> pictures_of_folder(const fs::path& folder) {
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file() && is_picture(entry.path())) files.push_back(entry.path().string());
  }
  std::sort(files.begin(), files.end(), before_in_order);
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

std::string name_of(const Pattern& pattern, long number) {
  std::string text = std::to_string(number);
  if (text.size() < pattern.digits) text.insert(0, pattern.digits - text.size(), '0');
  return pattern.before + text + pattern.after;
}

std::set<long> numbers_of_pattern(const Pattern& pattern) {
  const fs::path before(pattern.before);
  const fs::path folder = before.has_parent_path() ? before.parent_path() : fs::path(".");
  const std::string prefix = before.filename().string();
  std::set<long> numbers;
  if (!fs::is_directory(folder)) return numbers;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.compare(0, prefix.size(), prefix) != 0) continue;
    const std::string_view digits = leading_digits(std::string_view(name).substr(prefix.size()));
    long number = 0;
    const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (read.ec == std::errc() && fs::exists(name_of(pattern, number))) numbers.insert(number);
  }
  return numbers;
}

// The files of `frames/%06d.png`, from the first number that there is to the last one. A tracker
// that silently skipped a missing image would give every later box the wrong frame: a gap is
// refused.
std::vector<std::string> pictures_of_pattern(const Pattern& pattern) {
  const std::set<long> numbers = numbers_of_pattern(pattern);
  std::vector<std::string> files;
  for (const long number : numbers) {
    const long expected = *numbers.begin() + static_cast<long>(files.size());
    if (number != expected) {
      throw FrameSourceError(name_of(pattern, expected) + ": number " + std::to_string(expected) +
                             " is missing, but there are later ones");
    }
    files.push_back(name_of(pattern, number));
  }
  return files;
}

// OpenCV prints errors of damaged images to std::cerr at any log level; the user gets one line.
class QuietErrors {
 public:
  QuietErrors() : buffer_(std::cerr.rdbuf(nullptr)) {}
  ~QuietErrors() { std::cerr.rdbuf(buffer_); }
  QuietErrors(const QuietErrors&) = delete;
  QuietErrors& operator=(const QuietErrors&) = delete;

 private:
  std::streambuf* buffer_;
};

// Empty if it cannot be read; OpenCV throws if the header announces too large an image.
cv::Mat read_picture(const std::string& file, cv::ImreadModes mode) {
  const QuietErrors quiet;
  try {
    return cv::imread(file, mode);
  } catch (const cv::Exception&) {
    return {};
  }
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
    // FFmpeg only: otherwise OpenCV tries all its readers, including those for cameras.
    if (!clip_.open(input, cv::CAP_FFMPEG))
      throw FrameSourceError(input + ": cannot be read as a clip");
    const double rate = clip_.get(cv::CAP_PROP_FPS);
    if (!std::isfinite(rate) || rate <= 0.1 || rate >= 10000.0) return;
    frames_per_second_ = rate;
    // A container without a count: OpenCV computes it from the rate, nonsense without a valid rate.
    const double count = clip_.get(cv::CAP_PROP_FRAME_COUNT);
    if (std::isfinite(count) && count > 0.0)
      announced_ = static_cast<std::size_t>(std::llround(count));
  }
}

std::optional<cv::Mat> FrameSource::next() {
  std::optional<cv::Mat> picture = files_.empty() ? next_of_clip() : next_file();
  if (picture) ++read_;
  return picture;
}

std::optional<cv::Mat> FrameSource::next_of_clip() {
  cv::Mat picture;
  if (clip_.read(picture) && !picture.empty()) {
    colour_ = picture.channels() == 3 ? picture : cv::Mat();
    return to_gray(picture);
  }
  // Containers may announce a frame or two more than they hold; a larger gap is a damaged clip.
  constexpr std::size_t kTolerated = 2;
  if (read_ == 0 || read_ + kTolerated < announced_) {
    throw FrameSourceError(input_ + ": ends or is damaged after " + std::to_string(read_) + " of " +
                           std::to_string(announced_) + " frames");
  }
  return std::nullopt;
}

std::optional<cv::Mat> FrameSource::next_file() {
  if (read_ >= files_.size()) return std::nullopt;
  const cv::Mat picture = read_picture(files_[read_], cv::IMREAD_GRAYSCALE);
  if (picture.empty()) throw FrameSourceError(files_[read_] + ": cannot be read as a picture");
  // Decoded apart: decoders weight colours to grey in their own way.
  colour_ = read_picture(files_[read_], cv::IMREAD_COLOR);
  return picture;
}

}  // namespace ols::offline
