// An ONVIF camera with pan and tilt as a mount, kept connected by its own thread. It needs no
// homing: its positions are believed as reported.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "edge/mount/mount.h"
#include "edge/mount/onvif/onvif_config.h"

namespace ols::onvif {

class OnvifMount : public mount::Mount {
 public:
  // Starts to connect and returns at once.
  explicit OnvifMount(const OnvifConfig& config);
  ~OnvifMount() override;  // orders a stop, and waits for the answer, at most for the time-out

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

}  // namespace ols::onvif
