// Messages of the bus as records. Decides only whether a message is one; never throws, whatever the
// bytes.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "base/bus_inbox.h"
#include "export/records.h"

namespace ols::exports {

// What is known here of the site, to complete what a message says.
struct SiteContext {
  std::string site;
  // Height of the geoid above the ellipsoid [m] at a latitude and longitude [deg]; unknown without.
  std::function<double(double, double)> geoid_m = [](double, double) { return kUnknown; };
};

enum class MessageKind { kTarget, kStation, kLine };

// Of a target with a position, or one that has ended: its place is then unknown (not finite).
std::optional<Target> target_from(const BusMessage& message, const SiteContext& site);
std::optional<Station> station_from(const BusMessage& message, const SiteContext& site);
std::optional<Line> line_from(const BusMessage& message, const SiteContext& site);

// Whether the message is of its channel and schema; the others are refused, and counted.
bool is_understood(const BusMessage& message);
// Whether messages of such a channel are read here.
bool is_read(const std::string& channel);

}  // namespace ols::exports
