// Converts messages of the bus to records. Decides only whether a message is valid. Never throws,
// whatever the bytes are.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "base/bus/bus_inbox.h"
#include "export/records.h"

namespace ols::exports {

// Data of the site that a record needs in addition to its message.
struct SiteContext {
  std::string site;
  // Height of the geoid above the ellipsoid [m] at a latitude and longitude [deg]; by default
  // unknown.
  std::function<double(double, double)> geoid_m = [](double, double) { return kUnknown; };
};

enum class MessageKind { kTarget, kStation, kLine };

// Each of these functions returns nullopt if the message is of another kind or cannot be used. A
// target is used if it has a position or has ended; the place of an ended target is unknown (not
// finite).
std::optional<Target> target_from(const BusMessage& message, const SiteContext& site);
std::optional<Station> station_from(const BusMessage& message, const SiteContext& site);
std::optional<Line> line_from(const BusMessage& message, const SiteContext& site);
std::optional<Incident> incident_from(const BusMessage& message, const SiteContext& site);

// Whether the message is complete, and of the kind and schema that its channel has. Other messages
// are refused and counted.
bool is_understood(const BusMessage& message);
// Whether messages of this channel are converted to records.
bool is_read(const std::string& channel);

}  // namespace ols::exports
