// A mount that never moves: its angles are constant, and it ignores all orders. The station refuses
// orders to move and states the reason, because Traits::moves is false.
#pragma once

#include <atomic>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "edge/mount/mount.h"

namespace ols::mount {

struct FixedMountConfig {
  PanTilt angles;
};

Limits fixed_limits(const PanTilt& angles);
std::string fixed_words(const PanTilt& angles);  // "fixed at pan 10.00, tilt 5.00 deg"
// The samples after `last_s` until `now_s`, twenty per second, but only those of the last second.
std::vector<AngleSample> fixed_samples(const PanTilt& angles, double last_s, double now_s);

class FixedMount : public Mount {
 public:
  explicit FixedMount(const FixedMountConfig& config) : config_(config) {}

  void set_goal(const std::optional<Goal>& /*goal*/) override {}
  std::vector<AngleSample> take_samples() override;
  std::optional<Limits> limits() const override { return fixed_limits(config_.angles); }

  void emergency_halt() override {}
  void clear_emergency() override {}

  Reference reference() const override { return Reference::kTrusted; }
  void home() override {}
  void stop_homing() override {}
  void allow_rehoming(bool /*allowed*/) override {}
  std::uint64_t homings() const override { return 0; }
  void reference_ok() override {}
  void restore_doubt(const std::optional<ReferenceDoubt>& /*doubt*/) override {}
  std::optional<ReferenceDoubt> doubt_to_persist() const override { return std::nullopt; }

  device::DeviceReport report() const override;

 private:
  const FixedMountConfig config_;
  std::atomic<double> last_s_ = -std::numeric_limits<double>::infinity();
};

}  // namespace ols::mount
