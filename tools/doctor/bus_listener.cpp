#include "tools/doctor/bus_listener.h"

#include <arpa/inet.h>

#include <array>
#include <fstream>
#include <set>

#include "base/bus/channel_names.h"
#include "base/bus/lcm_bus.h"
#include "base/bus/lcm_url.h"
#include "base/bus/message_code.h"
#include "base/process/clocks.h"
#include "base/process/command_output.h"
#include "ols_msg/fusion_status_t.hpp"
#include "ols_msg/station_status_t.hpp"
#include "tools/ctl/status_text.h"
#include "tools/doctor/judge_host.h"
#include "wire/fusion_status.h"
#include "wire/station_status.h"

namespace ols::doctor {
namespace {

constexpr int kPoll_ms = 50;
constexpr double kCommand_s = 2.0;
constexpr std::size_t kMostBoots = 100;  // limits the memory that forged messages can use

// Uses the key of the examined process, as root: it only listens.
std::shared_ptr<trust::BusTrust> open_trust(const trust::TrustConfig& config,
                                            const std::string& name) {
  trust::Self self;
  self.name = name;
  self.commands = true;
  return trust::BusTrust::open(config, trust::process_environment(), self);
}

StationFacts station_from(const ols_msg::station_status_t& status) {
  StationFacts station;
  station.id = status.station;
  station.state = wire::state_name(status.state);
  station.alarms = alarms_of(status);
  for (std::size_t i = 0; i < status.device_name.size(); ++i) {
    device::DeviceReport device;
    device.name = status.device_name[i];
    device.state = from_code(status.device_state[i], device::DeviceState::kFault,
                             device::DeviceState::kAbsent);
    device.text = status.device_text[i];
    std::ranges::copy_if(station.alarms, std::back_inserter(device.alarms),
                         [&](const Alarm& alarm) { return alarm.part() == device.name; });
    station.devices.push_back(device);
  }
  station.clock = from_code(status.clock_state, clock::ClockState::kUnsynchronised,
                            clock::ClockState::kUnknown);
  station.clock_error_s = status.clock_error_s;
  station.position_known = status.position_source != ols_msg::station_status_t::POSE_NONE;
  using M = ols_msg::station_status_t;
  StationFacts::Calibration& calibration = station.calibration;
  calibration.doubted = status.calibration_state == M::CALIBRATION_DOUBTED;
  calibration.in_use = calibration.doubted || status.calibration_state == M::CALIBRATION_IN_USE;
  calibration.sd_rad = status.calibration_sd_rad;
  if (status.calibration_utime > 0) {
    calibration.age_s = 1e-6 * static_cast<double>(status.utime - status.calibration_utime);
  }
  for (std::size_t i = 0; i < status.counter_name.size(); ++i) {
    station.counters[status.counter_name[i]] = status.counter_value[i];
  }
  station.last_error = status.last_error;
  station.last_error_age_s = 1e-6 * static_cast<double>(status.utime - status.last_error_utime);
  station.text = ctl::full_status(status, clock_utime_us());
  return station;
}

// Without a trust list everybody is a stranger, so nothing can be concluded before it comes.
void wait_for_list(LcmBus& bus, const trust::BusTrust& signatures) {
  const double end_s = clock_monotonic_s() + 2.0 * trust::BusTrust::kTell_s;
  while (signatures.list_number() == 0 && clock_monotonic_s() < end_s) bus.handle(kPoll_ms);
}

void count_distrusted(BusFacts& heard, const BusTraffic& before, const BusTraffic& now) {
  heard.trust_trouble = now.trust_trouble;
  for (std::size_t i = 0; i < now.distrusted.size(); ++i) {
    const std::string reason = trust::to_string(static_cast<trust::Distrust>(i));
    heard.distrusted["bus_distrusted_" + reason] =
        static_cast<double>(now.distrusted[i] - before.distrusted[i]);
  }
}

void look_at_network(BusFacts& bus) {
  std::ifstream("/proc/sys/net/core/rmem_max") >> bus.rmem_max;
  const BusAddress bus_address = parse_lcm_url(bus.url);
  bus.ttl = bus_address.ttl;
  if (!bus_address.group) return;
  std::array<char, INET_ADDRSTRLEN> address{};
  inet_ntop(AF_INET, &bus_address.group->sin_addr, address.data(), address.size());
  if (const auto route = command_output({"ip", "-o", "route", "get", address.data()}, kCommand_s)) {
    bus.interface = parse_route(*route);
  }
}

}  // namespace

BusFacts listen(const std::string& lcm_url, const trust::TrustConfig& trust, double seconds,
                const std::string& own) {
  BusFacts heard;
  heard.url = lcm_url;
  std::map<std::string, std::set<std::int64_t>> boots;
  std::set<std::int64_t> fusions;
  try {
    look_at_network(heard);
    const auto signatures = open_trust(trust, own.empty() ? "fusion" : own);
    heard.is_verified = signatures != nullptr;
    LcmBus bus(lcm_url, signatures);
    bus.subscribe(station_channel(kStatusChannel, ".*"), [&](const BusMessage& message) {
      const auto status = wire::decode_status(message);
      if (!status) return;
      const bool known = heard.stations.contains(status->station) || status->station == own;
      if (!known && heard.stations.size() >= wire::kMostStationsHeard) return;
      std::set<std::int64_t>& of_station = boots[status->station];
      if (of_station.size() < kMostBoots) of_station.insert(status->boot_id);
      heard.stations[status->station] = station_from(*status);
    });
    bus.subscribe(std::string(kFusionStatusChannel), [&](const BusMessage& message) {
      const auto status = wire::decode_fusion_status(message);
      if (!status) return;
      if (fusions.size() < kMostBoots) fusions.insert(status->boot_id);
      heard.fusion_alarms = alarms_of(*status);
    });
    if (signatures) wait_for_list(bus, *signatures);
    const BusTraffic before = bus.traffic();
    const double end_s = clock_monotonic_s() + seconds;
    while (clock_monotonic_s() < end_s) bus.handle(kPoll_ms);
    count_distrusted(heard, before, bus.traffic());
  } catch (const std::exception& trouble) {
    heard.trouble = trouble.what();
  }
  for (auto& [id, station] : heard.stations) station.boots = boots[id].size();
  heard.fusions = static_cast<int>(fusions.size());
  return heard;
}

}  // namespace ols::doctor
