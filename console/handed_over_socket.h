// A listening socket that another process has opened and passed to the console by systemd's socket
// activation. The other process is the service manager, or the demo. The console then needs no
// permission to open the port itself.
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

// nullopt if no socket was passed. Throws std::runtime_error if the socket is not a listening TCP
// socket.
std::optional<HandedOverSocket> handed_over_socket();

}  // namespace ols::console
