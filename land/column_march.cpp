#include "land/column_march.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "geometry/angles.h"
#include "land/refraction.h"

namespace ols::land {
namespace {

constexpr double kKnots_m = 1000.0;  // quadratic between them: micrometres
constexpr double kPerKnot = 1.0 / kKnots_m;
constexpr int kCrestHalvings = 12;  // golden sections: a cell in 300

// The vertical plane of one azimuth. A point Q(s) on the camera's horizontal plane, s metres away,
// is `height` above the ellipsoid; below it, on the ellipsoid's normal, lies the land.
struct Below {
  double latitude_rad, longitude_rad, height_m;  // of Q
  double normal_along, normal_up;                // the ellipsoid's normal, in the plane
};

class VerticalPlane {
 public:
  VerticalPlane(const LocalFrame& frame, double azimuth_rad)
      : frame_(frame), along_enu_(std::sin(azimuth_rad), std::cos(azimuth_rad), 0.0) {}

  Below at(double s_m) {
    const double knots = s_m * kPerKnot;
    const auto piece = static_cast<int>(knots);
    if (piece != piece_) load(piece);
    const double t = 2.0 * (knots - piece);  // 0..2: the middle is 1
    const double first = 0.5 * (t - 1.0) * (t - 2.0);
    const double middle = t * (2.0 - t);
    const double last = 0.5 * t * (t - 1.0);
    const auto mix = [&](double Below::*value) {
      return first * knots_[0].*value + middle * knots_[1].*value + last * knots_[2].*value;
    };
    return {mix(&Below::latitude_rad), mix(&Below::longitude_rad), mix(&Below::height_m),
            mix(&Below::normal_along), mix(&Below::normal_up)};
  }

 private:
  void load(int piece) {
    piece_ = piece;
    for (int i = 0; i < 3; ++i) knots_[i] = exact((piece + 0.5 * i) * kKnots_m);
  }

  Below exact(double s_m) const {
    const Geodetic place = geodetic_from_ecef(frame_.to_ecef(s_m * along_enu_));
    const Eigen::Vector3d up_ecef(std::cos(place.latitude_rad) * std::cos(place.longitude_rad),
                                  std::cos(place.latitude_rad) * std::sin(place.longitude_rad),
                                  std::sin(place.latitude_rad));
    const Eigen::Vector3d up_enu = frame_.R_ecef_enu().transpose() * up_ecef;
    const double camera_rad = frame_.origin().longitude_rad;
    return {place.latitude_rad, camera_rad + wrap_pi(place.longitude_rad - camera_rad),
            place.height_m, up_enu.dot(along_enu_), up_enu.z()};
  }

  const LocalFrame& frame_;
  Eigen::Vector3d along_enu_;
  int piece_ = -1;
  Below knots_[3] = {};
};

struct Sample {
  double s_m = 0.0;      // where on the horizontal plane it was asked for
  double tangent = 0.0;  // of the apparent elevation
  double distance_m = 0.0;
  double sd_m = 0.0;  // of the height
};

class ColumnMarch {
 public:
  ColumnMarch(const Surface& surface, const LocalFrame& frame, double azimuth_rad,
              const MarchSettings& settings, std::vector<Step>& steps)
      : surface_(surface),
        plane_(frame, azimuth_rad),
        settings_(settings),
        covered_(settings.covered),
        builder_(steps) {}

  double run() {
    double known_to_m = settings_.reach_m;
    for (double s_m = settings_.least_cell_m; s_m <= settings_.reach_m; s_m += cell_m(s_m)) {
      const auto sample = sample_at(s_m);
      if (sample) {
        take(*sample);
      } else {
        known_to_m = std::min(known_to_m, s_m);
        crest_ends();
        last_.reset();
      }
    }
    crest_ends();
    builder_.end();
    return known_to_m;
  }

 private:
  double cell_m(double s_m) const {
    return std::max(settings_.least_cell_m, settings_.cell_per_distance * s_m);
  }

  std::optional<SurfaceHeight> land_at(double latitude_rad, double longitude_rad) {
    if (longitude_rad > kPi || longitude_rad < -kPi) longitude_rad = wrap_pi(longitude_rad);
    auto top = surface_.top(latitude_rad, longitude_rad);
    if (!covered_ || !top) return top;
    const auto ground = surface_.ground(latitude_rad, longitude_rad);
    if (ground && ground->height_m < top->height_m) return ground;
    covered_ = false;
    return top;
  }

  std::optional<Sample> sample_at(double s_m) {
    const Below below = plane_.at(s_m);
    const auto land = land_at(below.latitude_rad, below.longitude_rad);
    if (!land) return std::nullopt;
    const double lowered_m =
        s_m < kLowered_m ? settings_.lowered_m * (1.0 - s_m / kLowered_m) : 0.0;
    const double drop_m = below.height_m - land->height_m + lowered_m;
    Sample sample{.s_m = s_m, .distance_m = s_m - drop_m * below.normal_along};
    sample.tangent = -drop_m * below.normal_up / sample.distance_m +
                     refraction_slope(settings_.refraction_k, sample.distance_m);
    sample.sd_m = lowered_m > 0.0 ? std::hypot(land->sd_m, lowered_m) : land->sd_m;
    return sample;
  }

  // The highest sample is held back until the next one tells whether it was a crest.
  void take(const Sample& sample) {
    if (!highest_ || sample.tangent > highest_->tangent) {
      if (is_crest_pending_) {
        add(*highest_, false);
      } else if (highest_) {
        add(emergence(sample), true);
      }
      before_crest_ = last_;
      highest_ = sample;
      is_crest_pending_ = true;
    } else if (is_crest_pending_) {
      refine_crest(sample);
    }
    last_ = sample;
  }

  // Between the last sample, hidden, and this one, seen: where the land comes into view again.
  // After a gap only this one is known.
  Sample emergence(const Sample& seen) const {
    if (!last_) {
      Sample edge = seen;
      edge.tangent = highest_->tangent;
      return edge;
    }
    const double rise = seen.tangent - last_->tangent;
    const double share = (highest_->tangent - last_->tangent) / rise;
    Sample edge = seen;
    edge.tangent = highest_->tangent;
    edge.distance_m = last_->distance_m + share * (seen.distance_m - last_->distance_m);
    return edge;
  }

  // By golden sections between the samples around the highest one.
  void refine_crest(const Sample& after) {
    constexpr double kGolden = 0.6180339887498949;
    double from_m = before_crest_ ? before_crest_->s_m : highest_->s_m;
    double to_m = after.s_m;
    Sample best = *highest_;
    const auto height = [&](double s_m) {
      const auto sample = sample_at(s_m);
      if (sample && sample->tangent > best.tangent) best = *sample;
      return sample ? sample->tangent : -std::numeric_limits<double>::infinity();
    };
    double left_m = to_m - kGolden * (to_m - from_m), right_m = from_m + kGolden * (to_m - from_m);
    double left = height(left_m), right = height(right_m);
    for (int i = 0; i < kCrestHalvings; ++i) {
      if (left < right) {
        from_m = left_m;
        left_m = right_m;
        left = right;
        right = height(right_m = from_m + kGolden * (to_m - from_m));
      } else {
        to_m = right_m;
        right_m = left_m;
        right = left;
        left = height(left_m = to_m - kGolden * (to_m - from_m));
      }
    }
    if (best.distance_m > highest_->distance_m) add(*highest_, false);
    highest_ = best;
    crest_ends();
  }

  void crest_ends() {
    if (is_crest_pending_) add(*highest_, true);
    is_crest_pending_ = false;
  }

  void add(const Sample& sample, bool corner) {
    // A crest refined on the front of a wall may lie before the place where it came into view.
    added_m_ = std::max(added_m_, sample.distance_m);
    const double sd_rad =
        std::hypot(sample.sd_m / sample.distance_m,
                   refraction_slope(settings_.refraction_k_sd, sample.distance_m));
    builder_.add(std::atan(sample.tangent), added_m_, sd_rad, cell_m(added_m_), corner);
  }

  const Surface& surface_;
  VerticalPlane plane_;
  const MarchSettings& settings_;
  bool covered_;
  StaircaseBuilder builder_;
  std::optional<Sample> last_, before_crest_, highest_;
  bool is_crest_pending_ = false;
  double added_m_ = 0.0;
};

}  // namespace

double march(const Surface& surface, const LocalFrame& frame, double azimuth_rad,
             const MarchSettings& settings, std::vector<Step>& steps) {
  return ColumnMarch(surface, frame, azimuth_rad, settings, steps).run();
}

}  // namespace ols::land
