#include "edge/tracker/mover_detection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "edge/tracker/alignment.h"
#include "edge/tracker/patch.h"

namespace ols::tracker {
namespace {

// The grey levels by which a pixel is brighter, or darker, than all of the earlier image within a
// pixel.
struct Difference {
  cv::Mat brighter, darker, either;

  Difference(const cv::Mat& now, const cv::Mat& before) {
    const cv::Mat element = cv::getStructuringElement(cv::MORPH_RECT, {3, 3});
    cv::Mat low, high;
    cv::erode(before, low, element);
    cv::dilate(before, high, element);
    cv::subtract(now, high, brighter);  // saturates at zero
    cv::subtract(low, now, darker);
    either = cv::max(brighter, darker);
  }
};

// The root mean square of the lower nine tenths: the image's usual difference.
double fluctuation(const cv::Mat& difference) {
  std::array<int, 256> histogram{};
  for (int row = 0; row < difference.rows; ++row) {
    const auto* line = difference.ptr<std::uint8_t>(row);
    for (int i = 0; i < difference.cols; ++i) ++histogram[line[i]];
  }
  const double wanted = 0.9 * static_cast<double>(difference.total());
  double count = 0.0, squares = 0.0;
  for (std::size_t value = 0; value < histogram.size() && count < wanted; ++value) {
    count += histogram[value];
    squares += histogram[value] * static_cast<double>(value * value);
  }
  return std::max(0.7, std::sqrt(squares / std::max(1.0, count)));
}

// Of grey levels over places.
struct Moments {
  double sum = 0.0;
  Eigen::Vector2d first = Eigen::Vector2d::Zero();
  Eigen::Matrix2d second = Eigen::Matrix2d::Zero();

  void add(double value, const Eigen::Vector2d& at) {
    sum += value;
    first += value * at;
    second += value * at * at.transpose();
  }
  Eigen::Vector2d centroid() const { return first / sum; }
  Eigen::Matrix2d extent() const { return second / sum - centroid() * centroid().transpose(); }
};

struct Part {
  MoverCandidate candidate;
  bool brighter = false;  // than the earlier image
};

// The places where a bright target arrived and which it left differ in sign. Until it has left its
// former place both are crescents, and the target is between them.
void widen_crescents(std::vector<Part>& parts) {
  for (Part& part : parts) {
    const cv::Rect2d& box = part.candidate.box;
    // Of a slow mover only slivers differ.
    const cv::Rect2d near = box_of(centre_of(box), 3.0 * size_of(box) + Eigen::Vector2d(8.0, 8.0));
    std::optional<Eigen::Vector2d> apart;
    for (const Part& other : parts) {
      if (other.brighter == part.brighter || (near & other.candidate.box).area() <= 0.0) continue;
      const Eigen::Vector2d off = other.candidate.pixel - part.candidate.pixel;
      if (!apart || off.norm() < apart->norm()) apart = off;
    }
    if (apart) part.candidate.covariance_px2 += 0.25 * *apart * apart->transpose();
  }
}

// Of each connected part of a mask, by its label; nothing of label 0, the background. OpenCV's
// statistics would take eight times as long: nearly all of the mask is background.
std::vector<cv::Rect> bounds_of(const cv::Mat& mask, const cv::Mat& labels, int count) {
  std::vector<cv::Rect> bounds(static_cast<std::size_t>(count));
  std::vector<cv::Point> points;
  cv::findNonZero(mask, points);
  for (const cv::Point& point : points) {
    bounds[static_cast<std::size_t>(labels.at<int>(point))] |= cv::Rect(point, cv::Size(1, 1));
  }
  return bounds;
}

// One connected part, by the moments of its difference.
Part part_of(const Difference& difference, const cv::Mat& labels, int label, const cv::Rect& bounds,
             double sd) {
  Moments moments;
  double greatest = 0.0, brighter = 0.0;
  for (int y = bounds.y; y < bounds.br().y; ++y) {
    for (int x = bounds.x; x < bounds.br().x; ++x) {
      if (labels.at<int>(y, x) != label) continue;
      const double value = difference.either.at<std::uint8_t>(y, x);
      moments.add(value, {x, y});
      brighter += difference.brighter.at<std::uint8_t>(y, x);
      greatest = std::max(greatest, value);
    }
  }
  Part made;
  made.brighter = brighter > 0.5 * moments.sum;
  made.candidate.pixel = moments.centroid();
  made.candidate.strength = greatest / sd;
  // A centroid's variance: extent divided by signal strength, plus a pixel's own width.
  made.candidate.covariance_px2 = moments.extent() / std::max(1.0, made.candidate.strength) +
                                  Eigen::Matrix2d::Identity() / 12.0;
  made.candidate.box = bounds;
  return made;
}

void to_full_frame(MoverCandidate& candidate, const cv::Rect& area, const ReducedFrame& frame) {
  const double scale = frame.reduction;
  const Eigen::Vector2d in_frame = candidate.pixel + Eigen::Vector2d(area.x, area.y);
  candidate.pixel = transform(frame.to_full(), in_frame);
  candidate.covariance_px2 *= scale * scale;
  candidate.box = {(candidate.box.x + area.x) * scale, (candidate.box.y + area.y) * scale,
                   candidate.box.width * scale, candidate.box.height * scale};
}

std::vector<MoverCandidate> strongest(std::vector<Part> parts, std::size_t most) {
  std::stable_sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) {
    return a.candidate.strength > b.candidate.strength;
  });
  // The other crescent is about as strong, and close by.
  parts.resize(std::min(parts.size(), 2 * most));
  widen_crescents(parts);
  parts.resize(std::min(parts.size(), most));
  std::vector<MoverCandidate> candidates;
  for (Part& part : parts) candidates.push_back(part.candidate);
  return candidates;
}

}  // namespace

std::vector<MoverCandidate> detect_movers(const cv::Mat& earlier, const Eigen::Matrix3d& to_present,
                                          const ReducedFrame& current, const MoverSearch& search) {
  const bool usable =
      !earlier.empty() && earlier.type() == CV_8UC1 && !current.image.empty() && aligns(to_present);
  if (!usable) return {};
  const cv::Rect area = reduced_area(current, search.area);
  if (area.width < 3 || area.height < 3) return {};
  const cv::Mat now = current.image(area);
  const Eigen::Matrix3d to_reduced = current.to_full().inverse() * to_present;
  const Difference difference(now, brought_to_present(earlier, to_reduced, now, area.tl()));
  // The tolerance removes most of the noise from the difference: only its rare peaks remain.
  const double sd = std::max(fluctuation(difference.either), pixel_noise(now));
  cv::Mat mask, labels;
  cv::threshold(difference.either, mask, std::max(search.least_levels, search.threshold_sd * sd),
                255.0, cv::THRESH_BINARY);
  const int count = cv::connectedComponents(mask, labels);
  const std::vector<cv::Rect> bounds = bounds_of(mask, labels, count);
  std::vector<Part> found;
  for (int part = 1; part < count; ++part) {
    const cv::Rect& its = bounds[static_cast<std::size_t>(part)];
    if (std::max(its.width, its.height) * current.reduction > search.most_side_px) continue;
    found.push_back(part_of(difference, labels, part, its, sd));
    to_full_frame(found.back().candidate, area, current);
  }
  return strongest(std::move(found), static_cast<std::size_t>(search.most));
}

}  // namespace ols::tracker
