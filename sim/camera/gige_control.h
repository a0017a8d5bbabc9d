// The control channel of a simulated GigE Vision camera: its sockets and the thread that listens.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "sim/camera/gige_wire.h"

namespace ols::sim {

// "127.0.0.11" in network byte order. Throws std::system_error.
std::uint32_t camera_address(const std::string& text);

class GigeControl {
 public:
  using Reply = std::function<void(gige::Bytes acknowledgement)>;
  // A packet from the client `peer` (its address << 16, plus its port). Called in this object's
  // thread.
  using Handle = std::function<void(gige::Bytes packet, std::uint64_t peer, const Reply& reply)>;

  // Throws std::system_error if the address is not available.
  GigeControl(const std::string& address, Handle handle);
  ~GigeControl();
  GigeControl(const GigeControl&) = delete;
  GigeControl& operator=(const GigeControl&) = delete;

 private:
  void run();
  void receive(int fd);

  const std::uint32_t address_, mask_;
  const Handle handle_;
  std::vector<int> sockets_;  // its own address first; the others receive broadcasts
  int wake_ = -1;
  std::thread thread_;
};

}  // namespace ols::sim
