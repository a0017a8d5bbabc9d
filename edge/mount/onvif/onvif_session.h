// A session with an ONVIF camera that has pan and tilt. The reported positions are used without a
// model of the camera's errors.
#pragma once

#include <mutex>
#include <optional>
#include <utility>

#include "edge/mount/driven/driven_mount.h"
#include "edge/mount/onvif/onvif_config.h"
#include "edge/mount/onvif/onvif_link.h"

namespace ols::onvif {

class OnvifSession : public mount::MountSession {
 public:
  explicit OnvifSession(OnvifConfig config) : config_(std::move(config)) {}
  // Orders the stop that run() could not order, because the connection was lost at that time. Waits
  // at most timeout_s for the answer.
  ~OnvifSession() override;
  // The first request of every connection but the first is a stop. Before it returns, it orders a
  // stop and waits at most timeout_s for the answer.
  void run(mount::SharedDrive& shared, device::DeviceThread& thread,
           const std::stop_token& stop) override;
  void interrupt() override;

 private:
  void serve(OnvifLink& open, mount::SharedDrive& shared, device::DeviceThread& thread,
             const std::stop_token& stop);
  void carry_out(OnvifLink& open, const Learnt& learnt, const mount::Order& order,
                 mount::SharedDrive& shared, device::DeviceThread& thread);
  void publish(OnvifLink* open);

  const OnvifConfig config_;
  std::optional<Access> access_;  // of the last connection
  bool owes_stop_ = false;        // the camera was connected and was not ordered to stop since
  std::mutex mutex_;              // guards link_
  OnvifLink* link_ = nullptr;
};

}  // namespace ols::onvif
