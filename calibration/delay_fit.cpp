#include "calibration/delay_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "geometry/direction.h"
#include "geometry/median.h"

namespace ols::calibration {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;
using Tangent = Eigen::Matrix<double, 3, 2>;

constexpr double kWindow_s = 0.5;  // to either side of an instant: its bearings give one direction
constexpr double kGap_s = 0.25;    // between an instant and the next bearing
constexpr std::size_t kLeastBearings = 5, kLeastSeconds = 10;
constexpr double kUnknownClock_s = 3.0;
constexpr double kReach_s = 10.0;  // between the times of two stations, as stamped: they can meet
constexpr double kMostSd_s = 0.1;
constexpr double kMostNoise = 0.5;  // of the information: the object hardly moves
constexpr int kRounds = 40;
constexpr double kSettled_s = 1e-4, kSettledSds = 0.5, kSameWeights = 0.01;
constexpr Eigen::Index kDelay = 0, kTurn = 1, kShift = 4, kUnknowns = 7;  // of a station

Tangent tangent_at(const Vector3d& direction) {
  return tangent_basis(azimuth_elevation_from_enu(direction));
}

// A line of sight at an instant.
struct Line {
  std::size_t station = 0;
  Vector3d camera_m, direction, rate;  // rate: of the direction [1/s]
  double sd_rad = 0.0, rate_sd = 0.0;  // 1-sigma of each axis
};

// What one station saw of one object, in order of time.
using Path = std::vector<TimedBearing>;

// The direction at this instant: a parabola through the bearings around it.
std::optional<Line> line_at(const Path& path, double time_s) {
  const auto first = std::ranges::lower_bound(path, time_s - kWindow_s, {}, &TimedBearing::time_s);
  const auto next = std::ranges::lower_bound(path, time_s, {}, &TimedBearing::time_s);
  const auto end = std::ranges::upper_bound(path, time_s + kWindow_s, {}, &TimedBearing::time_s);
  if (next == path.begin() || next == path.end()) return std::nullopt;
  const auto before = next - 1;
  if (next->time_s - time_s > kGap_s || time_s - before->time_s > kGap_s) return std::nullopt;
  if (static_cast<std::size_t>(end - first) < kLeastBearings) return std::nullopt;
  const Vector3d& middle = next->direction;
  const Tangent tangent = tangent_at(middle);
  Matrix3d N = Matrix3d::Zero();
  Eigen::Matrix<double, 3, 2> b = Eigen::Matrix<double, 3, 2>::Zero();
  for (auto one = first; one != end; ++one) {
    const double t = one->time_s - time_s, weight = 1.0 / (one->sd_rad * one->sd_rad);
    const Vector3d row(1.0, t, t * t);
    const Vector2d off = tangent.transpose() * one->direction / middle.dot(one->direction);
    N += weight * row * row.transpose();
    b += weight * row * off.transpose();
  }
  const Matrix3d covariance = N.inverse();
  const Eigen::Matrix<double, 3, 2> x = covariance * b;
  return Line{next->station,
              next->camera_m,
              (middle + tangent * x.row(0).transpose()).normalized(),
              tangent * x.row(1).transpose(),
              std::sqrt(covariance(0, 0)),
              std::sqrt(covariance(1, 1))};
}

// The lines of one instant, and the object where they meet.
struct Meeting {
  std::vector<Line> lines;
  Vector3d at_m = Vector3d::Zero();
};

class Fit {
 public:
  Fit(std::vector<TimedBearing> bearings, const std::vector<LastingErrors>& stations,
      std::size_t wanted)
      : wanted_(wanted),
        x_(VectorXd::Zero(kUnknowns * static_cast<Eigen::Index>(stations.size()))),
        information_(x_) {
    using Key = std::tuple<std::size_t, std::int64_t, std::int64_t>;
    std::map<Key, Path> paths;
    std::ranges::stable_sort(bearings, {}, &TimedBearing::time_s);
    for (const TimedBearing& one : bearings)
      paths[{one.station, one.boot_id, one.track_id}].push_back(one);
    for (auto& [key, path] : paths) paths_.push_back(std::move(path));
    for (std::size_t i = 0; i < stations.size(); ++i) set_prior(i, stations[i]);
  }

  DelayFit run() {
    DelayFit fit;
    const Eigen::Index at = index(wanted_) + kDelay;
    double step_s = 1.0;
    bool has_weights = false;  // those of wrong seconds change long after the delay seems to rest
    for (int round = 0; round < kRounds && !(has_weights && step_s < kSettled_s); ++round) {
      const double before_s = x_(at), usual = usual_;
      if (!improve(fit)) return fit;
      step_s = std::abs(x_(at) - before_s);
      has_weights = std::abs(usual_ - usual) < kSameWeights * usual_;
    }
    if (noise_ > kMostNoise * data_(at, at)) return fit;
    const double scale2 = std::max(1.0, fit.misfit * fit.misfit);
    MatrixXd N = data_ / scale2 + MatrixXd(information_.asDiagonal());
    N(at, at) -= noise_ / scale2;
    const double sd_s = std::sqrt(N.ldlt().solve(VectorXd::Unit(x_.size(), at))(at));
    // Bearings at the ends of the windows, which come and go with each step, move it for ever.
    const bool is_settled = step_s < std::max(kSettled_s, kSettledSds * sd_s);
    if (is_settled && sd_s < kMostSd_s) fit.late_s = Measured{x_(at), sd_s};
    return fit;
  }

 private:
  static Eigen::Index index(std::size_t station) {
    return kUnknowns * static_cast<Eigen::Index>(station);
  }

  void set_prior(std::size_t station, const LastingErrors& errors) {
    constexpr double kLeastClock_s = 1e-6, kLeast_rad = 1e-7, kLeast_m = 1e-4;
    const auto information = [](double sd, double least) {
      return std::pow(std::max(sd, least), -2);
    };
    const Eigen::Index at = index(station);
    information_(at + kDelay) =
        information(station == wanted_ ? kUnknownClock_s : errors.clock_sd_s, kLeastClock_s);
    for (const Eigen::Index axis : {0, 1})
      information_(at + kTurn + axis) = information(errors.tilt_sd_rad, kLeast_rad);
    information_(at + kTurn + 2) = information(errors.heading_sd_rad, kLeast_rad);
    for (const Eigen::Index axis : {0, 1, 2})
      information_(at + kShift + axis) = information(errors.position_sd_m, kLeast_m);
  }

  // The whole seconds, true time with the present delay, at which the wanted station has bearings.
  std::vector<double> instants() const {
    std::vector<double> all;
    for (const Path& path : paths_) {
      if (path.front().station != wanted_) continue;
      for (const TimedBearing& one : path)
        all.push_back(std::floor(one.time_s - x_(index(wanted_) + kDelay)));
    }
    std::ranges::sort(all);
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  }

  // The lines at a true instant, with the present delays. nullopt: too few; `several` is counted.
  std::optional<Meeting> meeting_at(double time_s, std::size_t& several) const {
    std::map<std::size_t, std::vector<Line>> seen;
    for (const Path& path : paths_) {
      const std::size_t station = path.front().station;
      if (auto line = line_at(path, time_s + x_(index(station) + kDelay)))
        seen[station].push_back(*line);
    }
    if (!seen.contains(wanted_) || seen.size() < 2) return std::nullopt;
    Meeting meeting;
    for (const auto& [station, lines] : seen) {
      if (lines.size() > 1) {
        ++several;
        return std::nullopt;
      }
      meeting.lines.push_back(lines.front());
    }
    return meet(meeting) ? std::optional(meeting) : std::nullopt;
  }

  // Where the lines are nearest to each other.
  static bool meet(Meeting& meeting) {
    constexpr double kParallel = 1e-6;
    Matrix3d N = Matrix3d::Zero();
    Vector3d b = Vector3d::Zero();
    for (const Line& line : meeting.lines) {
      const Matrix3d across = Matrix3d::Identity() - line.direction * line.direction.transpose();
      N += across;
      b += across * line.camera_m;
    }
    if (N.determinant() < kParallel) return false;
    meeting.at_m = N.inverse() * b;
    return std::ranges::all_of(meeting.lines, [&](const Line& line) {
      return line.direction.dot(meeting.at_m - line.camera_m) > 0.0;
    });
  }

  // Residuals of a meeting and their derivatives, all divided by the 1-sigmas.
  struct Equations {
    VectorXd r;
    MatrixXd by_place, by_unknowns;
  };
  Equations equations(const Meeting& meeting) const {
    const auto rows = 2 * static_cast<Eigen::Index>(meeting.lines.size());
    Equations e{VectorXd::Zero(rows), MatrixXd::Zero(rows, 3), MatrixXd::Zero(rows, x_.size())};
    for (std::size_t i = 0; i < meeting.lines.size(); ++i) {
      const Line& line = meeting.lines[i];
      const Eigen::Index at = index(line.station), row = 2 * static_cast<Eigen::Index>(i);
      const Vector3d way = meeting.at_m - line.camera_m - x_.segment<3>(at + kShift);
      const Vector3d u = way.normalized(), turn = x_.segment<3>(at + kTurn);
      const Tangent tangent = tangent_at(line.direction);
      const Eigen::Matrix<double, 2, 3> across = tangent.transpose() / line.sd_rad;
      e.r.segment<2>(row) = across * (u - line.direction - turn.cross(line.direction));
      e.by_place.middleRows<2>(row) =
          across * (Matrix3d::Identity() - u * u.transpose()) / way.norm();
      e.by_unknowns.block<2, 1>(row, at + kDelay) = -across * line.rate;
      e.by_unknowns.block<2, 3>(row, at + kTurn) = -shift_by_rotation(tangent) / line.sd_rad;
      e.by_unknowns.block<2, 3>(row, at + kShift) = -e.by_place.middleRows<2>(row);
    }
    return e;
  }

  // A rate is never 0 in noisy bearings, and seems to show a delay even if the object stands still.
  double information_of_noise(const Meeting& meeting, const MatrixXd& left) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < meeting.lines.size(); ++i) {
      const Line& line = meeting.lines[i];
      if (line.station != wanted_) continue;
      const double share = left.middleCols<2>(2 * static_cast<Eigen::Index>(i)).squaredNorm();
      sum += share * std::pow(line.rate_sd / line.sd_rad, 2);
    }
    return sum;
  }

  // One step of Gauss and Newton; the places of the object are eliminated. False: too few seconds.
  bool improve(DelayFit& fit) {
    constexpr double kHuber = 3.0;
    fit.seconds = fit.several = 0;
    std::vector<double> sizes;
    double squares = 0.0, freedom = -1.0;  // the delay itself
    data_ = MatrixXd::Zero(x_.size(), x_.size());
    noise_ = 0.0;
    VectorXd gradient = information_.cwiseProduct(x_);
    for (const double time_s : instants()) {
      auto meeting = meeting_at(time_s, fit.several);
      if (!meeting) continue;
      for (int i = 0; i < 3; ++i) {
        const Equations e = equations(*meeting);
        meeting->at_m -= e.by_place.colPivHouseholderQr().solve(e.r);
      }
      const Equations e = equations(*meeting);
      const auto free = static_cast<double>(e.r.size() - 3);
      const Eigen::HouseholderQR<MatrixXd> places(e.by_place);
      const MatrixXd Q = places.householderQ();
      const MatrixXd left = Q.rightCols(e.r.size() - 3).transpose();  // what no place explains
      const VectorXd r = left * e.r;
      const MatrixXd J = left * e.by_unknowns;
      const double size = std::sqrt(r.squaredNorm() / free);
      sizes.push_back(size);
      const double limit = kHuber * std::max(usual_, 1.0);
      const double weight = size > limit ? limit / size : 1.0;
      squares += weight * r.squaredNorm();
      freedom += free;
      data_ += weight * J.transpose() * J;
      gradient += weight * J.transpose() * r;
      noise_ += weight * information_of_noise(*meeting, left);
      ++fit.seconds;
    }
    if (fit.seconds < kLeastSeconds) return false;
    usual_ = 1.4826 * median(std::move(sizes));
    fit.misfit = std::sqrt(squares / freedom);
    x_ -= (data_ + MatrixXd(information_.asDiagonal())).ldlt().solve(gradient);
    return true;
  }

  std::size_t wanted_;
  std::vector<Path> paths_;
  VectorXd x_, information_;  // the stations' errors; inverse variances of their priors
  MatrixXd data_;             // information of the bearings
  double noise_ = 0.0;        // the part of it that comes from the noise of the rates alone
  double usual_ = 1e9;        // robust size of a meeting's residuals
};

// The wanted station, and those with bearings at about its times: others cannot meet it.
std::vector<bool> can_meet(const std::vector<TimedBearing>& bearings, std::size_t stations,
                           std::size_t wanted) {
  std::vector<double> times_s;
  for (const TimedBearing& one : bearings) {
    if (one.station == wanted) times_s.push_back(one.time_s);
  }
  std::ranges::sort(times_s);
  std::vector<bool> can(stations);
  can[wanted] = true;
  for (const TimedBearing& one : bearings) {
    if (can[one.station]) continue;
    const auto next = std::ranges::lower_bound(times_s, one.time_s - kReach_s);
    can[one.station] = next != times_s.end() && *next <= one.time_s + kReach_s;
  }
  return can;
}

}  // namespace

DelayFit fit_delay(std::vector<TimedBearing> bearings, const std::vector<LastingErrors>& stations,
                   std::size_t wanted) {
  const std::vector<bool> can = can_meet(bearings, stations.size(), wanted);
  std::erase_if(bearings, [&](const TimedBearing& one) { return !can[one.station]; });
  std::vector<std::size_t> number(stations.size());  // among those that can meet
  std::vector<LastingErrors> errors;
  for (std::size_t i = 0; i < stations.size(); ++i) {
    number[i] = errors.size();
    if (can[i]) errors.push_back(stations[i]);
  }
  for (TimedBearing& one : bearings) one.station = number[one.station];
  return Fit(std::move(bearings), errors, number[wanted]).run();
}

}  // namespace ols::calibration
