#include "sim/lockstep/outside_cue.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "sim/scenario/seeds.h"

namespace ols::sim {
namespace {

constexpr double kStep_s = 0.02, kAgain_s = 0.2;
constexpr std::uint64_t kCueTag = 7000;
constexpr double kUnknownVelocity_sd_m_s = 15.0;

std::int64_t utime_us(double time_s) {
  return Lockstep::kStartUtime_us + std::llround(1e6 * time_s);
}

// What a receiver of others' data knows, and says again until it knows more.
class Source {
 public:
  Source(const World& world, const OutsideCueConfig& config)
      : world_(world), config_(config), generator_(derived_seed(world.seed(), kCueTag)) {}

  fusion::Cue at(double time_s) {
    if (time_s - config_.delay_s >= known_s_ + config_.report_s || cue_.id.empty()) {
      know(time_s - config_.delay_s);
    }
    cue_.utime_us = utime_us(time_s);
    return cue_;
  }

 private:
  void know(double time_s) {
    known_s_ = time_s;
    const auto truth = world_.target(0, time_s);
    std::normal_distribution<double> normal;
    const auto noise = [&](double sd) {
      const double x = normal(generator_), y = normal(generator_), z = normal(generator_);
      return Eigen::Vector3d(sd * x, sd * y, sd * z);
    };
    cue_.id = "outside.target";
    cue_.state_us = utime_us(time_s);
    cue_.place = geodetic_from_ecef(truth.p_ecef + noise(config_.sd_m));
    cue_.horizontal_sd_m = cue_.vertical_sd_m = config_.sd_m;
    cue_.velocity_sd_m_s = kUnknownVelocity_sd_m_s;
    if (!config_.with_velocity) return;
    cue_.velocity_enu_m_s =
        R_ecef_enu(cue_.place).transpose() * truth.v_ecef + noise(config_.velocity_sd_m_s);
    cue_.velocity_sd_m_s = config_.velocity_sd_m_s;
  }

  const World& world_;
  const OutsideCueConfig& config_;
  std::mt19937_64 generator_;
  fusion::Cue cue_;
  double known_s_ = 0.0;
};

}  // namespace

LeadTimes cue_from_outside(const Scenario& scenario, std::uint64_t seed,
                           const OutsideCueConfig& config) {
  const World world(later(scenario, config.elapsed_s), seed);
  Lockstep lockstep(world, nobody_designates(scenario));
  Source source(world, config);
  LeadTimes times;
  times.stations = static_cast<std::size_t>(
      std::ranges::count(scenario.stations, false, &StationScenario::overview));
  double due_s = 1.0;
  bool is_allowed = false;
  for (double time_s = due_s; time_s <= config.given_s + config.patience_s && !times.complete();
       time_s += kStep_s) {
    lockstep.run(time_s);
    if (time_s >= due_s) {
      lockstep.hear(source.at(time_s), time_s);
      due_s += kAgain_s;
    }
    if (time_s < config.given_s) continue;
    if (!is_allowed) is_allowed = lockstep.allow_cue("outside.target");
    for (const StationScenario& station : scenario.stations) {
      if (!station.overview) note(times, lockstep, station.id, time_s - config.given_s);
    }
    note_position(times, lockstep, time_s - config.given_s);
  }
  return times;
}

}  // namespace ols::sim
