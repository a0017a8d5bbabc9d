#include "edge/skyline/picture_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

#include "edge/skyline/expected_skyline.h"
#include "edge/skyline/modelled_crest.h"
#include "geometry/angles.h"
#include "land/column_march.h"

namespace ols::skyline {
namespace {

constexpr int kCamera = 5;  // heading, tilt, roll, logarithm of the focal length, k1
constexpr int kBeside = 4;  // and the place (east, north, up) and refraction
constexpr int kUnknowns = kCamera + kBeside;
constexpr std::size_t kMostPoints = 400, kLeastPoints = 30;
using Unknowns = Eigen::Matrix<double, kUnknowns, 1>;
using Beside = Eigen::Matrix<double, kBeside, 1>;

struct View {
  PicturePose pose;
  CameraIntrinsics camera;

  View moved(const Unknowns& by) const {
    View view = *this;
    view.pose.heading_rad += by(0);
    view.pose.tilt_rad += by(1);
    view.pose.roll_rad += by(2);
    view.camera.fx_px *= std::exp(by(3));
    view.camera.fy_px *= std::exp(by(3));
    view.camera.k1 += by(4);
    return view;
  }
  std::optional<AzimuthElevation> direction(const Eigen::Vector2d& pixel) const {
    const auto ray = unproject(camera, pixel);
    if (!ray) return std::nullopt;
    return azimuth_elevation_from_enu(R_enu_cam(pose) * *ray);
  }
};

struct Edge {  // that was found in the picture
  Eigen::Vector2d pixel;
  double sd_px = 0.0;
};

struct Difference {
  double off_rad = 0.0;  // seen minus modelled elevation
  Eigen::Matrix<double, 1, kUnknowns> by;
  Eigen::Vector2d place_m;
  double x_px = 0.0;
  double model_sd_rad = 0.0, picture_sd_rad = 0.0, rough_rad2 = 0.0;

  double variance_rad2() const {
    return model_sd_rad * model_sd_rad + picture_sd_rad * picture_sd_rad + rough_rad2;
  }
  double sd_rad() const { return std::sqrt(variance_rad2()); }
};

// `off`: the camera's place in the model and refraction, beyond those of `map`.
std::optional<Difference> difference_of(const Edge& edge, const View& view,
                                        const land::HorizonMap& map, const Beside& off) {
  constexpr double kStep = 1e-5;
  constexpr double kTexture = 4.0;  // haze and woods shift an edge by more than its noise says
  const auto seen = view.direction(edge.pixel);
  if (!seen) return std::nullopt;
  const auto crest = crest_at(map, seen->azimuth_rad);
  if (!crest) return std::nullopt;
  Difference difference;
  difference.off_rad = seen->elevation_rad - crest->elevation_rad;
  for (int i = 0; i < kCamera; ++i) {
    const auto other = view.moved(kStep * Unknowns::Unit(i)).direction(edge.pixel);
    if (!other) return std::nullopt;
    difference.by(i) = (other->elevation_rad - seen->elevation_rad -
                        crest->slope * wrap_pi(other->azimuth_rad - seen->azimuth_rad)) /
                       kStep;
  }
  // The camera's offset makes the seen elevation differ; the fit takes it away.
  difference.by.segment<3>(kCamera) = -crest->by_place;
  difference.by(kCamera + 3) = -crest->by_refraction;
  difference.off_rad += difference.by.tail<kBeside>().dot(off);
  difference.place_m = crest->place_m;
  difference.model_sd_rad = crest->model_sd_rad;
  difference.x_px = edge.pixel.x();
  difference.picture_sd_rad = kTexture * edge.sd_px / view.camera.fy_px;
  difference.rough_rad2 = crest->rough_rad2;
  return difference;
}

std::vector<Difference> differences_of(const std::vector<Edge>& edges, const View& view,
                                       const land::HorizonMap& map, const Beside& off) {
  std::vector<Difference> differences;
  for (const Edge& edge : edges) {
    if (auto one = difference_of(edge, view, map, off)) differences.push_back(*std::move(one));
  }
  return differences;
}

// Of the differences. The land's errors are alike where crests are near each other; the picture's
// (haze, woods, the lens) in neighbouring columns. An outlier has more white noise.
Eigen::MatrixXd covariance_of(const std::vector<Difference>& differences, const Unknowns& change) {
  constexpr double kUsual = 2.5;  // sigmas
  constexpr double kAlike_px = 20.0;
  const auto n = static_cast<Eigen::Index>(differences.size());
  Eigen::MatrixXd C(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Difference& one = differences[static_cast<std::size_t>(i)];
    for (Eigen::Index j = 0; j <= i; ++j) {
      const Difference& other = differences[static_cast<std::size_t>(j)];
      const double gap_m = (one.place_m - other.place_m).norm();
      C(i, j) = C(j, i) =
          one.model_sd_rad * other.model_sd_rad * std::exp(-gap_m / land::kLowered_m) +
          one.picture_sd_rad * other.picture_sd_rad *
              std::exp(-std::abs(one.x_px - other.x_px) / kAlike_px);
    }
    const double off_rad = one.off_rad + one.by.dot(change);
    const double weight = std::pow(std::min(1.0, kUsual * one.sd_rad() / std::abs(off_rad)), 4);
    C(i, i) += one.rough_rad2 + (1.0 / weight - 1.0) * one.variance_rad2();
  }
  return C;
}

struct Solution {
  Unknowns change;
  Eigen::Matrix<double, kUnknowns, kUnknowns> covariance;
  double misfit = 0.0;  // squared, of each difference
};

// `change`: the last solution, which says what disagrees. `from_prior`: all changes up to now.
Solution solve(const std::vector<Difference>& differences, const Unknowns& change,
               const Unknowns& from_prior, const Unknowns& prior_sd) {
  const auto n = static_cast<Eigen::Index>(differences.size());
  Eigen::MatrixXd B(n, kUnknowns + 1);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Difference& one = differences[static_cast<std::size_t>(i)];
    B.row(i) << one.by, one.off_rad;
  }
  covariance_of(differences, change).llt().matrixL().solveInPlace(B);
  const Eigen::Matrix<double, kUnknowns + 1, kUnknowns + 1> normal = B.transpose() * B;
  const Unknowns certainty = prior_sd.cwiseAbs2().cwiseInverse();
  Eigen::Matrix<double, kUnknowns, kUnknowns> A = normal.topLeftCorner<kUnknowns, kUnknowns>();
  A.diagonal() += certainty;
  Solution solution;
  solution.covariance = A.ldlt().solve(Eigen::Matrix<double, kUnknowns, kUnknowns>::Identity());
  const Unknowns right =
      -normal.topRightCorner<kUnknowns, 1>() - certainty.cwiseProduct(from_prior);
  solution.change = solution.covariance * right;
  solution.misfit = (normal(kUnknowns, kUnknowns) - solution.change.dot(right)) /
                    std::max(1.0, static_cast<double>(n) - kUnknowns);
  return solution;
}

std::vector<Edge> edges_of(const Rows& found) {
  const auto all = static_cast<std::size_t>(
      std::ranges::count_if(found, [](const auto& row) { return row.has_value(); }));
  const std::size_t each = 1 + all / kMostPoints;
  std::vector<Edge> edges;
  for (std::size_t strip = 0; strip < found.size(); strip += each) {
    if (!found[strip]) continue;
    edges.push_back(
        {{strip_x_px(static_cast<int>(strip)), found[strip]->at_px}, found[strip]->sd_px});
  }
  return edges;
}

class Fit {
 public:
  Fit(const cv::Mat& gray, const CameraIntrinsics& camera, const land::HorizonMap& map,
      const PicturePrior& prior, const PicturePose& start)
      : gray_(gray), map_(map), view_{start, camera}, from_prior_(Unknowns::Zero()) {
    constexpr double kUnknown = 1e3, kSure = 1e-9;
    prior_sd_ << (prior.heading_rad ? prior.heading_sd_rad : kUnknown), prior.tilt_sd_rad,
        prior.roll_sd_rad, prior.focal_sd, prior.k1_sd, prior.place_sd_enu_m,
        map.config().refraction_k_sd;
    prior_sd_ = prior_sd_.cwiseMax(kSure);
    if (prior.heading_rad) from_prior_(0) = wrap_pi(start.heading_rad - *prior.heading_rad);
    from_prior_(1) = start.tilt_rad - prior.tilt_rad;
    from_prior_(2) = start.roll_rad - prior.roll_rad;
  }

  std::optional<PictureFit> run() {
    // The skyline is searched anew near the pose found with the last one, ever more narrowly.
    constexpr double kWide_rad[] = {radians(0.5), radians(0.25), 0.0};
    for (const double wide_rad : kWide_rad) {
      expected_ = expected_rows(map_, {R_enu_cam(view_.pose), view_.camera, wide_rad, wide_rad});
      found_ = find_skyline(gray_, expected_);
      if (!converge(edges_of(found_))) return std::nullopt;
    }
    return result();
  }

 private:
  bool converge(const std::vector<Edge>& edges) {
    constexpr int kIterations = 12;
    constexpr double kMostTurn_rad = radians(0.5);
    for (int i = 0; i < kIterations; ++i) {
      differences_ = differences_of(edges, view_, map_, from_prior_.tail<kBeside>());
      if (differences_.size() < kLeastPoints) return false;
      Solution solution = solve(differences_, Unknowns::Zero(), from_prior_, prior_sd_);
      solution = solve(differences_, solution.change, from_prior_, prior_sd_);
      const double most_rad = solution.change.head<3>().cwiseAbs().maxCoeff();
      const Unknowns change =
          solution.change * std::min(1.0, kMostTurn_rad / std::max(most_rad, 1e-12));
      view_ = view_.moved(change);
      from_prior_ += change;
      solution_ = solution;
      if (std::abs(change(0)) < 0.05 * std::sqrt(solution.covariance(0, 0))) break;
    }
    return std::abs(solution_.change(0)) < std::sqrt(solution_.covariance(0, 0));
  }

  PictureFit result() const {
    PictureFit fit;
    fit.pose = view_.pose;
    fit.pose.heading_rad = wrap_two_pi(fit.pose.heading_rad);
    fit.camera = view_.camera;
    // Errors in rendered photographs are about twice those of the model of the differences.
    constexpr double kMeasured = 2.0;
    const double excess = std::max(1.0, solution_.misfit);
    const auto sd = [&](int i) {
      return kMeasured * std::sqrt(excess * solution_.covariance(i, i));
    };
    fit.sd = {sd(0), sd(1), sd(2)};
    for (std::size_t strip = 0; strip < expected_.size(); ++strip) {
      const auto& row = expected_[strip];
      if (!row || row->at_px < 0.0 || row->at_px > gray_.rows - 1.0) continue;
      ++fit.expected;
      if (!found_[strip]) continue;
      ++fit.found;
      const Edge edge{{strip_x_px(static_cast<int>(strip)), found_[strip]->at_px},
                      found_[strip]->sd_px};
      const auto one = difference_of(edge, view_, map_, from_prior_.tail<kBeside>());
      if (one && std::abs(one->off_rad) < 3.0 * one->sd_rad()) ++fit.agreeing;
    }
    return fit;
  }

  const cv::Mat& gray_;
  const land::HorizonMap& map_;
  View view_;
  Unknowns from_prior_, prior_sd_;
  Rows expected_, found_;
  std::vector<Difference> differences_;
  Solution solution_;
};

}  // namespace

std::optional<PictureFit> fit_picture(const cv::Mat& gray, const CameraIntrinsics& camera,
                                      const land::HorizonMap& map, const PicturePrior& prior,
                                      const PicturePose& start) {
  return Fit(gray, camera, map, prior, start).run();
}

}  // namespace ols::skyline
