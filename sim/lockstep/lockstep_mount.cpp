#include "sim/lockstep/lockstep_mount.h"

#include "edge/mount/fixed/fixed_mount.h"
#include "edge/ptu/driver.h"
#include "sim/onvif/onvif_in_hand.h"
#include "sim/ptu/unit.h"
#include "sim/scenario/onvif_camera.h"

namespace ols::sim {
namespace {

ptu::PtuConfig driver_config(const World& world) {
  ptu::PtuConfig config;
  config.baud = world.scenario().ptu.baud;
  config.poll_interval_s = world.scenario().ptu.poll_interval_s;
  return config;
}

class DrivenUnit : public LockstepMount {
 public:
  DrivenUnit(const World& world, std::uint64_t seed, double now_s)
      : unit_(world.ptu_unit_config(), seed, now_s), driver_(driver_config(world)) {}

  void advance(double now_s) override {
    // The driver wants the moment of the read: here each byte is read as it arrives.
    for (auto next_s = unit_.next_output_s(); next_s && *next_s <= now_s;
         next_s = unit_.next_output_s()) {
      driver_.receive(unit_.transmit(*next_s), *next_s);
    }
    const std::string request = driver_.step(now_s);
    if (!request.empty()) unit_.receive(request, now_s);
  }
  std::vector<mount::AngleSample> take_samples() override { return driver_.take_samples(); }
  void set_goal(const std::optional<mount::Goal>& goal) override { driver_.set_goal(goal); }
  mount::Reference reference() const override { return driver_.reference(); }
  std::optional<mount::Limits> limits() const override {
    if (driver_.state() != ptu::PtuState::kReady) return std::nullopt;
    return driver_.limits();
  }
  PanTilt angles_at(double time_s) const override { return unit_.angles_at(time_s); }
  std::map<std::string, double> counters() const override {
    const ptu::PtuCounters& ptu = driver_.counters();
    return {{"ptu_requests", static_cast<double>(ptu.requests)},
            {"ptu_replies", static_cast<double>(ptu.replies)},
            {"ptu_timeouts", static_cast<double>(ptu.timeouts)},
            {"ptu_refused_positions", static_cast<double>(ptu.refused_positions)},
            {"ptu_limit_hits", static_cast<double>(ptu.limit_hits)}};
  }

 private:
  PtuUnit unit_;
  ptu::PtuDriver driver_;
};

class OnvifInLockstep : public LockstepMount {
 public:
  OnvifInLockstep(const OnvifConfig& device, std::uint64_t seed, double now_s)
      : in_hand_(device, drive_config(device.unit), seed, now_s) {}

  void advance(double now_s) override { in_hand_.advance(now_s); }
  std::vector<mount::AngleSample> take_samples() override {
    return in_hand_.drive().take_samples();
  }
  void see(const mount::SeenTurn& turn) override { in_hand_.drive().see(turn); }
  void set_goal(const std::optional<mount::Goal>& goal) override {
    in_hand_.drive().set_goal(goal);
  }
  mount::Reference reference() const override { return mount::Reference::kTrusted; }
  std::optional<mount::Limits> limits() const override {
    if (!in_hand_.drive().has_position()) return std::nullopt;
    return in_hand_.drive().limits();
  }
  PanTilt angles_at(double time_s) const override { return in_hand_.angles_at(time_s); }
  std::map<std::string, double> counters() const override {
    const mount::Drive::Counters& seen = in_hand_.drive().counters();
    return {{"ptu_stops_repeated", static_cast<double>(seen.stops_repeated)},
            {"ptu_unordered_motions", static_cast<double>(seen.unordered_motions)},
            {"ptu_unordered_in_picture", static_cast<double>(seen.unordered_in_picture)},
            {"ptu_orders_ignored", static_cast<double>(seen.orders_ignored)}};
  }

 private:
  OnvifInHand in_hand_;
};

class FixedMountInLockstep : public LockstepMount {
 public:
  FixedMountInLockstep(const PanTilt& angles, double now_s) : angles_(angles), now_s_(now_s) {}

  void advance(double now_s) override { now_s_ = now_s; }
  std::vector<mount::AngleSample> take_samples() override {
    auto samples = mount::fixed_samples(angles_, last_s_, now_s_);
    if (!samples.empty()) last_s_ = samples.back().time_s;
    return samples;
  }
  void set_goal(const std::optional<mount::Goal>& /*goal*/) override {}
  mount::Reference reference() const override { return mount::Reference::kTrusted; }
  std::optional<mount::Limits> limits() const override { return mount::fixed_limits(angles_); }
  PanTilt angles_at(double /*time_s*/) const override { return angles_; }
  std::map<std::string, double> counters() const override { return {}; }

 private:
  const PanTilt angles_;
  double now_s_, last_s_ = 0.0;
};

}  // namespace

std::unique_ptr<LockstepMount> make_lockstep_mount(const World& world, std::size_t station,
                                                   std::uint64_t seed, double now_s) {
  const StationScenario& of = world.scenario().stations[station];
  if (of.fixed) return std::make_unique<FixedMountInLockstep>(*of.fixed, now_s);
  if (of.mount == MountModel::kOnvif)
    return std::make_unique<OnvifInLockstep>(onvif_config(world.scenario(), of), seed, now_s);
  return std::make_unique<DrivenUnit>(world, seed, now_s);
}

}  // namespace ols::sim
