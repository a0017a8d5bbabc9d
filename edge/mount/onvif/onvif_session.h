// A connection to an ONVIF camera with pan and tilt. Its reported positions are used unchanged.
#pragma once

#include <mutex>
#include <utility>

#include "edge/mount/driven/driven_mount.h"
#include "edge/mount/onvif/onvif_config.h"
#include "edge/mount/onvif/onvif_link.h"

namespace ols::onvif {

class OnvifSession : public mount::MountSession {
 public:
  explicit OnvifSession(OnvifConfig config) : config_(std::move(config)) {}
  // At the end it orders a stop, and waits at most timeout_s for the answer.
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
  std::mutex mutex_;  // of the link
  OnvifLink* link_ = nullptr;
};

}  // namespace ols::onvif
