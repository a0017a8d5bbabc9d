#include "edge/skyline/picture_heading.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <opencv2/imgproc.hpp>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

#include "geometry/angles.h"

namespace ols::skyline {
namespace {

constexpr int kLongest_px = 1280;  // a picture is reduced to this

struct Photograph {
  cv::Mat colours;
  CameraIntrinsics camera;
};

bool is_plain(const cv::Mat& line) {
  constexpr double kNoise = 4.0;  // [gray]
  cv::Mat gray;
  cv::cvtColor(line, gray, cv::COLOR_BGR2GRAY);
  double least = 0.0, most = 0.0;
  cv::minMaxLoc(gray, &least, &most);
  return most - least <= kNoise;
}

// Without frame and bars of one colour.
Photograph trimmed(Photograph photograph) {
  constexpr double kMost = 0.2;  // of each side
  const cv::Mat& all = photograph.colours;
  int top = 0, bottom = all.rows, left = 0, right = all.cols;
  const int rows = static_cast<int>(kMost * all.rows), columns = static_cast<int>(kMost * all.cols);
  while (top < rows && is_plain(all.row(top))) ++top;
  while (bottom > all.rows - rows && is_plain(all.row(bottom - 1))) --bottom;
  while (left < columns && is_plain(all.col(left))) ++left;
  while (right > all.cols - columns && is_plain(all.col(right - 1))) --right;
  photograph.colours = all(cv::Rect(left, top, right - left, bottom - top)).clone();
  photograph.camera.cx_px -= left;
  photograph.camera.cy_px -= top;
  photograph.camera.width_px = right - left;
  photograph.camera.height_px = bottom - top;
  return photograph;
}

Photograph reduced(const cv::Mat& picture, CameraIntrinsics camera) {
  const double scale =
      std::min(1.0, static_cast<double>(kLongest_px) / std::max(picture.cols, picture.rows));
  Photograph photograph{picture, camera};
  if (scale < 1.0) cv::resize(picture, photograph.colours, {}, scale, scale, cv::INTER_AREA);
  camera.fx_px *= scale;
  camera.fy_px *= scale;
  camera.skew *= scale;
  camera.cx_px = (camera.cx_px + 0.5) * scale - 0.5;
  camera.cy_px = (camera.cy_px + 0.5) * scale - 0.5;
  camera.width_px = photograph.colours.cols;
  camera.height_px = photograph.colours.rows;
  photograph.camera = camera;
  return photograph;
}

struct Candidate {
  PoseCandidate found;
  const land::HorizonMap* map = nullptr;  // with which it was found
};

// A heading that may be right.
struct Fitted {
  PicturePose pose;
  std::optional<PictureFit> fit;  // to the land; its pose is this one
  double score = 0.0;
  bool within = false;  // the prior of the heading

  double apart_rad(const Fitted& other) const {
    return std::abs(wrap_pi(pose.heading_rad - other.pose.heading_rad));
  }
};

// The best candidates, each at least `apart_rad` from a better one.
std::vector<Candidate> peaks(std::vector<Candidate> candidates, double apart_rad,
                             std::size_t most) {
  std::ranges::sort(candidates, std::greater<>(), [](const auto& one) { return one.found.score; });
  std::vector<Candidate> peaks;
  for (const Candidate& one : candidates) {
    const bool is_new = std::ranges::none_of(peaks, [&](const Candidate& peak) {
      return std::abs(wrap_pi(peak.found.pose.heading_rad - one.found.pose.heading_rad)) <
             apart_rad;
    });
    if (is_new) peaks.push_back(one);
    if (peaks.size() == most) break;
  }
  return peaks;
}

double log_prior(const PicturePrior& prior, const PicturePose& pose) {
  return -0.5 * std::pow((pose.tilt_rad - prior.tilt_rad) / prior.tilt_sd_rad, 2) -
         0.5 * std::pow((pose.roll_rad - prior.roll_rad) / prior.roll_sd_rad, 2);
}

class Judge {
 public:
  Judge(Photograph photograph, std::span<const land::HorizonMap> maps, const PicturePrior& prior)
      : photograph_(std::move(photograph)),
        maps_(maps),
        prior_(prior),
        evidence_(photograph_.colours, cell_px_for(photograph_.camera)) {
    if (evidence_.columns() == 0 || evidence_.rows() == 0) {
      throw std::invalid_argument(
          "the picture shows less than 0.15 degrees: is the focal length right?");
    }
    cv::cvtColor(photograph_.colours, gray_, cv::COLOR_BGR2GRAY);
  }

  PictureHeading judge() {
    constexpr double kApart_rad = radians(2.0);
    constexpr std::size_t kWithin = 4, kElsewhere = 3;
    // Headings that cannot be right show how well the land fits by chance.
    std::vector<Candidate> within, elsewhere;
    for (const land::HorizonMap& map : maps_) {
      for (const PoseCandidate& one : search_poses(evidence_, photograph_.camera, map, prior_)) {
        (is_within(prior_, one.pose.heading_rad) ? within : elsewhere).push_back({one, &map});
      }
    }
    std::vector<Fitted> fitted;
    for (const auto& one : peaks(std::move(within), kApart_rad, kWithin)) {
      fitted.push_back(fit(one, prior_));
    }
    PicturePrior unknown = prior_;
    unknown.heading_rad.reset();
    for (const auto& one : peaks(std::move(elsewhere), kApart_rad, kElsewhere)) {
      fitted.push_back(fit(one, unknown));
    }
    return result_of(fitted);
  }

 private:
  Fitted fit(const Candidate& candidate, const PicturePrior& prior) const {
    const PicturePose& start = candidate.found.pose;
    const auto score = [&](const PicturePose& pose, const CameraIntrinsics& camera) {
      return evidence_for(pose, evidence_, camera, *candidate.map) + log_prior(prior_, pose);
    };
    Fitted fitted{start, {}, score(start, photograph_.camera)};
    fitted.fit = fit_picture(gray_, photograph_.camera, *candidate.map, prior, start);
    if (fitted.fit) {
      fitted.pose = fitted.fit->pose;
      fitted.score = score(fitted.pose, fitted.fit->camera);
    }
    fitted.within = is_within(prior_, fitted.pose.heading_rad);
    return fitted;
  }
  PictureHeading result_of(const std::vector<Fitted>& fitted) const {
    constexpr double kSame_rad = radians(1.5);
    const Fitted* best = nullptr;
    for (const Fitted& one : fitted) {
      if (one.fit && one.within && (!best || one.score > best->score)) best = &one;
    }
    if (!best) return {.doubt = "the picture shows no skyline like the land's"};
    const Fitted* other = nullptr;
    const double same_rad = std::max(kSame_rad, 4.0 * best->fit->sd.heading_rad);
    for (const Fitted& one : fitted) {
      if (one.apart_rad(*best) > same_rad && (!other || one.score > other->score)) other = &one;
    }
    PictureHeading result{.fit = best->fit, .lead = best->score - (other ? other->score : 0.0)};
    result.doubt = doubt_of(*best->fit, result.lead, other);
    return result;
  }
  static std::string doubt_of(const PictureFit& fit, double lead, const Fitted* other) {
    constexpr double kAgreeing = 0.75, kLead = 25.0, kMost_rad = radians(0.5);
    std::ostringstream text;
    text << std::fixed << std::setprecision(2);
    if (fit.agreeing < kAgreeing * fit.expected) {
      text << "only " << fit.agreeing << " of " << fit.expected
           << " columns agree with the land's skyline";
    } else if (fit.sd.heading_rad > kMost_rad) {
      text << "the skyline is too flat, too near or too short: its 1-sigma would be "
           << degrees(fit.sd.heading_rad) << " deg";
    } else if (lead < kLead) {
      text << "it fits nearly as well elsewhere";
      if (other)
        text << ", for example at " << degrees(wrap_two_pi(other->pose.heading_rad)) << " deg";
    }
    return text.str();
  }

  Photograph photograph_;
  std::span<const land::HorizonMap> maps_;
  const PicturePrior& prior_;
  PictureEvidence evidence_;
  cv::Mat gray_;
};

}  // namespace

std::vector<double> visibilities_m(double reach_m) {
  constexpr double kStep = 3.0, kLeast_m = 5000.0;
  std::vector<double> all{reach_m};
  while (all.back() / kStep > kLeast_m) all.push_back(all.back() / kStep);
  return all;
}

PictureHeading picture_heading(const cv::Mat& picture, const CameraIntrinsics& camera,
                               std::span<const land::HorizonMap> maps, const PicturePrior& prior) {
  return Judge(trimmed(reduced(picture, camera)), maps, prior).judge();
}

}  // namespace ols::skyline
