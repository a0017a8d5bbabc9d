// Converts messages of the bus to records. The only decision made here is whether a message is
// valid. Never throws, whatever the bytes.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "base/bus/bus_inbox.h"
#include "export/records.h"

namespace ols::exports {

// The site's data that complete a message.
struct SiteContext {
  std::string site;
  // Height of the geoid above the ellipsoid [m] at a latitude and longitude [deg]; by default
  // unknown.
  std::function<double(double, double)> geoid_m = [](double, double) { return kUnknown; };
};

enum class MessageKind { kTarget, kStation, kLine };

// A target with a position, or one that has ended: its place is then unknown (not finite).
std::optional<Target> target_from(const BusMessage& message, const SiteContext& site);
std::optional<Station> station_from(const BusMessage& message, const SiteContext& site);
std::optional<Line> line_from(const BusMessage& message, const SiteContext& site);
std::optional<Incident> incident_from(const BusMessage& message, const SiteContext& site);

// Whether the message matches its channel and schema. Other messages are refused and counted.
bool is_understood(const BusMessage& message);
// Whether messages of this channel are read here.
bool is_read(const std::string& channel);

}  // namespace ols::exports
