#include "dev/bench/scenery_world.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <opencv2/imgproc.hpp>

#include "geometry/angles.h"
#include "land/refraction.h"

namespace ols::bench {
namespace {

constexpr int kSub = 2;  // samples of a pixel, each way
constexpr float kInfinite = std::numeric_limits<float>::infinity();
const Eigen::Vector3f kSun = Eigen::Vector3f(-0.55F, -0.45F, 0.70F).normalized();

std::uint32_t hash(std::int32_t x, std::int32_t y, std::int32_t z) {
  std::uint32_t h = static_cast<std::uint32_t>(x) * 0x8da6b343U ^
                    static_cast<std::uint32_t>(y) * 0xd8163841U ^
                    static_cast<std::uint32_t>(z) * 0xcb1ab31fU;
  h ^= h >> 13;
  h *= 0x5bd1e995U;
  h ^= h >> 15;
  return h;
}
float unit(std::uint32_t h) { return static_cast<float>(h & 0xffffffU) * (2.0F / 0xffffff) - 1.0F; }

// -1..1, smooth over one unit of length.
float noise3(float x, float y, float z) {
  const float fx = std::floor(x), fy = std::floor(y), fz = std::floor(z);
  const auto i = static_cast<std::int32_t>(fx), j = static_cast<std::int32_t>(fy),
             k = static_cast<std::int32_t>(fz);
  const auto smooth = [](float t) { return t * t * (3.0F - 2.0F * t); };
  const float a = smooth(x - fx), b = smooth(y - fy), c = smooth(z - fz);
  float planes[2];
  for (int p = 0; p < 2; ++p) {
    const float lower = (1 - a) * unit(hash(i, j, k + p)) + a * unit(hash(i + 1, j, k + p));
    const float upper = (1 - a) * unit(hash(i, j + 1, k + p)) + a * unit(hash(i + 1, j + 1, k + p));
    planes[p] = (1 - b) * lower + b * upper;
  }
  return (1 - c) * planes[0] + c * planes[1];
}
float noise2(float x, float y, std::int32_t salt) {
  const float fx = std::floor(x), fy = std::floor(y);
  const auto i = static_cast<std::int32_t>(fx), j = static_cast<std::int32_t>(fy);
  const auto smooth = [](float t) { return t * t * (3.0F - 2.0F * t); };
  const float a = smooth(x - fx), b = smooth(y - fy);
  return (1 - b) * ((1 - a) * unit(hash(i, j, salt)) + a * unit(hash(i + 1, j, salt))) +
         b * ((1 - a) * unit(hash(i, j + 1, salt)) + a * unit(hash(i + 1, j + 1, salt)));
}

// Sum of octaves; those finer than a sample are left out.
float fractal2(float x, float y, float finest_m) {
  float sum = 0.0F;
  std::int32_t salt = 1;
  for (float length = 60.0F; length > 0.15F; length *= 0.4F, ++salt) {
    const float keep = std::clamp(length / finest_m - 1.0F, 0.0F, 1.0F);
    if (keep <= 0.0F) break;
    sum += keep * 0.45F * noise2(x / length, y / length, salt);
  }
  return sum;
}
float fractal3(const Eigen::Vector3f& p, float finest_m) {
  float sum = 0.0F;
  for (float length = 1.6F; length > 0.06F; length *= 0.45F) {
    const float keep = std::clamp(length / finest_m - 1.0F, 0.0F, 1.0F);
    if (keep <= 0.0F) break;
    sum += keep * 0.5F * noise3(p.x() / length, p.y() / length, p.z() / length);
  }
  return sum;
}

float lit(const Eigen::Vector3f& normal) {
  return 0.45F + 0.75F * std::max(0.0F, normal.dot(kSun));
}
// Far land fades to the air's light.
float through_air(float brightness, float range_m) {
  const float clear = std::exp(-range_m / 12'000.0F);
  return clear * brightness + (1.0F - clear) * 190.0F;
}

// A part of a panorama, in samples.
class Tile {
 public:
  Tile(const SceneryWorld& world, const Eigen::Vector3d& camera, const PanoramaRaster& raster,
       int first_px, int columns_px)
      : world_(world),
        camera_(camera),
        step_rad_(raster.rad_per_px / kSub),
        top_rad_(raster.top_elevation_rad + 0.25 * raster.rad_per_px),
        gray_(raster.size.height * kSub, columns_px * kSub, -1.0F),
        range_m_(gray_.size(), kInfinite) {
    first_rad_ = raster.first_azimuth_rad + (first_px - 0.25) * raster.rad_per_px;
    for (int i = 0; i < gray_.cols; ++i) {
      const double azimuth = first_rad_ + i * step_rad_;
      east_.push_back(static_cast<float>(std::sin(azimuth)));
      north_.push_back(static_cast<float>(std::cos(azimuth)));
    }
  }

  void draw() {
    for (int i = 0; i < gray_.cols; ++i) draw_ground(i);
    for (const Ball& ball : world_.balls) draw_ball(ball);
    for (const Body& body : world_.bodies) draw_body(body);
    for (int j = 0; j < gray_.rows; ++j) {
      for (int i = 0; i < gray_.cols; ++i) {
        if (std::isinf(range_m_(j, i))) gray_(j, i) = sky(i, j);
      }
    }
  }
  const cv::Mat1f& gray() const { return gray_; }
  const cv::Mat1f& range_m() const { return range_m_; }

 private:
  float sky(int i, int j) const {
    const auto azimuth = static_cast<float>(first_rad_ + i * step_rad_);
    const auto elevation = static_cast<float>(top_rad_ - j * step_rad_);
    return 205.0F + 14.0F * noise2(azimuth * 20.0F, elevation * 60.0F, 99) +
           6.0F * noise2(azimuth * 70.0F, elevation * 150.0F, 98);
  }
  static double lift_rad(double range_m) {
    return land::refraction_slope(land::kRefraction, range_m);
  }

  void draw_ground(int i) {
    double highest = -1e9;  // tangent
    int row = gray_.rows - 1;
    double last_d = 0.0, last_slope = -1e9;
    for (double d = 30.0; d < 9000.0 && row >= 0;) {
      const double x = camera_.x() + d * east_[static_cast<std::size_t>(i)];
      const double y = camera_.y() + d * north_[static_cast<std::size_t>(i)];
      const double height = world_.ground_m(x, y);
      if (std::isnan(height)) break;
      const double slope = (height - camera_.z()) / d + lift_rad(d);
      if (slope > highest) {
        for (; row >= 0; --row) {
          const double wanted = std::tan(top_rad_ - row * step_rad_);
          if (wanted > slope) break;
          const double share =
              last_slope > -1e8 && slope > last_slope
                  ? std::clamp((wanted - last_slope) / (slope - last_slope), 0.0, 1.0)
                  : 1.0;
          shade_ground(i, row, last_d > 0.0 ? last_d + share * (d - last_d) : d);
        }
        highest = slope;
      }
      last_d = d;
      last_slope = slope;
      d += std::max(0.7, 2.5e-4 * d);
    }
  }
  void shade_ground(int i, int j, double d) {
    const double x = camera_.x() + d * east_[static_cast<std::size_t>(i)];
    const double y = camera_.y() + d * north_[static_cast<std::size_t>(i)];
    const double height = world_.ground_m(x, y);
    constexpr double kStep = 1.0;
    const auto dx = static_cast<float>(world_.ground_m(x + kStep, y) - height);
    const auto dy = static_cast<float>(world_.ground_m(x, y + kStep) - height);
    if (std::isnan(dx + dy)) return;
    const Eigen::Vector3f normal = Eigen::Vector3f(-dx, -dy, 1.0F).normalized();
    const Eigen::Vector3f p(static_cast<float>(x - camera_.x()),
                            static_cast<float>(y - camera_.y()),
                            static_cast<float>(height - camera_.z()));
    const float range = p.norm();
    // A sample covers more along the ground than across.
    const float grazing = std::max(0.02F, std::abs(normal.dot(p)) / range);
    const float finest = range * static_cast<float>(step_rad_) * std::sqrt(1.0F / grazing);
    const float albedo = 0.40F * std::max(0.15F, 1.0F + fractal2(static_cast<float>(x),
                                                                 static_cast<float>(y), finest));
    gray_(j, i) = through_air(200.0F * albedo * lit(normal), range);
    range_m_(j, i) = range;
  }

  // Calls take(row, column, direction) for all samples near a point.
  template <class Take>
  void near(const Eigen::Vector3d& offset, double reach_m, Take take) const {
    const double range = offset.norm();
    if (range < 20.0 + reach_m) return;
    const double half = 1.02 * reach_m / range;
    const double azimuth = std::atan2(offset.x(), offset.y());
    const double middle = wrap_pi(azimuth - first_rad_) / step_rad_;
    const double lift = lift_rad(range);
    const double elevation = std::asin(offset.z() / range) + lift;
    const double wide = half / std::max(0.2, std::cos(elevation)) / step_rad_;
    const double high = half / step_rad_, at = (top_rad_ - elevation) / step_rad_;
    const int left = std::max(0, static_cast<int>(std::floor(middle - wide)));
    const int right = std::min(gray_.cols - 1, static_cast<int>(std::ceil(middle + wide)));
    const int top = std::max(0, static_cast<int>(std::floor(at - high)));
    const int bottom = std::min(gray_.rows - 1, static_cast<int>(std::ceil(at + high)));
    for (int j = top; left <= right && j <= bottom; ++j) {
      const double e = top_rad_ - j * step_rad_ - lift;
      const auto c = static_cast<float>(std::cos(e)), s = static_cast<float>(std::sin(e));
      for (int i = left; i <= right; ++i) {
        const auto column = static_cast<std::size_t>(i);
        take(j, i, Eigen::Vector3f(c * east_[column], c * north_[column], s));
      }
    }
  }

  void draw_ball(const Ball& ball) {
    const Eigen::Vector3d offset = ball.centre.cast<double>() - camera_;
    const double off = wrap_pi(std::atan2(offset.x(), offset.y()) - first_rad_);
    if (off < -0.02 || off > gray_.cols * step_rad_ + 0.02) return;
    const Eigen::Vector3f o = offset.cast<float>();
    const float outside = static_cast<float>(offset.squaredNorm()) - ball.radius_m * ball.radius_m;
    near(offset, ball.radius_m, [&](int j, int i, const Eigen::Vector3f& ray) {
      const float along = ray.dot(o);
      // Of the small distance from the centre, not of the difference of large squares.
      const float across2 = (o - along * ray).squaredNorm();
      const float inside2 = ball.radius_m * ball.radius_m - across2;
      if (inside2 < 0.0F || outside < 0.0F) return;
      const float range = along - std::sqrt(inside2);
      if (range >= range_m_(j, i)) return;
      const Eigen::Vector3f from_centre = range * ray - o;
      const Eigen::Vector3f normal = from_centre / ball.radius_m;
      const float finest = range * static_cast<float>(step_rad_);
      const float albedo =
          ball.albedo * std::max(0.2F, 1.0F + 0.9F * fractal3(from_centre + ball.centre, finest));
      gray_(j, i) = through_air(200.0F * albedo * lit(normal), range);
      range_m_(j, i) = range;
    });
  }

  void draw_body(const Body& body) {
    const Eigen::Vector3d offset = body.centre.cast<double>() - camera_;
    const double off = wrap_pi(std::atan2(offset.x(), offset.y()) - first_rad_);
    if (off < -0.1 || off > gray_.cols * step_rad_ + 0.1) return;
    const Eigen::Vector3f o = offset.cast<float>();
    near(offset, body.reach_m, [&](int j, int i, const Eigen::Vector3f& ray) {
      // Faces are relative to the body's centre.
      float enter = 0.0F, leave = kInfinite;
      const Body::Face* hit = nullptr;
      for (const Body::Face& face : body.faces) {
        const float speed = face.normal.dot(ray);
        const float ahead = face.offset_m + face.normal.dot(o);
        if (std::abs(speed) < 1e-9F) {
          if (ahead < 0.0F) return;
          continue;
        }
        const float t = ahead / speed;
        if (speed < 0.0F && t > enter) {
          enter = t;
          hit = &face;
        } else if (speed > 0.0F) {
          leave = std::min(leave, t);
        }
      }
      if (hit == nullptr || enter >= leave || enter >= range_m_(j, i)) return;
      gray_(j, i) = through_air(shade_face(body, *hit, enter * ray - o, enter), enter);
      range_m_(j, i) = enter;
    });
  }
  float shade_face(const Body& body, const Body::Face& face, const Eigen::Vector3f& at,
                   float range) const {
    const float finest = range * static_cast<float>(step_rad_);
    float albedo = face.albedo * std::max(0.2F, 1.0F + 0.45F * fractal3(at + body.centre, finest));
    if (face.windows) {
      const Eigen::Vector3f across(face.normal.y(), -face.normal.x(), 0.0F);
      const float u = at.dot(across) / 2.6F, v = at.z() / 2.8F;
      const float a = u - std::floor(u), b = v - std::floor(v);
      if (a > 0.3F && a < 0.7F && b > 0.35F && b < 0.8F) {
        const auto salt = static_cast<std::int32_t>(body.centre.x() * 7.0F);
        const std::uint32_t h = hash(static_cast<std::int32_t>(std::floor(u)),
                                     static_cast<std::int32_t>(std::floor(v)), salt);
        albedo = 0.10F + 0.06F * unit(h);
      }
    }
    return 200.0F * albedo * lit(face.normal);
  }

  const SceneryWorld& world_;
  Eigen::Vector3d camera_;
  double step_rad_, first_rad_, top_rad_;
  std::vector<float> east_, north_;
  cv::Mat1f gray_, range_m_;
};

Body::Face face_of(const Eigen::Vector3f& normal, float offset_m, float albedo, bool windows) {
  return {normal.normalized(), offset_m / normal.norm(), albedo, windows};
}

// A box with a gable if `rise_m` > 0. `size`: along, across, up to the eaves.
Body box(const Eigen::Vector3f& foot, const Eigen::Vector3f& size, float heading_rad, float rise_m,
         float albedo, bool windows) {
  const Eigen::Vector3f along(std::sin(heading_rad), std::cos(heading_rad), 0.0F);
  const Eigen::Vector3f across(along.y(), -along.x(), 0.0F), up(0.0F, 0.0F, 1.0F);
  Body body;
  const float high = size.z() + rise_m;
  body.centre = foot + 0.5F * high * up;
  body.reach_m = 0.5F * Eigen::Vector3f(size.x(), size.y(), high).norm();
  for (const float side : {-1.0F, 1.0F}) {
    body.faces.push_back(face_of(side * along, 0.5F * size.x(), albedo, windows));
    body.faces.push_back(face_of(side * across, 0.5F * size.y(), albedo, windows));
  }
  body.faces.push_back(face_of(-up, 0.5F * high + 1.0F, albedo, false));
  body.faces.push_back(face_of(up, 0.5F * high, 0.6F * albedo, false));
  if (rise_m > 0.0F) {
    const float slope = rise_m / (0.5F * size.y());
    for (const float side : {-1.0F, 1.0F}) {
      body.faces.push_back(face_of(up + side * slope * across, 0.5F * high, 0.55F * albedo, false));
    }
  }
  return body;
}

class Maker {
 public:
  Maker(SceneryWorld& world, const Eigen::Vector2d& along, const WorldPlan& plan)
      : world_(world), along_(along), plan_(plan), generator_(world.seed) {}

  void plant() {
    for (int i = 0; i < plan_.houses; ++i) house(place());
    for (int i = 0; i < plan_.masts; ++i) mast(place());
    for (int i = 0; i < plan_.bushes; ++i) bush(place());
    for (int left = plan_.trees; left > 0;) {
      const Eigen::Vector2d grove = place();
      const int count = std::min(left, 1 + static_cast<int>(std::pow(drawn(0, 1), 3) * 60));
      for (int i = 0; i < count; ++i) {
        const double spread = 3.5 * std::sqrt(static_cast<double>(count));
        tree(grove + Eigen::Vector2d(drawn(-spread, spread), drawn(-spread, spread)));
      }
      left -= count;
    }
  }

 private:
  double drawn(double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(generator_);
  }
  float drawnf(double from, double to) { return static_cast<float>(drawn(from, to)); }
  Eigen::Vector2d place() {
    // As many at each distance, so that there is something to see at all.
    const double d = drawn(plan_.from_m, plan_.to_m), off = drawn(-plan_.within_m, plan_.within_m);
    return d * along_ + off * Eigen::Vector2d(along_.y(), -along_.x());
  }
  std::optional<Eigen::Vector3f> foot(const Eigen::Vector2d& at) const {
    const double height = world_.ground_m(at.x(), at.y());
    if (std::isnan(height)) return std::nullopt;
    return Eigen::Vector3d(at.x(), at.y(), height).cast<float>();
  }
  void tree(const Eigen::Vector2d& at) {
    const auto base = foot(at);
    if (!base) return;
    const bool conifer = drawn(0, 1) < 0.35;
    const float high = drawnf(5, 16), wide = high * drawnf(0.18, 0.35), bright = drawnf(0.15, 0.4);
    world_.bodies.push_back(box(*base, {0.4F, 0.4F, 0.6F * high}, 0.0F, 0.0F, 0.2F, false));
    const int balls = 60;
    for (int i = 0; i < balls; ++i) {
      const float level = drawnf(0, 1), turn = drawnf(0, 2.0 * kPi);
      const float bulge = conifer
                              ? 1.0F - level
                              : std::sqrt(std::max(0.0F, 1.0F - (2 * level - 1) * (2 * level - 1)));
      const float out = wide * bulge * std::sqrt(drawnf(0.25, 1.0));
      const float z = high * (0.25F + 0.75F * level);
      world_.balls.push_back(
          {*base + Eigen::Vector3f(out * std::cos(turn), out * std::sin(turn), z),
           std::max(0.25F, wide * drawnf(0.16, 0.34)), bright * drawnf(0.6, 1.4)});
    }
  }
  void bush(const Eigen::Vector2d& at) {
    const auto base = foot(at);
    if (!base) return;
    const float bright = drawnf(0.15, 0.6);
    for (int i = 0; i < 6; ++i) {
      world_.balls.push_back({*base + Eigen::Vector3f(drawnf(-1, 1), drawnf(-1, 1), drawnf(0, 1)),
                              drawnf(0.25, 0.7), bright * drawnf(0.6, 1.4)});
    }
  }
  void house(const Eigen::Vector2d& at) {
    const auto base = foot(at);
    if (!base) return;
    const bool gable = drawn(0, 1) < 0.6;
    const Eigen::Vector3f size(drawnf(8, 22), drawnf(6, 12), drawnf(3, 10));
    world_.bodies.push_back(box(*base, size, drawnf(0, kPi), gable ? drawnf(1.5, 4) : 0.0F,
                                drawnf(0.3, 0.95), drawn(0, 1) < 0.8));
  }
  void mast(const Eigen::Vector2d& at) {
    const auto base = foot(at);
    if (!base) return;
    const float high = drawnf(8, 30), thick = drawnf(0.25, 0.7), heading = drawnf(0, kPi);
    const float albedo = drawnf(0.1, 0.9);
    world_.bodies.push_back(box(*base, {thick, thick, high}, heading, 0.0F, albedo, false));
    for (int i = 0; i < 2; ++i) {
      const Eigen::Vector3f arm = *base + Eigen::Vector3f(0, 0, high * drawnf(0.7, 0.95));
      world_.bodies.push_back(
          box(arm, {drawnf(1.5, 5), 0.25F, 0.3F}, heading, 0.0F, albedo, false));
    }
  }

  SceneryWorld& world_;
  Eigen::Vector2d along_;
  const WorldPlan& plan_;
  std::mt19937_64 generator_;
};

HeightLattice lattice_of(const std::function<double(double, double)>& ground,
                         const Eigen::Vector2d& middle, double half_m, double pitch_m) {
  HeightLattice lattice{middle - Eigen::Vector2d::Constant(half_m), pitch_m, {}};
  const int count = static_cast<int>(2.0 * half_m / pitch_m) + 1;
  lattice.heights_m.create(count, count);
  cv::parallel_for_({0, count}, [&](const cv::Range& rows) {
    for (int j = rows.start; j < rows.end; ++j) {
      for (int i = 0; i < count; ++i) {
        lattice.heights_m(j, i) = static_cast<float>(
            ground(lattice.south_west_m.x() + i * pitch_m, lattice.south_west_m.y() + j * pitch_m));
      }
    }
  });
  return lattice;
}

}  // namespace

bool HeightLattice::covers(double x, double y) const {
  const double i = (x - south_west_m.x()) / pitch_m, j = (y - south_west_m.y()) / pitch_m;
  return i >= 0.0 && j >= 0.0 && i < heights_m.cols - 1 && j < heights_m.rows - 1;
}
float HeightLattice::at(double x, double y) const {
  const double u = (x - south_west_m.x()) / pitch_m, v = (y - south_west_m.y()) / pitch_m;
  const int i = static_cast<int>(u), j = static_cast<int>(v);
  const auto a = static_cast<float>(u - i), b = static_cast<float>(v - j);
  const float *low = heights_m[j] + i, *high = heights_m[j + 1] + i;
  return (1 - b) * ((1 - a) * low[0] + a * low[1]) + b * ((1 - a) * high[0] + a * high[1]);
}

double SceneryWorld::ground_m(double x, double y) const {
  if (near.covers(x, y)) return static_cast<double>(near.at(x, y));
  if (far.covers(x, y)) return static_cast<double>(far.at(x, y));
  return std::numeric_limits<double>::quiet_NaN();
}

DrawnPanorama draw_panorama(const SceneryWorld& world, const Eigen::Vector3d& camera,
                            const PanoramaRaster& raster, const Exposure& exposure,
                            std::uint64_t seed) {
  constexpr int kColumns = 128;
  cv::Mat1f gray(raster.size);
  DrawnPanorama drawn{cv::Mat1b(raster.size), cv::Mat1f(raster.size)};
  const int tiles = (raster.size.width + kColumns - 1) / kColumns;
  cv::parallel_for_({0, tiles}, [&](const cv::Range& range) {
    for (int number = range.start; number < range.end; ++number) {
      const int first = number * kColumns, columns = std::min(kColumns, raster.size.width - first);
      Tile tile(world, camera, raster, first, columns);
      tile.draw();
      for (int j = 0; j < raster.size.height; ++j) {
        for (int i = 0; i < columns; ++i) {
          float sum = 0.0F, nearest = kInfinite;
          for (int n = 0; n < kSub * kSub; ++n) {
            sum += tile.gray()(j * kSub + n / kSub, i * kSub + n % kSub);
            nearest = std::min(nearest, tile.range_m()(j * kSub + n / kSub, i * kSub + n % kSub));
          }
          gray(j, first + i) = sum / (kSub * kSub);
          drawn.range_m(j, first + i) = nearest;
        }
      }
    }
  });
  cv::GaussianBlur(gray, gray, {}, exposure.blur_px);
  cv::RNG random(seed);
  cv::Mat1f noise(raster.size);
  random.fill(noise, cv::RNG::NORMAL, 0.0, exposure.noise);
  gray = gray * exposure.gain + noise + exposure.offset;
  gray.convertTo(drawn.gray, CV_8U);
  return drawn;
}

SceneryWorld make_world(const std::function<double(double x, double y)>& ground,
                        const Eigen::Vector2d& along, const WorldPlan& plan, std::uint64_t seed) {
  SceneryWorld world;
  world.seed = seed;
  world.near = lattice_of(ground, 2000.0 * along, 2300.0, 2.0);
  world.far = lattice_of(ground, 3000.0 * along, 8000.0, 25.0);
  Maker(world, along, plan).plant();
  return world;
}

}  // namespace ols::bench
