// Serves the console over HTTP, HTTPS and WebSockets (Boost.Beast). It runs in the caller's thread;
// passwords are verified in another thread. Nothing queues for a browser: it gets the newest state
// when its last message is through.
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
  // Throws std::runtime_error that names the address or the file.
  WebServer(const ConsoleConfig& config, land::TerrainFolder land,
            const std::optional<HandedOverSocket>& socket, WebApi& api, Console& console);
  ~WebServer();

  int port() const;
  void serve_for(double seconds);
  // Sends what is new to every browser that can take it.
  void pump();

  struct Shared;  // shared by the connections

 private:
  std::unique_ptr<Shared> shared_;
};

}  // namespace ols::console
