#include "export/sapient/sapient_node.h"

#include "export/sapient/identifiers.h"
#include "sapient/sapient.pb.h"

namespace ols::exports {

std::string node_id(const SapientSettings& settings) {
  return settings.node_id.empty() ? uuid_of(settings.site + ".fusion") : settings.node_id;
}

sapient::SapientMessage message_of(const SapientSettings& settings, std::int64_t utime_us) {
  sapient::SapientMessage message;
  message.mutable_timestamp()->set_seconds(utime_us / 1'000'000);
  message.mutable_timestamp()->set_nanos(static_cast<std::int32_t>(utime_us % 1'000'000) * 1000);
  message.set_node_id(node_id(settings));
  return message;
}

}  // namespace ols::exports
