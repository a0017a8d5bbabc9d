// The thread of one device: opens it, serves it, reopens it after a failure with growing pauses,
// counts and reports. Errors of the device end here; nothing throws after construction.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>

#include "conditions/alarm.h"
#include "edge/device/device_report.h"

namespace ols::device {

class DeviceThread {
 public:
  struct Config {
    std::string name;            // of the device in its report: "gnss"
    std::string opening;         // the report's text until the first attempt to open has ended
    double first_pause_s = 0.2;  // before the device is reopened; doubles with each failure
    double max_pause_s = 5.0;
    // Makes an alarm of a failure; null: the owner does.
    Alarm (*alarm)(const std::string& failure) = nullptr;
  };
  // Opens the device, calls opened() and serves the device until the stop is requested. Throws
  // std::exception when the device fails. A session that returns is started again at once.
  using Session = std::function<void(const std::stop_token&)>;

  struct Link {
    bool is_open = false;
    std::uint64_t openings = 0;
    std::uint64_t failures = 0;  // to open, and of an open device
    double first_opened_s = 0.0;
    std::string failure;  // the latest
    std::string fault;    // of the open device, current
  };

  explicit DeviceThread(const Config& config);
  ~DeviceThread() = default;  // requests the stop and waits for the thread
  DeviceThread(const DeviceThread&) = delete;
  DeviceThread& operator=(const DeviceThread&) = delete;

  // Call once; not at all if the device is not configured.
  void start(Session session);

  // For the session: the device is open; the device works, so that the next pause is short again.
  void opened();
  void works();
  // The fault of an open device, counted when it begins; empty: no fault.
  void set_fault(const std::string& fault);

  Link link() const;
  // Name and errors; and state, text and alarms as far as they do not depend on the device's data.
  // kOk: the device is open and has no fault.
  DeviceReport report() const;

 private:
  void run(const std::stop_token& stop, const Session& session);
  void failed(const std::string& failure);
  void pause(const std::stop_token& stop);

  const Config config_;
  double pause_s_;            // used by the thread only
  mutable std::mutex mutex_;  // guards all members below
  std::condition_variable_any wake_;
  Link link_;
  std::uint64_t errors_ = 0;
  std::string last_error_;
  std::jthread thread_;  // last: it uses the rest
};

}  // namespace ols::device
