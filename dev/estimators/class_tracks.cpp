#include "dev/estimators/class_tracks.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ols::bench {
namespace {

constexpr int kImageHz = 20, kImagesALook = 5;

struct Range {
  double least, most;
};

// How one kind is built and moves. Sizes are largest extents.
struct Habit {
  Range size_m;
  double still;          // share of the time in which it hovers or stands
  Range speed_m_s;       // otherwise
  double climbing;       // share of the time in which it climbs or descends
  Range climb_m_s;       // then; otherwise within a twentieth of its speed, at most 0.5 m/s
  Range across_m_s2;     // when it turns, half of the time
  double beating;        // share of the time in which its outline beats or sways
  Range depth, beat_hz;  // share of each side of the outline that this takes away
  Range height_m;        // above the ground; all orders of magnitude are alike
};

// Sources. Drones: makers' data from DJI Mini (0.3 m with rotors) to Matrice 350 (1.5 m), 15 to 23
// m/s, climb 5 to 8 m/s. Birds: Alerstam et al., "Flight speeds among bird species" (2007): 8 to 23
// m/s; Pennycuick, "Wingbeat frequency of birds in steady cruising flight" (1996): 2 to 15 Hz; wing
// spans of starling (0.4 m) to white stork (2.0 m); circling at 15 to 40 m radius. Aeroplanes: span
// 10 m (ultralight) to 65 m (Boeing 777), 35 to 250 m/s. Helicopters: rotor 8 m (R22) to 21 m
// (Mi-8), to 75 m/s. Meteors: 11 to 72 km/s at entry; the streak of a fiftieth of a second. A drone
// tilts by some 0.15 rad in gusts, at 0.2 to 0.8 Hz: the simulator's drawings change so much then.
// Drones and birds share the lowest 2000 m, so that the height says nothing between them.
constexpr std::array<Habit, kSimulatedKinds.size()> kHabits = {{
    {{0.3, 1.5}, 0.3, {2, 20}, 0.3, {-5, 7}, {0.5, 6}, 0.7, {0, 0.15}, {0.2, 0.8}, {2, 2000}},
    {{0.35, 2.0}, 0.0, {7, 20}, 0.3, {-3, 3}, {1, 8}, 0.75, {0.2, 0.6}, {2, 9}, {2, 2000}},
    {{10, 65}, 0.0, {35, 250}, 0.4, {-12, 15}, {1, 6}, 0.0, {0, 0}, {1, 1}, {60, 11e3}},
    {{8, 21}, 0.15, {15, 75}, 0.3, {-7, 8}, {0.5, 5}, 0.0, {0, 0}, {1, 1}, {20, 1500}},
    {{1.5, 1.95}, 0.3, {0.7, 4}, 0.0, {0, 0}, {0, 1}, 0.7, {0.05, 0.2}, {1.5, 3}, {1, 1}},
    {{3.5, 18}, 0.1, {3, 37}, 0.0, {0, 0}, {0.3, 3}, 0.0, {0, 0}, {1, 1}, {1, 1}},
    {{200, 1400}, 0.0, {8e3, 65e3}, 1.0, {-40e3, -3e3}, {0, 10}, 0.0, {0, 0}, {1, 1}, {7e4, 1.2e5}},
}};

class Object {
 public:
  Object(int kind, std::mt19937_64& random) : habit_(kHabits[kind]), random_(random) {
    size_m_ = std::exp(within({std::log(habit_.size_m.least), std::log(habit_.size_m.most)}));
    beat_hz_ = within(habit_.beat_hz);
    depth_ = within(habit_.depth);
    across_depth_ = within(habit_.depth);
    aspect_ = within({0, 2 * std::numbers::pi});
    cruise_m_s_ = within(habit_.speed_m_s);
    heading_ = within({0, 2 * std::numbers::pi});
    height_m_ = std::exp(within({std::log(habit_.height_m.least), std::log(habit_.height_m.most)}));
    choose();
    speed_ = wanted_speed_, climb_ = wanted_climb_;
  }

  void step(double dt_s) {
    if (chance(dt_s / 6.0)) choose();
    if (chance(dt_s / 3.0)) beats_ = chance(habit_.beating);
    speed_ += (wanted_speed_ - speed_) * dt_s / 1.5;
    climb_ += (wanted_climb_ - climb_) * dt_s / 1.5;
    heading_ += dt_s * across_ / std::max(speed_, 1.0);
    aspect_ += 0.3 * dt_s + dt_s * across_ / std::max(speed_, 1.0);
    if (beats_) phase_ += 2 * std::numbers::pi * beat_hz_ * dt_s;
  }

  // East, north, up.
  std::array<double, 3> velocity() const {
    return {speed_ * std::cos(heading_), speed_ * std::sin(heading_), climb_};
  }
  // Seen from the side at a changing aspect: at least 0.7 of the largest extent.
  double size_m() const { return size_m_ * beat(depth_) * (0.85 + 0.15 * std::cos(aspect_)); }
  double height_m() const { return height_m_; }
  // The smaller side.
  double across_m() const { return 0.4 * size_m_ * beat(across_depth_); }

 private:
  double within(Range range) {
    return std::uniform_real_distribution<double>(range.least, range.most)(random_);
  }
  bool chance(double share) { return within({0.0, 1.0}) < share; }
  double beat(double depth) const {
    return beats_ ? 1.0 - depth * (0.5 + 0.5 * std::sin(phase_)) : 1.0;
  }

  void choose() {
    const double usual =
        std::clamp(cruise_m_s_ * within({0.7, 1.2}), habit_.speed_m_s.least, habit_.speed_m_s.most);
    wanted_speed_ = chance(habit_.still) ? within({0.0, 0.5}) : usual;
    const double level = std::min(0.5, wanted_speed_ / 20.0);
    wanted_climb_ = chance(habit_.climbing) ? within(habit_.climb_m_s) : within({-level, level});
    const double side = chance(0.5) ? 1.0 : -1.0;
    const bool turns = wanted_speed_ > 1.0 && chance(0.5);
    across_ = turns ? side * within(habit_.across_m_s2) : 0.0;
    beats_ = chance(habit_.beating);
  }

  const Habit& habit_;
  std::mt19937_64& random_;
  double size_m_, beat_hz_, depth_, across_depth_, aspect_, height_m_, cruise_m_s_, heading_;
  double wanted_speed_ = 0.0, wanted_climb_ = 0.0, across_ = 0.0, speed_ = 0.0, climb_ = 0.0;
  double phase_ = 0.0;
  bool beats_ = false;
};

}  // namespace

std::vector<TimedLook> simulate_looks(int kind, double duration_s, const LookNoise& noise,
                                      std::mt19937_64& random) {
  constexpr double kDt_s = 1.0 / kImageHz;
  Object object(kind, random);
  std::normal_distribution<double> normal;
  const double scale = std::exp(noise.size_bias * normal(random));
  const double ground_m = noise.ground_m * normal(random);
  std::array<double, 3> error{};
  for (double& axis : error) axis = noise.speed_m_s * normal(random);
  std::vector<fusion::SeenSize> sizes;
  std::vector<std::array<double, 3>> velocities;
  std::vector<TimedLook> looks;
  for (int image = 1; image <= duration_s * kImageHz; ++image) {
    object.step(kDt_s);
    auto v = object.velocity();
    for (int axis = 0; axis < 3; ++axis) {
      error[axis] +=
          -error[axis] * kDt_s + noise.speed_m_s * std::sqrt(2.0 * kDt_s) * normal(random);
      v[axis] += error[axis];
    }
    velocities.push_back(v);
    const double size_m = scale * object.size_m();
    const double sd_m = std::max(size_m * noise.size, 1e-6);  // 0 would be unknown
    sizes.push_back({size_m + sd_m * normal(random), sd_m, sd_m,
                     scale * object.across_m() * (1.0 + sd_m / size_m * normal(random)),
                     image * kDt_s});
    if (image % kImagesALook != 0 || image <= kImageHz) continue;
    looks.push_back({image * 1'000'000LL / kImageHz,
                     fusion::look_at({{sizes.end() - kImageHz, sizes.end()}}, v,
                                     velocities[velocities.size() - 1 - kImageHz], 1.0,
                                     std::max(noise.speed_m_s, 1e-6))});
    looks.back().look.height_m = {object.height_m() + ground_m, std::max(noise.ground_m, 1e-6)};
  }
  return looks;
}

}  // namespace ols::bench
