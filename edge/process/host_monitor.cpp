#include "edge/process/host_monitor.h"

#include <sys/statvfs.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>

#include "base/process/clocks.h"
#include "conditions/alarms.h"

namespace ols::station {
namespace {

constexpr double kSlowTurn_s = 0.5;  // slower turns of the control loop are counted

// The hottest zone: zone names differ between kernels.
std::optional<double> hottest_degC(const std::string& folder) {
  std::optional<double> hottest;
  std::error_code none;
  for (const auto& zone : std::filesystem::directory_iterator(folder, none)) {
    if (!zone.path().filename().string().starts_with("thermal_zone")) continue;
    double millidegrees = 0.0;
    if (std::ifstream(zone.path() / "temp") >> millidegrees) {
      hottest = std::max(hottest.value_or(-273.0), millidegrees * 1e-3);
    }
  }
  return hottest;
}

std::optional<double> free_bytes(const std::string& folder) {
  struct statvfs disk {};
  if (statvfs(folder.c_str(), &disk) != 0) return std::nullopt;
  return static_cast<double>(disk.f_bavail) * static_cast<double>(disk.f_frsize);
}

}  // namespace

HostReading read_host(const HostConfig& config) {
  return {hottest_degC(config.thermal_folder), free_bytes(config.disk_folder)};
}

HostReport report_on(const HostReading& reading, const HostConfig& config) {
  HostReport report;
  if (reading.cpu_degC) {
    report.readings["cpu_degC"] = *reading.cpu_degC;
    if (*reading.cpu_degC > config.cpu_alarm_degC) {
      report.alarms.push_back(alarm::processor_hot(*reading.cpu_degC));
    }
  }
  if (reading.disk_free_bytes) {
    report.readings["disk_free_bytes"] = *reading.disk_free_bytes;
    if (*reading.disk_free_bytes < config.disk_alarm_bytes) {
      report.alarms.push_back(alarm::disk_nearly_full(*reading.disk_free_bytes * 1e-6));
    }
  }
  return report;
}

struct HostMonitor::Shared {
  void run(const Reader& reader, double interval_s) {
    for (;;) {
      const HostReading found = reader();
      std::unique_lock lock(mutex);
      reading = found;
      read_s = clock_monotonic_s();
      if (ended.wait_for(lock, std::chrono::duration<double>(interval_s), [this] { return end; })) {
        return;
      }
    }
  }

  std::mutex mutex;
  std::condition_variable ended;
  bool end = false;
  HostReading reading;
  double read_s = 0.0;  // of the reading; initially of the start
};

// Detached: joining a thread that waits for a hanging disk would never return.
HostMonitor::HostMonitor(const HostConfig& config, Reader reader)
    : config_(config), shared_(std::make_shared<Shared>()) {
  shared_->read_s = clock_monotonic_s();
  std::thread([shared = shared_, reader = std::move(reader), interval_s = config.interval_s] {
    shared->run(reader, interval_s);
  }).detach();
}

HostMonitor::~HostMonitor() {
  const std::lock_guard lock(shared_->mutex);
  shared_->end = true;
  shared_->ended.notify_all();
}

void HostMonitor::note_turn(double seconds, double waited_s) {
  const double worked_s = seconds - waited_s;
  slowest_s_ = std::max(slowest_s_, worked_s);
  if (seconds > kSlowTurn_s) ++slow_turns_;
  if (turns_s_.size() < kKept) {
    turns_s_.push_back(worked_s);
  } else {
    turns_s_[turns_ % kKept] = worked_s;
  }
  ++turns_;
}

double HostMonitor::turn_p99_s() const {
  if (turns_s_.empty()) return 0.0;
  std::vector<double> sorted = turns_s_;
  const auto at = static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(sorted.size() - 1));
  std::ranges::nth_element(sorted, sorted.begin() + at);
  return sorted[static_cast<std::size_t>(at)];
}

HostReport HostMonitor::look(double now_s) {
  HostReading reading;
  double age_s = 0.0;
  {
    const std::lock_guard lock(shared_->mutex);
    reading = shared_->reading;
    age_s = now_s - shared_->read_s;
  }
  const bool silent = age_s > config_.silence_s;
  HostReport report = report_on(silent ? HostReading{} : reading, config_);
  if (silent) {
    report.alarms.push_back(alarm::disk_silent(config_.disk_folder, age_s));
  }
  report.readings["slowest_turn_s"] = slowest_s_;
  report.readings["turn_p99_s"] = turn_p99_s();
  slowest_s_ = 0.0;
  return report;
}

}  // namespace ols::station
