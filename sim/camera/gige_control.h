// The control channel of a simulated GigE Vision camera: its sockets, and the thread that receives
// from them.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "sim/camera/gige_wire.h"

namespace ols::sim {

// Converts text such as "127.0.0.11" to an address in network byte order. Throws std::system_error.
std::uint32_t camera_address(const std::string& text);

class GigeControl {
 public:
  using Reply = std::function<void(gige::Bytes acknowledgement)>;
  // Handles a packet from the client `peer` (its address << 16, plus its port). Called in this
  // object's thread.
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
  // The first is bound to the camera's address, the others receive broadcasts.
  std::vector<int> sockets_;
  int wake_ = -1;
  std::thread thread_;
};

}  // namespace ols::sim
