// The site as a node of SAPIENT. Pure.
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
  double status_s = 5.0;  // between two status reports
};

// By which the site is known as a node.
std::string node_id(const SapientSettings& settings);
// A message of it, still without content.
sapient::SapientMessage message_of(const SapientSettings& settings, std::int64_t utime_us);

}  // namespace ols::exports
