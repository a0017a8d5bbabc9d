#include "export/export_bus.h"

#include <utility>

#include "base/bus/boot_id.h"
#include "base/bus/channel_names.h"

namespace ols::exports {
namespace {

// One second of many targets, so that none is lost while a file is written.
constexpr QueueLimits kTargetLimits{.messages = 10'000, .bytes = 16'000'000};

}  // namespace

ExportBus::ExportBus(std::string url, const trust::TrustConfig& trust,
                     const BusInbox::Handler& handler)
    : BusClient(std::move(url),
                trust::BusTrust::open(trust, trust::process_environment(),
                                      {.name = kMemberName, .boot_id = draw_boot_id()}),
                [handler](LcmBus& bus) {
                  bus.subscribe(std::string(kTargetChannel), handler, kTargetLimits);
                  bus.subscribe(station_channel(kStatusChannel, ".+"), handler);
                  bus.subscribe(station_channel(kBearingChannel, ".+"), handler);
                  bus.subscribe(std::string(kIncidentChannel), handler);
                }) {}

}  // namespace ols::exports
