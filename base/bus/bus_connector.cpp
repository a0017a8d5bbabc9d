#include "base/bus/bus_connector.h"

#include <chrono>
#include <exception>
#include <thread>
#include <utility>

namespace ols {

BusConnector::BusConnector(std::string url, std::shared_ptr<trust::BusTrust> trust)
    : url_(std::move(url)), trust_(std::move(trust)) {}

std::int64_t BusConnector::site_settings_number() const {
  return trust_ == nullptr ? 0 : trust_->site_settings_number();
}

// A detached thread: the destructor of std::async's future would block the program's end.
void BusConnector::begin() {
  std::packaged_task<std::unique_ptr<LcmBus>()> attempt([url = url_, trust = trust_] {
    auto bus = std::make_unique<LcmBus>(url, trust);
    bus->listen();
    return bus;
  });
  attempt_ = attempt.get_future();
  std::thread(std::move(attempt)).detach();
}

std::unique_ptr<LcmBus> BusConnector::take(double now_s, double wait_s) {
  constexpr double kRetry_s = 1.0;
  try {
    if (!attempt_.valid()) {
      if (now_s < due_s_) return nullptr;
      due_s_ = now_s + kRetry_s;
      begin();
    }
    if (attempt_.wait_for(std::chrono::duration<double>(wait_s)) != std::future_status::ready) {
      return nullptr;
    }
    auto bus = attempt_.get();
    trouble_.clear();
    return bus;
  } catch (const std::exception& failure) {
    attempt_ = {};
    trouble_ = failure.what();
    return nullptr;
  }
}

}  // namespace ols
