// A session with a telescope mount behind an INDI server. The reported positions are used as they
// are, without a model of the telescope's errors, but only while the telescope stays on its side of
// the pier.
//
// An INDI telescope continues at its last track rate when its client is gone. If the station's
// program is killed, the telescope therefore moves on; the program stops it at its next start.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "edge/mount/driven/driven_mount.h"
#include "edge/mount/indi/indi_config.h"
#include "edge/mount/indi/indi_link.h"

namespace ols::indi {

class IndiSession : public mount::MountSession {
 public:
  explicit IndiSession(IndiConfig config)
      : config_(std::move(config)), pier_side_(config_.pier_side) {}
  void run(mount::SharedDrive& shared, device::DeviceThread& thread,
           const std::stop_token& stop) override;

 private:
  Heard connect(IndiLink& link, mount::SharedDrive& shared, const std::stop_token& stop);
  void serve(IndiLink& link, mount::SharedDrive& shared, device::DeviceThread& thread,
             const std::stop_token& stop);
  void judge(const Heard& now, mount::SharedDrive& shared);
  bool is_left_alone(const Heard& heard) const;
  void unpark(IndiLink& link, mount::SharedDrive& shared, double now_s);
  void take_position(const IndiLink& link, mount::SharedDrive& shared, double now_s);
  void carry_out(IndiLink& link, const mount::Order& order, double now_s);
  PanTilt angles_at(double monotonic_s) const;

  const IndiConfig config_;
  std::string pier_side_;  // as configured, or as first reported
  // Whether the telescope was parked at the first connection and has been seen parked ever since,
  // so that a goal may unpark it. nullopt before that connection.
  std::optional<bool> may_unpark_;
  double unpark_asked_s_ = -1e9;
  Heard heard_;
  double taken_s_ = 0.0;                 // time of the newest position that the drive has taken
  std::optional<double> slews_since_s_;  // when the slew to an ordered position began
};

}  // namespace ols::indi
