// Serves the console over HTTP, HTTPS and WebSockets (Boost.Beast). One thread: the caller's, but
// for passwords, which are verified in one of their own. Nothing queues for a browser: it gets the
// newest state when its last message is through.
#pragma once

#include <memory>
#include <optional>

#include "console/handed_over_socket.h"
#include "console/maps/map_library.h"
#include "console/web_api.h"

namespace ols::console {

class WebServer {
 public:
  // Throws std::runtime_error that names the address or the file.
  WebServer(const ConsoleConfig& config, const std::optional<HandedOverSocket>& socket, WebApi& api,
            Console& console);
  ~WebServer();

  int port() const;
  void serve_for(double seconds);
  // Gives every browser that is ready for it what is new.
  void pump();

  struct Shared;  // of the connections

 private:
  std::unique_ptr<Shared> shared_;
};

}  // namespace ols::console
