// A telescope mount behind an INDI server as a mount, kept connected by its own thread. It has no
// reference to find: its positions are believed as they are reported, as long as it stays on the
// side of its pier.
//
// An INDI telescope keeps its last track rate when its client is gone: a station that is killed
// stops it when it starts again.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "edge/mount/indi/indi_config.h"
#include "edge/mount/mount.h"

namespace ols::indi {

class IndiMount : public mount::Mount {
 public:
  // Starts to connect and returns at once.
  explicit IndiMount(const IndiConfig& config);
  ~IndiMount() override;  // orders a stop, and waits for its answer for a second at most

  void set_goal(const std::optional<mount::Goal>& goal) override;
  std::vector<mount::AngleSample> take_samples() override;
  std::optional<mount::Limits> limits() const override;

  void emergency_halt() override;
  void clear_emergency() override;

  mount::Reference reference() const override;
  void home() override {}
  void stop_homing() override {}
  void allow_rehoming(bool /*allowed*/) override {}
  std::uint64_t homings() const override { return 0; }
  void reference_ok() override {}
  void restore_doubt(const std::optional<mount::ReferenceDoubt>& /*doubt*/) override {}
  std::optional<mount::ReferenceDoubt> doubt_to_persist() const override { return std::nullopt; }

  device::DeviceReport report() const override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ols::indi
