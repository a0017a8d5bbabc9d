// A listening socket that the service manager, or the demo, has opened and handed over (systemd's
// socket activation). The console then needs no permission for the port or its network.
#pragma once

#include <optional>
#include <string>

namespace ols::console {

struct HandedOverSocket {
  int descriptor = -1;
  bool is_v6 = false;
  std::string address;
  int port = 0;
};

// nullopt if no socket was handed over. Throws std::runtime_error if it is no listening TCP socket.
std::optional<HandedOverSocket> handed_over_socket();

}  // namespace ols::console
