// The site as a SAPIENT node. Pure.
#pragma once

#include <cstdint>
#include <string>

namespace ols::exports::sapient {
class SapientMessage;
}
namespace ols::exports {

struct SapientSettings {
  std::string site = "ols";
  std::string node_id{};  // UUID; empty: computed from the site
  double status_s = 5.0;  // interval of status reports
};

// The node's id: the configured one, otherwise one computed from the site's name.
std::string node_id(const SapientSettings& settings);
// A message of the node, still without content.
sapient::SapientMessage message_of(const SapientSettings& settings, std::int64_t utime_us);

}  // namespace ols::exports
