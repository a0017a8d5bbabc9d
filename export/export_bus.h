// ols-export's connection to the bus. It only receives.
#pragma once

#include <string>

#include "base/bus/bus_client.h"
#include "base/trust/trust_config.h"

namespace ols::exports {

inline constexpr const char* kMemberName = "export";  // the name of ols-export in the site's trust
                                                      // list

class ExportBus : public BusClient {
 public:
  // The handler receives targets, station statuses, bearings and incidents.
  ExportBus(std::string url, const trust::TrustConfig& trust, const BusInbox::Handler& handler);
};

}  // namespace ols::exports
