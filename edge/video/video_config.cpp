// The keys of [video].
#include "base/config/config_section.h"
#include "base/net/ip_endpoint.h"
#include "base/net/ip_networks.h"
#include "edge/video/video_server.h"

namespace ols::video {

config::Section video_section(VideoConfig& c) {
  return {
      "video",
      "Pictures for the console and other viewers, on a TCP socket.",
      {config::text("address", c.address,
                    "IP address of this computer and port, such as 10.0.0.11:7790; empty: no "
                    "video.",
                    [](const std::string& text) {
                      if (!text.empty()) parse_endpoint(text);
                    })
           .required_with_section(),
       config::texts("allow", c.allow, "Networks whose viewers are served, such as 10.0.0.0/24.")},
      {},
      [&c](ConfigTable& table) {
        try {
          IpNetworks{c.allow};
        } catch (const std::invalid_argument& bad) {
          throw table.error("allow", bad.what());
        }
      }};
}

}  // namespace ols::video
