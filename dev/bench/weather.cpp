#include "dev/bench/weather.h"

#include <GeographicLib/Constants.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <random>

#include "edge/tracker/random.h"
#include "sim/world/texture.h"

namespace ols::bench {
namespace {

using tracker::Random;

constexpr double kPi = std::numbers::pi;
constexpr double kPx_rad = 75e-6;
constexpr double kLens_px = 0.9;  // standard deviation of the lens's blur

double between(Random& random, double low, double high) {
  return low + (high - low) * random.uniform();
}
// The logarithm is uniform.
double of_size(Random& random, double low, double high) {
  return low * std::pow(high / low, random.uniform());
}
int poisson(Random& random, double mean) {
  const double least = std::exp(-std::min(mean, 500.0));
  int count = 0;
  for (double product = random.uniform(); product > least; product *= random.uniform()) ++count;
  return count;
}
cv::Vec2d of_length(double length, double direction) {
  return {length * std::cos(direction), length * std::sin(direction)};
}

// A picture-sized part of a periodic texture, whose corner is at (x, y).
void cut(const cv::Mat1f& texture, cv::Vec2d corner, cv::Mat1f& part) {
  for (int axis = 0; axis < 2; ++axis) {
    const double side = axis == 0 ? texture.cols : texture.rows;
    corner[axis] -= side * std::floor(corner[axis] / side);
  }
  const cv::Matx23d to_texture(1, 0, corner[0], 0, 1, corner[1]);
  cv::warpAffine(texture, part, to_texture, part.size(), cv::INTER_LINEAR | cv::WARP_INVERSE_MAP,
                 cv::BORDER_WRAP);
}

// A thing that is out of focus, or a streak: a bell drawn out along its path.
struct Smear {
  cv::Vec2d at_px;          // its middle
  cv::Vec2d path_px;        // during the exposure
  double sd_px = kLens_px;  // of the bell
  double levels = 0.0;      // at its middle
};

void draw(cv::Mat1f& picture, const Smear& smear) {
  const double half = 0.5 * cv::norm(smear.path_px), reach = 3.0 * smear.sd_px;
  const cv::Vec2d along = half > 0.0 ? smear.path_px * (0.5 / half) : cv::Vec2d(1.0, 0.0);
  const double wide = half * std::abs(along[0]) + reach, high = half * std::abs(along[1]) + reach;
  const int left = std::max(0, static_cast<int>(std::ceil(smear.at_px[0] - wide)));
  const int right = std::min(picture.cols - 1, static_cast<int>(std::floor(smear.at_px[0] + wide)));
  const int top = std::max(0, static_cast<int>(std::ceil(smear.at_px[1] - high)));
  const int bottom =
      std::min(picture.rows - 1, static_cast<int>(std::floor(smear.at_px[1] + high)));
  const double scale = -0.5 / (smear.sd_px * smear.sd_px);
  for (int y = top; y <= bottom; ++y) {
    float* row = picture[y];
    const double down = y - smear.at_px[1];
    for (int x = left; x <= right; ++x) {
      const double across = x - smear.at_px[0];
      const double way = std::clamp(across * along[0] + down * along[1], -half, half);
      const double off_x = across - way * along[0], off_y = down - way * along[1];
      row[x] +=
          static_cast<float>(smear.levels * std::exp(scale * (off_x * off_x + off_y * off_y)));
    }
  }
}

// The blank sky, brighter towards one side.
cv::Mat1f gradient(const cv::Size& size, double level, double slope, double direction) {
  cv::Mat1f sky(size);
  const cv::Vec2d along = of_length(slope / size.width, direction);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x)
      sky(y, x) = static_cast<float>(level + along[0] * x + along[1] * y);
  }
  return sky;
}

cv::Mat1f woodland(const cv::Size& size, std::mt19937_64& generator) {
  const cv::Mat wood = sim::wood(1024, generator);
  const cv::Rect part((wood.cols - size.width) / 2, (wood.rows - size.height) / 2, size.width,
                      size.height);
  cv::Mat1f ground;
  wood(part).convertTo(ground, CV_32F);
  return ground;
}

// Broken clouds and the blue between them. Their optical depth falls to 0.55 from octave to octave,
// as turbulence along a line of sight has it. The parts drift at velocities that differ by a few
// per cent, so that edges form and dissolve: what is 15 px wide lasts for some seconds.
class Clouds : public Weather {
 public:
  Clouds(const cv::Size& size, std::uint64_t seed)
      : random_(seed), picture_(size), coarse_(size / kReduced), fine_(size) {
    std::mt19937_64 generator(seed);
    sky_ = gradient(size, between(random_, 60, 160), between(random_, -30, 30),
                    2.0 * kPi * random_.uniform());
    contrast_ = between(random_, 20, 80);
    cover_ = between(random_, -0.8, 0.8);
    steepness_ = of_size(random_, 1.0, 8.0);
    const double wind_px_s = of_size(random_, 1.0, 30.0), direction = 2.0 * kPi * random_.uniform();
    for (Layer& layer : coarse_layers_) {
      layer.texture = sim::fractal_noise({512, 512}, 128, 8, kRoughness, generator);
      layer.velocity_px_s = of_length(wind_px_s * between(random_, 0.95, 1.05) / kReduced,
                                      direction + between(random_, -0.05, 0.05));
    }
    for (Layer& layer : fine_layers_) {
      layer.texture = sim::fractal_noise({1024, 1024}, 16, 8, kRoughness, generator);
      layer.velocity_px_s = of_length(wind_px_s * between(random_, 0.95, 1.05),
                                      direction + between(random_, -0.05, 0.05));
    }
  }

  const cv::Mat1f& next(double interval_s) override {
    cv::Mat1f field = sum(coarse_layers_, coarse_, interval_s), large;
    cv::resize(field, large, picture_.size(), 0, 0, cv::INTER_CUBIC);
    constexpr double kFine = 0.06;  // of the coarse part's deviation
    cv::scaleAdd(sum(fine_layers_, fine_, interval_s), kFine, large, field);
    // A smooth step from the blue to the cloud.
    field.convertTo(field, CV_32F, 0.25 * steepness_, 0.5 + 0.25 * steepness_ * cover_);
    cv::min(cv::max(field, 0.0F), 1.0F, field);
    cv::Mat1f square = field.mul(field);
    field.convertTo(field, CV_32F, -2.0, 3.0);
    cv::multiply(field, square, square);
    cv::scaleAdd(square, contrast_, sky_, picture_);
    return picture_;
  }

 private:
  static constexpr int kReduced = 4;
  static constexpr double kRoughness = 0.55;
  struct Layer {
    cv::Mat1f texture;
    cv::Vec2d velocity_px_s, corner;
  };
  static cv::Mat1f sum(std::array<Layer, 2>& layers, cv::Mat1f& part, double interval_s) {
    cv::Mat1f total(part.size(), 0.0F);
    for (Layer& layer : layers) {
      layer.corner -= interval_s * layer.velocity_px_s;
      cut(layer.texture, layer.corner, part);
      cv::scaleAdd(part, std::numbers::sqrt2 / 2.0, total, total);
    }
    return total;
  }

  Random random_;
  cv::Mat1f picture_, coarse_, fine_, sky_;
  std::array<Layer, 2> coarse_layers_, fine_layers_;
  double contrast_ = 0.0, cover_ = 0.0, steepness_ = 0.0;
};

// Pushed by noise, it swings at about its own frequency. Of unit variance.
class Swing {
 public:
  Swing(Random& random, double frequency_hz)
      : rate_(2.0 * kPi * frequency_hz), place_(random.gaussian()), speed_(random.gaussian()) {}
  double next(Random& random, double interval_s) {
    constexpr double kDamping = 0.15;  // of the critical one
    const double kept = std::exp(-kDamping * rate_ * interval_s), angle = rate_ * interval_s;
    const double pushed = std::sqrt(1.0 - kept * kept);
    const double place = kept * (place_ * std::cos(angle) + speed_ * std::sin(angle));
    speed_ =
        kept * (speed_ * std::cos(angle) - place_ * std::sin(angle)) + pushed * random.gaussian();
    return place_ = place + pushed * random.gaussian();
  }

 private:
  double rate_;  // [rad/s]
  double place_, speed_;
};

// A wood whose branches swing and whose leaves flutter, in gusts; in every second watch with the
// sky above its tops.
class Foliage : public Weather {
 public:
  Foliage(const cv::Size& size, std::uint64_t seed)
      : random_(seed), picture_(size), map_x_(size), map_y_(size) {
    std::mt19937_64 generator(seed);
    wood_ = woodland(size + cv::Size(2 * kMargin, 2 * kMargin), generator);
    if (random_.uniform() < 0.5) add_sky(generator);
    cv::GaussianBlur(wood_, wood_, {}, 0.7);
    reach_px_ = of_size(random_, 0.5, 5.0);
    flutter_ = of_size(random_, 1.0, 8.0);
    const cv::Size nodes(size.width / 16, size.height / 16);
    for (std::size_t i = 0; i < kBranches; ++i) {
      branches_.emplace_back(random_, between(random_, 0.2, 1.2));
      for (auto* field : {&across_, &down_})
        field->push_back(sim::fractal_noise(nodes, 8, 2.5, 0.6, generator));
    }
    for (std::size_t i = 0; i < kLeaves; ++i) {
      leaves_.emplace_back(random_, between(random_, 1.5, 4.0));
      glints_.push_back(sim::fractal_noise(size, 12, 4, 0.9, generator));
    }
  }

  const cv::Mat1f& next(double interval_s) override {
    const double strength = std::exp(0.5 * gusts_.next(random_, interval_s));
    cv::Mat1f x(across_[0].size(), 0.0F), y(across_[0].size(), 0.0F);
    for (std::size_t i = 0; i < kBranches; ++i) {
      const double swing = branches_[i].next(random_, interval_s) * reach_px_ * strength / 2.0;
      cv::scaleAdd(across_[i], swing, x, x);
      cv::scaleAdd(down_[i], 0.6 * swing, y, y);
    }
    cv::resize(x, map_x_, picture_.size(), 0, 0, cv::INTER_LINEAR);
    cv::resize(y, map_y_, picture_.size(), 0, 0, cv::INTER_LINEAR);
    for (int row = 0; row < picture_.rows; ++row) {
      for (int column = 0; column < picture_.cols; ++column) {
        map_x_(row, column) += static_cast<float>(column + kMargin);
        map_y_(row, column) += static_cast<float>(row + kMargin);
      }
    }
    cv::remap(wood_, picture_, map_x_, map_y_, cv::INTER_LINEAR, cv::BORDER_REFLECT);
    for (std::size_t i = 0; i < kLeaves; ++i) {
      const double levels = leaves_[i].next(random_, interval_s) * flutter_ * strength / 2.0;
      cv::scaleAdd(glints_[i], levels, picture_, picture_);
    }
    return picture_;
  }

 private:
  static constexpr int kMargin = 32;
  static constexpr std::size_t kBranches = 6, kLeaves = 4;
  void add_sky(std::mt19937_64& generator) {
    const std::vector<float> tops = sim::tree_tops(wood_.cols, generator);
    const double ridge = wood_.rows * between(random_, 0.2, 0.5);
    for (int x = 0; x < wood_.cols; ++x) {
      const int top = static_cast<int>(ridge - tops[static_cast<std::size_t>(x)]);
      if (top > 0) wood_(cv::Rect(x, 0, 1, top)).setTo(180.0F);
    }
  }

  Random random_;
  cv::Mat1f picture_, wood_, map_x_, map_y_;
  double reach_px_ = 0.0, flutter_ = 0.0;
  Swing gusts_{random_, 0.05};
  std::vector<Swing> branches_, leaves_;
  std::vector<cv::Mat1f> across_, down_, glints_;
};

// Rain and insects between the camera and a sky or a wood at rest.
class RainAndInsects : public Weather {
 public:
  RainAndInsects(const cv::Size& size, std::uint64_t seed, bool before_sky)
      : random_(seed), picture_(size) {
    std::mt19937_64 generator(seed);
    if (before_sky) {
      behind_ = gradient(size, between(random_, 60, 180), between(random_, -30, 30),
                         2.0 * kPi * random_.uniform());
    } else {
      behind_ = woodland(size, generator);
    }
    aperture_m_ = between(random_, 0.006, 0.018);
    exposure_s_ = of_size(random_, 0.001, 0.010);
    slant_ = kPi / 2.0 + between(random_, -0.3, 0.3);
    drops_ = of_size(random_, 2.0, 200.0);
    insects_s_ = of_size(random_, 0.02, 1.0);
    if (random_.uniform() < 0.5) drops_ = 0.0;
    if (random_.uniform() < 0.25) add_swarm();
  }

  const cv::Mat1f& next(double interval_s) override {
    behind_.copyTo(picture_);
    const double strength = std::exp(0.5 * showers_.next(random_, interval_s));
    for (int count = poisson(random_, drops_ * strength); count > 0; --count) draw_drop();
    for (int count = poisson(random_, insects_s_ * interval_s); count > 0; --count) add_insect();
    for (Insect& insect : insects_) fly(insect, interval_s);
    std::erase_if(insects_, [this](const Insect& insect) { return is_gone(insect); });
    return picture_;
  }

 private:
  struct Insect {
    cv::Vec2d at_px;
    double distance_m, size_m, speed_m_s, heading, turning_rad_s, levels;
    std::optional<cv::Vec2d> home_px;  // of a swarm
  };

  double blur_px(double distance_m) const {
    // A disc's standard deviation is a quarter of its width.
    return std::hypot(kLens_px, 0.25 * aperture_m_ / distance_m / kPx_rad);
  }
  // The share of a thing's contrast that is left after its light is spread over the disc.
  double seen(double size_m, double distance_m) const {
    const double side_px = size_m / distance_m / kPx_rad;
    return std::min(1.0, side_px * side_px / (12.0 * std::pow(blur_px(distance_m), 2)));
  }

  // Falls at 8 m/s, so that one picture shows it, or two.
  void draw_drop() {
    constexpr double kNear_m = 3.0, kFar_m = 40.0, kSpeed_m_s = 8.0;
    const double distance_m =
        kFar_m * std::cbrt(between(random_, std::pow(kNear_m / kFar_m, 3), 1));
    const double size_m = of_size(random_, 0.001, 0.004);
    const double streak_px = kSpeed_m_s * exposure_s_ / distance_m / kPx_rad;
    Smear smear;
    smear.at_px = {random_.uniform() * picture_.cols, random_.uniform() * picture_.rows};
    smear.path_px = of_length(streak_px, slant_ + 0.05 * random_.gaussian());
    smear.sd_px = blur_px(distance_m);
    constexpr double kGlint = 150.0;  // [grey levels]: a drop refracts the bright sky
    smear.levels =
        kGlint * seen(size_m, distance_m) / std::max(1.0, streak_px / (2.5 * smear.sd_px));
    if (smear.levels > 0.2) draw(picture_, smear);
  }

  Insect insect_at(const cv::Vec2d& at_px, double distance_m) {
    return {at_px,
            distance_m,
            of_size(random_, 0.002, 0.012),
            of_size(random_, 0.4, 4.0),
            2.0 * kPi * random_.uniform(),
            of_size(random_, 1.0, 10.0),
            between(random_, -100.0, 60.0),
            std::nullopt};
  }
  // Enters at an edge, or from near.
  void add_insect() {
    const cv::Vec2d at_px(random_.uniform() * picture_.cols, random_.uniform() * picture_.rows);
    insects_.push_back(insect_at(at_px, of_size(random_, 2.0, 40.0)));
    if (random_.uniform() < 0.5) return;
    Insect& insect = insects_.back();
    const double edge = std::floor(4.0 * random_.uniform());
    if (edge < 2.0) insect.at_px[0] = edge * picture_.cols;
    if (edge >= 2.0) insect.at_px[1] = (edge - 2.0) * picture_.rows;
  }
  void add_swarm() {
    const double distance_m = between(random_, 8.0, 30.0);
    const cv::Vec2d home(picture_.cols * between(random_, 0.2, 0.8),
                         picture_.rows * between(random_, 0.2, 0.8));
    for (int count = 3 + poisson(random_, 8.0); count > 0; --count) {
      Insect midge = insect_at(home, distance_m);
      midge.size_m = of_size(random_, 0.002, 0.004);
      midge.speed_m_s = between(random_, 0.3, 1.0);
      midge.home_px = home;
      insects_.push_back(midge);
    }
  }
  void fly(Insect& insect, double interval_s) {
    const double px_m = 1.0 / (insect.distance_m * kPx_rad);
    insect.heading += insect.turning_rad_s * std::sqrt(interval_s) * random_.gaussian();
    if (insect.home_px) {
      // Turns back to the swarm.
      const cv::Vec2d off = *insect.home_px - insect.at_px;
      const double far = cv::norm(off) / (0.3 * px_m);
      if (far > 1.0) insect.heading = std::atan2(off[1], off[0]) + 0.5 * random_.gaussian();
    }
    const cv::Vec2d velocity = of_length(insect.speed_m_s * px_m, insect.heading);
    insect.at_px += interval_s * velocity;
    Smear smear{insect.at_px, exposure_s_ * velocity, blur_px(insect.distance_m), 0.0};
    smear.levels = insect.levels * seen(insect.size_m, insect.distance_m) /
                   std::max(1.0, cv::norm(smear.path_px) / (2.5 * smear.sd_px));
    draw(picture_, smear);
  }
  bool is_gone(const Insect& insect) const {
    constexpr double kMargin_px = 100.0;
    if (insect.home_px) return false;
    return insect.at_px[0] < -kMargin_px || insect.at_px[1] < -kMargin_px ||
           insect.at_px[0] > picture_.cols + kMargin_px ||
           insect.at_px[1] > picture_.rows + kMargin_px;
  }

  Random random_;
  cv::Mat1f picture_, behind_;
  double aperture_m_ = 0.0, exposure_s_ = 0.0, slant_ = 0.0;
  double drops_ = 0.0;      // in a picture
  double insects_s_ = 0.0;  // [1/s] that come
  Swing showers_{random_, 0.02};
  std::vector<Insect> insects_;
};

// Stars that twinkle and drift by the earth's rotation, and a sensor with defects.
class Stars : public Weather {
 public:
  Stars(const cv::Size& size, std::uint64_t seed) : random_(seed), picture_(size) {
    sky_ = gradient(size, between(random_, 8, 25), between(random_, 0, 6),
                    2.0 * kPi * random_.uniform());
    drift_px_s_ =
        of_length(GeographicLib::Constants::WGS84_omega() / kPx_rad * between(random_, 0.2, 1.0),
                  2.0 * kPi * random_.uniform());
    twinkling_ = of_size(random_, 0.05, 0.4);
    const int count = poisson(random_, of_size(random_, 5.0, 60.0));
    for (int i = 0; i < count; ++i) {
      const cv::Vec2d at(random_.uniform() * field().width, random_.uniform() * field().height);
      stars_.push_back({at, brightness()});
    }
    for (int i = 0; i < 30; ++i) {
      const cv::Point at(static_cast<int>(random_.uniform() * size.width),
                         static_cast<int>(random_.uniform() * size.height));
      sky_(at) += static_cast<float>(of_size(random_, 3.0, 100.0));
    }
  }

  const cv::Mat1f& next(double interval_s) override {
    sky_.copyTo(picture_);
    for (Star& star : stars_) {
      star.at_px += interval_s * drift_px_s_;
      enter_again(star);
      const double levels = star.levels * std::exp(twinkling_ * random_.gaussian());
      draw(picture_, {star.at_px - cv::Vec2d(kMargin_px, kMargin_px), {}, kLens_px, levels});
    }
    return picture_;
  }
  std::optional<Eigen::Vector2d> star_drift_px_s() const override {
    return Eigen::Vector2d(drift_px_s_[0], drift_px_s_[1]);
  }

 private:
  static constexpr double kMargin_px = 8.0;
  struct Star {
    cv::Vec2d at_px;  // in a field with a margin around the picture
    double levels;    // of its peak
  };
  cv::Size2d field() const {
    return {picture_.cols + 2.0 * kMargin_px, picture_.rows + 2.0 * kMargin_px};
  }
  // Three times as many stars for each magnitude; the faintest are lost in the noise.
  double brightness() { return std::min(400.0, 3.0 * std::pow(1.0 - random_.uniform(), -0.8)); }
  // Another star enters on the other side.
  void enter_again(Star& star) {
    for (int axis = 0; axis < 2; ++axis) {
      const double side = axis == 0 ? field().width : field().height;
      const double other = axis == 0 ? field().height : field().width;
      if (star.at_px[axis] >= 0.0 && star.at_px[axis] < side) continue;
      star.at_px[axis] -= side * std::floor(star.at_px[axis] / side);
      star.at_px[1 - axis] = random_.uniform() * other;
      star.levels = brightness();
    }
  }

  Random random_;
  cv::Mat1f picture_, sky_;
  cv::Vec2d drift_px_s_;
  double twinkling_ = 0.0;
  std::vector<Star> stars_;
};

// A sky without anything.
class Blank : public Weather {
 public:
  Blank(const cv::Size& size, std::uint64_t seed) {
    Random random(seed);
    sky_ = gradient(size, between(random, 60, 180), between(random, -30, 30),
                    2.0 * kPi * random.uniform());
  }
  const cv::Mat1f& next(double /*interval_s*/) override { return sky_; }

 private:
  cv::Mat1f sky_;
};

template <class Kind>
std::unique_ptr<Weather> make(const cv::Size& picture, std::uint64_t seed) {
  return std::make_unique<Kind>(picture, seed);
}

}  // namespace

const std::vector<WeatherKind>& weather_kinds() {
  const auto rain = [](bool before_sky) {
    return [before_sky](const cv::Size& size, std::uint64_t seed) {
      return std::make_unique<RainAndInsects>(size, seed, before_sky);
    };
  };
  static const std::vector<WeatherKind> kinds{
      {"blank", true, make<Blank>},        {"clouds", true, make<Clouds>},
      {"stars", true, make<Stars>},        {"rain-sky", true, rain(true)},
      {"rain-ground", false, rain(false)}, {"foliage", false, make<Foliage>}};
  return kinds;
}

}  // namespace ols::bench
