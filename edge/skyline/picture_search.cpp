#include "edge/skyline/picture_search.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "edge/skyline/expected_skyline.h"
#include "geometry/angles.h"
#include "geometry/direction.h"

namespace ols::skyline {
namespace {

constexpr double kSigmas = 3.0;                 // of the prior that are searched
constexpr double kTiltStep_rad = radians(4.0);  // between, the skyline is shifted as it is
constexpr double kNone = -std::numeric_limits<double>::infinity();

// The skyline at equal steps of azimuth.
struct Crest {
  double tangent = 0.0;  // of the elevation; NaN where it is unknown
  int level = 0;         // of the evidence
};

std::vector<Crest> skyline_of(const land::HorizonMap& map, int headings, double cell_rad) {
  std::vector<Crest> crests;
  const int each = std::max(1, map.config().columns / headings);
  for (int i = 0; i < headings; ++i) {
    double sum = 0.0, sd_rad = 0.0;
    for (int k = 0; k < each; ++k) {
      const auto skyline =
          uncertain_skyline(map, 2.0 * kPi * (i + (k + 0.5) / each - 0.5) / headings);
      sum += skyline ? std::tan(skyline->elevation_rad) : std::nan("");
      sd_rad += skyline ? skyline->elevation_sd_rad / each : 0.0;
    }
    crests.push_back({sum / each, PictureEvidence::level_for(sd_rad / cell_rad)});
  }
  return crests;
}

std::vector<double> around(double middle, double reach, double step) {
  std::vector<double> values;
  const int each = static_cast<int>(std::ceil(reach / step));
  for (int i = -each; i <= each; ++i) values.push_back(middle + i * step);
  return values;
}

double log_prior(double off, double sd) { return sd > 0.0 ? -0.5 * (off / sd) * (off / sd) : 0.0; }

class Search {
 public:
  Search(const PictureEvidence& evidence, const CameraIntrinsics& camera,
         const land::HorizonMap& map, const PicturePrior& prior)
      : evidence_(evidence),
        camera_(camera),
        prior_(prior),
        cell_rad_(evidence.cell_px() / camera.fx_px),
        headings_(static_cast<int>(std::ceil(2.0 * kPi / cell_rad_))),
        step_rad_(2.0 * kPi / headings_),
        shifts_(std::min(static_cast<int>(std::ceil(0.5 * kTiltStep_rad / cell_rad_)),
                         evidence.margin())),
        crests_(skyline_of(map, headings_, cell_rad_)),
        best_(static_cast<std::size_t>(headings_), {{}, kNone}) {}

  std::vector<PoseCandidate> run() {
    const double roll_step_rad = 2.0 / std::max(evidence_.columns(), evidence_.rows());
    for (const double tilt_rad :
         around(prior_.tilt_rad, kSigmas * prior_.tilt_sd_rad, kTiltStep_rad)) {
      for (const double roll_rad :
           around(prior_.roll_rad, kSigmas * prior_.roll_sd_rad, roll_step_rad)) {
        const double log_p = log_prior(tilt_rad - prior_.tilt_rad, prior_.tilt_sd_rad) +
                             log_prior(roll_rad - prior_.roll_rad, prior_.roll_sd_rad);
        if (log_p > -0.5 * kSigmas * kSigmas - 0.5) look(tilt_rad, roll_rad);
      }
    }
    return best_;
  }

 private:
  void look(double tilt_rad, double roll_rad) {
    const Eigen::Matrix3d R_cam_enu = R_enu_cam({0.0, tilt_rad, roll_rad}).transpose();
    const double wide_rad = 0.5 * field_of_view(camera_).norm() / std::max(0.5, std::cos(tilt_rad));
    const int each = std::min(static_cast<int>(wide_rad / step_rad_), headings_ / 2 - 1);
    level_.clear();
    for (int j = -each; j <= each; ++j) {
      level_.push_back(R_cam_enu *
                       Eigen::Vector3d(std::sin(j * step_rad_), std::cos(j * step_rad_), 0.0));
    }
    up_ = R_cam_enu.col(2);
    for (int heading = 0; heading < headings_; ++heading) {
      // Those that cannot be right need not be exact.
      constexpr int kCoarse = 3;
      const bool is_searched = heading % kCoarse == 0 || is_within(prior_, heading * step_rad_);
      if (is_searched) score(heading, each, tilt_rad, roll_rad);
    }
  }
  void score(int heading, int each, double tilt_rad, double roll_rad) {
    sums_.assign(static_cast<std::size_t>(2 * shifts_ + 1), 0.0F);
    const int lowest = evidence_.rows() + evidence_.margin() - 1 - shifts_;
    for (int j = 0; j < 2 * each + 1; ++j) {
      const Crest& crest =
          crests_[static_cast<std::size_t>((heading + j - each + headings_) % headings_)];
      if (std::isnan(crest.tangent)) continue;
      const Eigen::Vector3d ray = level_[static_cast<std::size_t>(j)] + crest.tangent * up_;
      const auto pixel = project(camera_, ray);
      if (!pixel) continue;
      const double column = (pixel->x() + 0.5) / evidence_.cell_px();
      if (!(column >= 0.0 && column < evidence_.columns())) continue;
      const double at = std::floor((pixel->y() + 0.5) / evidence_.cell_px());
      const int row =
          static_cast<int>(std::clamp<double>(at, shifts_ - evidence_.margin(), lowest));
      const float* cells = evidence_.cells(crest.level, static_cast<int>(column)) + row - shifts_;
      for (std::size_t shift = 0; shift < sums_.size(); ++shift) sums_[shift] += cells[shift];
    }
    for (int shift = -shifts_; shift <= shifts_; ++shift) {
      const double up_rad = tilt_rad + shift * cell_rad_;  // looking up lowers the land
      const double total = sums_[static_cast<std::size_t>(shift + shifts_)] +
                           log_prior(up_rad - prior_.tilt_rad, prior_.tilt_sd_rad) +
                           log_prior(roll_rad - prior_.roll_rad, prior_.roll_sd_rad);
      PoseCandidate& best = best_[static_cast<std::size_t>(heading)];
      if (total > best.score) best = {{heading * step_rad_, up_rad, roll_rad}, total};
    }
  }

  const PictureEvidence& evidence_;
  const CameraIntrinsics& camera_;
  const PicturePrior& prior_;
  double cell_rad_;
  int headings_;
  double step_rad_;
  int shifts_;  // of the picture's rows, each way
  std::vector<Crest> crests_;
  std::vector<Eigen::Vector3d> level_;
  Eigen::Vector3d up_;
  std::vector<float> sums_;
  std::vector<PoseCandidate> best_;
};

}  // namespace

Eigen::Matrix3d R_enu_cam(const PicturePose& pose) {
  const Eigen::Vector3d forward = enu_from_azimuth_elevation({pose.heading_rad, pose.tilt_rad});
  const Eigen::Vector3d level(std::cos(pose.heading_rad), -std::sin(pose.heading_rad), 0.0);
  const Eigen::Vector3d down = forward.cross(level);
  const double s = std::sin(pose.roll_rad), c = std::cos(pose.roll_rad);
  Eigen::Matrix3d R;
  R << c * level + s * down, c * down - s * level, forward;
  return R;
}

bool is_within(const PicturePrior& prior, double heading_rad) {
  return !prior.heading_rad ||
         std::abs(wrap_pi(heading_rad - *prior.heading_rad)) < kSigmas * prior.heading_sd_rad;
}

int cell_px_for(const CameraIntrinsics& camera) {
  constexpr int kAcross = 160;  // cells
  constexpr double kLeast_rad = radians(0.15);
  return std::max(
      {kStrip_px *
           ((std::max(camera.width_px, camera.height_px) / kAcross + kStrip_px - 1) / kStrip_px),
       static_cast<int>(kLeast_rad * camera.fx_px), kStrip_px});
}

std::vector<PoseCandidate> search_poses(const PictureEvidence& evidence,
                                        const CameraIntrinsics& camera, const land::HorizonMap& map,
                                        const PicturePrior& prior) {
  return Search(evidence, camera, map, prior).run();
}

double evidence_for(const PicturePose& pose, const PictureEvidence& evidence,
                    const CameraIntrinsics& camera, const land::HorizonMap& map) {
  // expected_rows() adds the sigmas of a station's heading and tilt, which are none of the land's.
  const PictureView view{R_enu_cam(pose), camera};
  const auto rows = expected_rows(map, view);
  const int cell_px = evidence.cell_px();
  double sum = 0.0;
  for (int column = 0; column < evidence.columns(); ++column) {
    const double x_px = column * cell_px + 0.5 * (cell_px - 1);
    const auto& row = rows[static_cast<std::size_t>(x_px / kStrip_px)];
    if (!row) continue;
    const auto ray = unproject(camera, {x_px, row->at_px});
    const auto skyline =
        ray ? uncertain_skyline(map, azimuth_elevation_from_enu(view.R_enu_cam * *ray).azimuth_rad)
            : std::nullopt;
    if (!skyline) continue;
    const double at = std::clamp<double>(std::floor((row->at_px + 0.5) / cell_px),
                                         -evidence.margin(), evidence.rows());
    const int level =
        PictureEvidence::level_for(skyline->elevation_sd_rad * camera.fx_px / cell_px);
    sum += evidence.cells(level, column)[static_cast<int>(at)];
  }
  return sum;
}

}  // namespace ols::skyline
