// A session with a pan-tilt head on a serial line. Such a head continues at its last velocity when
// no more orders come. If the station's program is killed, the head therefore moves on; the program
// stops it at its next start.
#pragma once

#include <functional>
#include <memory>
#include <utility>

#include "edge/mount/driven/driven_mount.h"
#include "edge/mount/serial/line_protocol.h"
#include "edge/mount/serial/serial_config.h"
#include "edge/serial/serial_port.h"

namespace ols::serial_mount {

class SerialSession : public mount::MountSession {
 public:
  SerialSession(SerialConfig config, std::unique_ptr<LineProtocol> protocol)
      : config_(std::move(config)), protocol_(std::move(protocol)) {}
  void run(mount::SharedDrive& shared, device::DeviceThread& thread,
           const std::stop_token& stop) override;

 private:
  bool ask(serial::SerialPort& port);
  void carry_out(serial::SerialPort& port, const mount::Order& order);
  mount::Vector place() const;

  const SerialConfig config_;
  const std::unique_ptr<LineProtocol> protocol_;
  std::uint64_t unanswered_ = 0;
};

}  // namespace ols::serial_mount
