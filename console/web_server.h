// Serves the console over HTTP, HTTPS and WebSockets (Boost.Beast). Runs in the caller's thread;
// passwords are verified in another thread. Messages for a browser never queue: the browser gets
// the newest state when its last message has been sent.
#pragma once

#include <memory>
#include <optional>

#include "console/handed_over_socket.h"
#include "console/maps/map_library.h"
#include "console/site_land.h"
#include "console/web_api.h"

namespace ols::console {

class WebServer {
 public:
  // Throws std::runtime_error that names the address or the file that cannot be used.
  WebServer(const ConsoleConfig& config, land::TerrainFolder land,
            const std::optional<HandedOverSocket>& socket, WebApi& api, Console& console);
  ~WebServer();

  int port() const;
  void serve_for(double seconds);
  // Sends whatever is new to every browser whose last message has been sent.
  void pump();

  struct Shared;  // what all connections share

 private:
  std::unique_ptr<Shared> shared_;
};

}  // namespace ols::console
