// Looks at the computer for ols-doctor: network, clock, disk, limits.
#include <sys/statvfs.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>

#include "base/process/command_output.h"
#include "tools/doctor/judge_host.h"
#include "tools/doctor/probe.h"

namespace ols::doctor {
namespace {

constexpr double kCommand_s = 3.0;

template <typename Value>
std::optional<Value> read_file(const std::string& path) {
  std::ifstream file(path);
  Value value{};
  if (file >> value) return value;
  return std::nullopt;
}

}  // namespace

LinkFacts look_at_link(const std::string& address) {
  LinkFacts link;
  const auto route = command_output({"ip", "-o", "route", "get", address}, kCommand_s);
  if (route) link.name = parse_route(*route);
  if (link.name.empty()) return link;
  const std::string folder = "/sys/class/net/" + link.name;
  link.carrier = read_file<int>(folder + "/carrier").value_or(0) == 1;
  link.mtu = read_file<int>(folder + "/mtu").value_or(0);
  const auto speed = read_file<int>(folder + "/speed");
  if (speed && *speed > 0) link.speed_Mbit_s = speed;  // -1 or an error: it has none
  const std::string counters = folder + "/statistics/";
  link.received = read_file<std::uint64_t>(counters + "rx_packets").value_or(0);
  for (const char* name : {"rx_dropped", "rx_errors", "rx_missed_errors"}) {
    link.dropped += read_file<std::uint64_t>(counters + name).value_or(0);
  }
  return link;
}

FolderFacts look_at_folder(const std::string& name, const std::string& folder,
                           double reserve_bytes) {
  FolderFacts facts;
  facts.name = name;
  facts.folder = folder;
  facts.reserve_bytes = reserve_bytes;
  struct statvfs disk {};
  if (::statvfs(folder.c_str(), &disk) != 0) {
    facts.error = errno;
    return facts;
  }
  facts.free_bytes = static_cast<double>(disk.f_bavail) * static_cast<double>(disk.f_frsize);
  // Also detects a read-only file system when run as root.
  if (::access(folder.c_str(), W_OK) != 0) facts.error = errno;
  return facts;
}

std::vector<UnitFacts> look_at_units(const std::vector<std::string>& units) {
  std::vector<std::string> command{
      "systemctl", "show", "--no-pager",
      "--property=Id,LoadState,ActiveState,SubState,Result,NRestarts,StatusText"};
  command.insert(command.end(), units.begin(), units.end());
  const auto text = command_output(command, kCommand_s);
  return text ? parse_units(*text) : std::vector<UnitFacts>{};
}

}  // namespace ols::doctor
