#include "tools/calibrate/light_recording.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "base/files/csv_rows.h"
#include "geometry/angles.h"

namespace ols::calibration {
namespace {

enum Column : std::size_t { kUtime, kFile, kStampSource, kColumns };
constexpr csv::Header<kColumns> kHeader{{"utime_us", "file", "stamp_source"}, kColumns};

struct Picture {
  std::string path;
  double time_s = 0.0;
  bool by_arrival = false;

  cv::Mat1b read(const cv::Size& size) const {
    cv::Mat1b gray = cv::imread(path, cv::IMREAD_GRAYSCALE);
    if (gray.empty()) throw std::runtime_error(path + ": cannot be read");
    if (!size.empty() && gray.size() != size) {
      throw std::runtime_error(path + ": has another size than the pictures before");
    }
    return gray;
  }
};

std::vector<Picture> pictures_in(const std::string& folder) {
  std::vector<Picture> pictures;
  csv::for_each_row(folder + "/frames.csv", kHeader, [&](const csv::Row<kColumns>& row) {
    const std::string file = row.text(kFile), source = row.text(kStampSource);
    if (file.find('/') != std::string::npos) row.fail(kFile, "is no name of a file");
    if (source != "arrival" && source != "camera") {
      row.fail(kStampSource, "is neither arrival nor camera");
    }
    const auto utime_us = row.number<std::int64_t>(kUtime, 1, 4'000'000'000'000'000);
    pictures.push_back(
        {folder + "/" + file, 1e-6 * static_cast<double>(utime_us), source == "arrival"});
  });
  if (pictures.empty()) throw std::runtime_error(folder + "/frames.csv: has no pictures");
  const auto other = [&](const Picture& one) {
    return one.by_arrival != pictures.front().by_arrival;
  };
  if (std::ranges::any_of(pictures, other)) {
    throw std::runtime_error(folder +
                             "/frames.csv: some times are by arrivals, the others are not: these "
                             "have another delay; use a recording with one kind");
  }
  return pictures;
}

// The pixel whose brightness has most of its variance at the light's frequency.
cv::Point blinking_pixel(const std::vector<Picture>& pictures, double period_s) {
  constexpr double kQuantised = 4.0;  // [levels^2] a pixel that hardly changes does not blink
  std::vector<std::complex<double>> turns;
  std::complex<double> mean = 0.0;
  for (const Picture& picture : pictures) {
    turns.push_back(
        std::polar(1.0, -2.0 * kPi * std::remainder(picture.time_s, period_s) / period_s));
    mean += turns.back() / static_cast<double>(pictures.size());
  }
  cv::Mat1f cosine, sine, sum, squares, gray;
  cv::Size size;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const cv::Mat1b picture = pictures[i].read(size);
    if (size.empty()) {
      size = picture.size();
      for (cv::Mat1f* one : {&cosine, &sine, &sum, &squares}) *one = cv::Mat1f::zeros(size);
    }
    picture.convertTo(gray, CV_32F);
    cv::scaleAdd(gray, (turns[i] - mean).real(), cosine, cosine);
    cv::scaleAdd(gray, (turns[i] - mean).imag(), sine, sine);
    sum += gray;
    cv::accumulateSquare(gray, squares);
  }
  const double count = static_cast<double>(pictures.size());
  const cv::Mat1f variance = squares / count - sum.mul(sum) / (count * count) + kQuantised;
  cv::Mat1f blinks = (cosine.mul(cosine) + sine.mul(sine)) / variance;
  cv::blur(blinks, blinks, {3, 3});
  cv::Point at;
  cv::minMaxLoc(blinks, nullptr, nullptr, nullptr, &at);
  return at;
}

}  // namespace

LightRecording read_light(const std::string& folder, const BlinkingLight& light,
                          double row_readout_s) {
  const std::vector<Picture> pictures = pictures_in(folder);
  const cv::Point at = blinking_pixel(pictures, light.period_s);
  LightRecording recording{
      .samples = {}, .by_arrival = pictures.front().by_arrival, .pixel = {at.x, at.y}};
  for (const Picture& picture : pictures) {
    const cv::Mat1b gray = picture.read({});
    const cv::Rect around = cv::Rect(at.x - 2, at.y - 2, 5, 5) & cv::Rect({}, gray.size());
    recording.samples.push_back(
        {picture.time_s + row_readout_s * at.y / gray.rows, cv::mean(gray(around))[0]});
  }
  return recording;
}

}  // namespace ols::calibration
