#include "sim/world/panorama.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "geometry/angles.h"
#include "geometry/direction.h"
#include "sim/world/remembered.h"
#include "sim/world/texture.h"

namespace ols::sim {
namespace {

constexpr int kCell = 32;      // [px] of the coarse grid; bilinear interpolation errs by < 0.01 px
constexpr int kPeriod = 2048;  // [texel] of the slopes' texture
constexpr double kAirLight = 190.0;  // [gray] distant slopes fade to this
constexpr double kSkyTexel = radians(0.1);
constexpr double kSkyBottom = radians(-10.0), kSkyTop = radians(70.0);

// Max distance of a pixel from the image's centre, with a margin for azimuths that widen with
// elevation.
double reach_px(const CameraIntrinsics& camera) {
  return 0.6 * std::hypot(camera.width_px, camera.height_px);
}

// Relief of the ridge in -1..1: a few low harmonics of the azimuth.
std::vector<float> relief(int length, std::mt19937_64& generator) {
  std::uniform_real_distribution<double> phase(0.0, 2.0 * kPi);
  std::vector<float> sum(static_cast<std::size_t>(length), 0.0F);
  float greatest = 0.0F;
  for (int harmonic : {3, 5, 8, 13, 21, 34}) {
    const double start = phase(generator), amplitude = 1.0 / std::sqrt(harmonic);
    for (int u = 0; u < length; ++u) {
      sum[static_cast<std::size_t>(u)] +=
          static_cast<float>(amplitude * std::sin(2.0 * kPi * harmonic * u / length + start));
    }
  }
  for (float value : sum) greatest = std::max(greatest, std::abs(value));
  for (float& value : sum) value /= greatest;
  return sum;
}

struct Sky {
  cv::Mat brightness;         // over azimuth and elevation
  std::mt19937_64 generator;  // in its state after the sky
};

// A gradient and soft clouds.
Sky sky_panorama(double cloudiness, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  const cv::Size size(static_cast<int>(std::lround(2.0 * kPi / kSkyTexel)),
                      static_cast<int>(std::lround((kSkyTop - kSkyBottom) / kSkyTexel)));
  cv::Mat sky = fractal_noise(size, 160, 2.5, 0.55, generator);
  for (int y = 0; y < size.height; ++y) {
    const double elevation = kSkyTop - y * kSkyTexel;
    const double gradient = 205.0 - 35.0 * std::clamp(elevation / radians(40.0), 0.0, 1.0);
    for (int x = 0; x < size.width; ++x) {
      float& value = sky.at<float>(y, x);
      const double cloud = 1.0 / (1.0 + std::exp(-1.8 * value));  // soft edges, flat inside
      value = static_cast<float>(gradient + cloudiness * (56.0 * cloud - 34.0));
    }
  }
  return {sky, generator};
}

}  // namespace

cv::Mat slopes_texture(const Landscape& landscape, const CameraIntrinsics& camera) {
  thread_local Remembered<int, cv::Mat> woods;
  const cv::Mat period = woods.of(landscape.seed, [&landscape] {
    std::mt19937_64 generator(static_cast<std::uint64_t>(landscape.seed));
    return wood(kPeriod, generator);
  });
  const int copies = 2 + static_cast<int>(std::floor(2.0 * reach_px(camera) / kPeriod));
  cv::Mat slopes;
  cv::repeat(period, copies, copies, slopes);
  slopes.convertTo(slopes, CV_8U, 1.0 - landscape.haze, landscape.haze * kAirLight);
  return slopes;
}

Panorama::Panorama(const Landscape& landscape, const CameraIntrinsics& camera,
                   const cv::Mat& slopes, std::uint64_t seed)
    : camera_(camera), made_for_px_(camera.fx_px), slopes_(slopes) {
  thread_local Remembered<std::pair<std::uint64_t, double>, Sky> skies;
  const double cloudiness = landscape.cloudiness;
  auto [sky, generator] =
      skies.of({seed, cloudiness}, [=] { return sky_panorama(cloudiness, seed); });
  sky_ = sky;
  const double periods = std::max(4.0, std::round(2.0 * kPi * camera.fx_px / kPeriod));
  const int around = static_cast<int>(periods) * kPeriod;
  texels_per_rad_ = around / (2.0 * kPi);
  ridge_ = relief(around, generator);
  const std::vector<float> tops = tree_tops(around, generator);
  for (std::size_t u = 0; u < ridge_.size(); ++u) {
    const double smooth = landscape.ridge_mean_rad + landscape.ridge_relief_rad * ridge_[u];
    ridge_[u] = static_cast<float>(smooth * texels_per_rad_) + tops[u];
  }
  columns_ = (camera.width_px + kCell - 1) / kCell + 1;
  rows_ = (camera.height_px + kCell - 1) / kCell + 1;
  compute_rays();
  nodes_.resize(rays_cam_.size());
  ridge_row_.resize(static_cast<std::size_t>(camera.width_px));
}

void Panorama::compute_rays() {
  rays_cam_.clear();
  for (int j = 0; j < rows_; ++j) {
    for (int i = 0; i < columns_; ++i) {
      rays_cam_.push_back(unproject(camera_, Eigen::Vector2d(i * kCell, j * kCell)).value());
    }
  }
}

void Panorama::set_camera(const CameraIntrinsics& camera) {
  if (camera.fx_px == camera_.fx_px) return;
  camera_ = camera;
  px_per_texel_ = static_cast<float>(camera.fx_px / made_for_px_);
  compute_rays();
}

void Panorama::raise(const std::function<double(double azimuth_rad)>& skyline_rad) {
  constexpr std::size_t kColumn = 4;  // texels: some tenths of a milliradian
  for (std::size_t u = 0; u < ridge_.size(); u += kColumn) {
    const double middle = static_cast<double>(u) + 0.5 * kColumn;
    const auto near = static_cast<float>(skyline_rad(middle / texels_per_rad_) * texels_per_rad_);
    for (std::size_t i = u; i < std::min(u + kColumn, ridge_.size()); ++i) {
      ridge_[i] = std::max(ridge_[i], near);
    }
  }
}

double Panorama::ridge_rad(double azimuth_rad) const {
  const double texel = wrap_two_pi(azimuth_rad) * texels_per_rad_;
  return ridge_[static_cast<std::size_t>(texel) % ridge_.size()] / texels_per_rad_;
}

void Panorama::draw(const Eigen::Matrix3d& R_enu_cam, cv::Mat& gray) {
  gray.create(camera_.height_px, camera_.width_px, CV_8U);
  compute_nodes(R_enu_cam);
  find_ridge_rows();
  const auto [highest, lowest] = std::minmax_element(ridge_row_.begin(), ridge_row_.end());
  const int first = std::clamp(static_cast<int>(std::floor(*highest)) - 1, 0, gray.rows);
  const int pure = std::clamp(static_cast<int>(std::ceil(*lowest)) + 1, first, gray.rows);
  draw_sky(pure, gray);
  draw_slopes(first, pure, gray);
}

void Panorama::compute_nodes(const Eigen::Matrix3d& R_enu_cam) {
  const AzimuthElevation axis = azimuth_elevation_from_enu(R_enu_cam.col(2));
  // Nodes relative to a corner of the texture's period beyond the upper left of the image, so that
  // they are small, positive and precise as floats.
  const double reach = reach_px(camera_);
  const double u_axis = axis.azimuth_rad * texels_per_rad_;
  const double v_axis = -axis.elevation_rad * texels_per_rad_;
  u_origin_ = std::floor((u_axis - reach) / kPeriod) * kPeriod;
  v_origin_ = std::floor((v_axis - reach) / kPeriod) * kPeriod;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const AzimuthElevation d = azimuth_elevation_from_enu(R_enu_cam * rays_cam_[i]);
    const double off_axis = wrap_pi(d.azimuth_rad - axis.azimuth_rad);
    const double u = u_axis + off_axis * texels_per_rad_ - u_origin_;
    const double v = -d.elevation_rad * texels_per_rad_ - v_origin_;
    nodes_[i].u = static_cast<float>(std::clamp(u, 0.0, slopes_.cols - 2.0));
    nodes_[i].v = static_cast<float>(std::clamp(v, 0.0, slopes_.rows - 2.0));
  }
}

Panorama::Node Panorama::node_at(float x, float y) const {
  const int i = std::clamp(static_cast<int>(x / kCell), 0, columns_ - 2);
  const int j = std::clamp(static_cast<int>(y / kCell), 0, rows_ - 2);
  const float a = x / kCell - static_cast<float>(i), b = y / kCell - static_cast<float>(j);
  const Node* top = &nodes_[static_cast<std::size_t>(j * columns_ + i)];
  const Node* bottom = top + columns_;
  const auto mix = [&](float Node::*m) {
    return (1 - b) * ((1 - a) * top[0].*m + a * top[1].*m) +
           b * ((1 - a) * bottom[0].*m + a * bottom[1].*m);
  };
  return {mix(&Node::u), mix(&Node::v)};
}

void Panorama::draw_sky(int end, cv::Mat& gray) const {
  cv::Mat map(rows_, columns_, CV_32FC2), brightness;
  const double sky_per_texel = 1.0 / (texels_per_rad_ * kSkyTexel);
  for (int j = 0; j < rows_; ++j) {
    for (int i = 0; i < columns_; ++i) {
      const Node& n = nodes_[static_cast<std::size_t>(j * columns_ + i)];
      const double u = std::fmod((n.u + u_origin_) * sky_per_texel + sky_.cols, sky_.cols);
      const double v = kSkyTop / kSkyTexel + (n.v + v_origin_) * sky_per_texel;
      map.at<cv::Vec2f>(j, i) = {static_cast<float>(u), static_cast<float>(v)};
    }
  }
  cv::remap(sky_, brightness, map, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  for (int y = 0; y < end; ++y) {
    const int j = y / kCell;
    const float b = static_cast<float>(y % kCell) / kCell;
    const float* top = brightness.ptr<float>(j);
    const float* bottom = brightness.ptr<float>(j + 1);
    std::uint8_t* out = gray.ptr(y);
    for (int i = 0; i * kCell < gray.cols; ++i) {
      const float left = (1 - b) * top[i] + b * bottom[i];
      const float right = (1 - b) * top[i + 1] + b * bottom[i + 1];
      const int step = static_cast<int>((right - left) * (65536.0F / kCell));
      const int start = static_cast<int>(left * 65536.0F) + 32768;
      const int width = std::min(kCell, gray.cols - i * kCell);
      for (int x = 0; x < width; ++x) {
        out[i * kCell + x] = static_cast<std::uint8_t>((start + x * step) >> 16);
      }
    }
  }
}

void Panorama::find_ridge_rows() {
  const auto around = static_cast<std::int64_t>(ridge_.size());
  const auto origin = static_cast<std::int64_t>(u_origin_);
  float y = 0.5F * static_cast<float>(camera_.height_px);
  for (std::size_t x = 0; x < ridge_row_.size(); ++x) {
    for (int iteration = 0; iteration < 4; ++iteration) {
      const Node n = node_at(static_cast<float>(x), y);
      const auto u = (origin + static_cast<std::int64_t>(n.u) + 2 * around) % around;
      // Elevation grows upwards, rows downwards.
      y += px_per_texel_ *
           (-ridge_[static_cast<std::size_t>(u)] - static_cast<float>(n.v + v_origin_));
      y = std::clamp(y, -4000.0F, 4000.0F);
    }
    ridge_row_[x] = y;
  }
}

void Panorama::sample_row(int y, std::uint8_t* out) const {
  constexpr float kOne = 65536.0F;
  const auto row = static_cast<float>(y);
  Node left = node_at(0.0F, row);
  for (int x0 = 0; x0 < camera_.width_px; x0 += kCell) {
    const Node right = node_at(static_cast<float>(x0 + kCell), row);
    auto u = static_cast<std::uint32_t>(left.u * kOne);
    auto v = static_cast<std::uint32_t>(left.v * kOne);
    const auto du = static_cast<std::uint32_t>(std::lround((right.u - left.u) * (kOne / kCell)));
    const auto dv = static_cast<std::uint32_t>(std::lround((right.v - left.v) * (kOne / kCell)));
    const int end = std::min(x0 + kCell, camera_.width_px);
    for (int x = x0; x < end; ++x, u += du, v += dv) {
      // Bilinear; the two rows are interpolated side by side in the halves of one word.
      const std::uint8_t* p = slopes_.data + (v >> 16) * slopes_.step + (u >> 16);
      const std::uint8_t* q = p + slopes_.step;
      const std::uint32_t a = (u >> 8) & 255, b = (v >> 8) & 255;
      const std::uint32_t rows =
          (p[0] | std::uint32_t{q[0]} << 16) * (256 - a) + (p[1] | std::uint32_t{q[1]} << 16) * a;
      out[x] = static_cast<std::uint8_t>(((rows & 0xffff) * (256 - b) + (rows >> 16) * b) >> 16);
    }
    left = right;
  }
}

void Panorama::blend_row(int y, const std::uint8_t* in, std::uint8_t* out) const {
  for (int x = 0; x < camera_.width_px; ++x) {
    const float covered = std::clamp(
        static_cast<float>(y) - ridge_row_[static_cast<std::size_t>(x)] + 0.5F, 0.0F, 1.0F);
    const auto weight = static_cast<int>(256.0F * covered);
    out[x] = static_cast<std::uint8_t>((out[x] * (256 - weight) + in[x] * weight + 128) >> 8);
  }
}

void Panorama::draw_slopes(int first, int pure, cv::Mat& gray) const {
  std::vector<std::uint8_t> slopes(static_cast<std::size_t>(gray.cols));
  for (int y = first; y < pure; ++y) {
    sample_row(y, slopes.data());
    blend_row(y, slopes.data(), gray.ptr(y));
  }
  for (int y = pure; y < gray.rows; ++y) sample_row(y, gray.ptr(y));
}

}  // namespace ols::sim
