#include "edge/messages/messages_lens.h"

#include <cmath>
#include <limits>

namespace ols::station {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

std::optional<double> named(double value) {
  return std::isnan(value) ? std::nullopt : std::optional(value);
}

}  // namespace

LensCommand from_message(const ols_msg::lens_command_t& message, double now_s) {
  LensCommand command;
  command.is_rate = message.command == ols_msg::lens_command_t::COMMAND_RATE;
  command.values = {named(message.zoom), named(message.focus), named(message.iris)};
  command.received_s = now_s;
  command.lease_s = message.lease_s;
  return command;
}

void fill_lens(const StationSnapshot& snapshot, ols_msg::station_status_t& message) {
  using M = ols_msg::station_status_t;
  message.kind = snapshot.overview ? M::KIND_OVERVIEW
                 : snapshot.moves  ? M::KIND_TRACKING
                                   : M::KIND_FIXED;
  int i = 0;
  for (const lens::Axis axis : lens::kAxes) {
    message.lens_position[i++] = snapshot.lens[axis].value_or(kNaN);
  }
  message.focal_length_px = snapshot.focal_length_px.value_or(kNaN);
  message.focal_length_sd_px = snapshot.focal_length_px ? snapshot.focal_length_sd_px : kNaN;
}

}  // namespace ols::station
