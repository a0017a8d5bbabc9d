#include "tools/setup/find_indi.h"

#include <fmt/format.h>
#include <libindi/baseclient.h>
#include <libindi/basedevice.h>
#include <libindi/indiproperty.h>

#include <chrono>
#include <condition_variable>
#include <map>
#include <mutex>

#include "base/config/toml_text.h"
#include "base/process/clocks.h"
#include "base/text/plain_text.h"

namespace ols::setup {
namespace {

// Each driver names itself, and then states in DRIVER_INFO what it drives.
class Names : public INDI::BaseClient {
 public:
  ~Names() override { disconnectServer(); }

  // A server passes its drivers' statements on one after the other: `quiet_s` without one is the
  // end, also if there is none for `longest_s`.
  std::vector<std::string> telescopes(double longest_s, double quiet_s) {
    std::unique_lock lock(mutex_);
    const double end_s = clock_monotonic_s() + longest_s;
    heard_s_ = clock_monotonic_s();
    while (clock_monotonic_s() < end_s) {
      const bool is_quiet = clock_monotonic_s() - heard_s_ > quiet_s;
      if (is_quiet && !interfaces_.empty()) break;
      news_.wait_for(lock, std::chrono::milliseconds(50));
    }
    std::vector<std::string> names;
    for (const auto& [name, interfaces] : interfaces_)
      if ((interfaces & INDI::BaseDevice::TELESCOPE_INTERFACE) != 0) names.push_back(name);
    return names;
  }

 protected:
  void newProperty(INDI::Property property) override {
    if (!property.isNameMatch("DRIVER_INFO")) return;
    const INDI::BaseDevice device = property.getBaseDevice();
    const std::lock_guard lock(mutex_);
    interfaces_[device.getDeviceName()] = device.getDriverInterface();
    heard_s_ = clock_monotonic_s();
    news_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable news_;
  std::map<std::string, unsigned> interfaces_;
  double heard_s_ = 0.0;
};

}  // namespace

std::vector<Found> find_indi(const std::string& host, int port) {
  constexpr double kLongest_s = 3.0, kQuiet_s = 0.5;
  Names names;
  names.setServer(host.c_str(), static_cast<unsigned>(port));
  if (!names.connectServer()) return {};
  std::vector<Found> found;
  for (const std::string& name : names.telescopes(kLongest_s, kQuiet_s)) {
    found.push_back({fmt::format("{} at {}:{}", plain_text(name), host, port),
                     {{"station.mount.kind", toml_text("indi")},
                      {"station.mount.device", toml_text(name)},
                      {"station.mount.host", toml_text(host)},
                      {"station.mount.port", fmt::format("{}", port)}}});
  }
  return found;
}

}  // namespace ols::setup
