// The thread of one device: opens it, serves it, opens it again with growing pauses after it has
// failed, counts and reports. Errors of the device end here; nothing throws after construction.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>

#include "edge/device_report.h"

namespace ols::station {

class DeviceThread {
 public:
  struct Config {
    std::string name;            // of the device in its report and alarms: "gnss"
    std::string opening;         // the report's text until the device opens or fails to open
    double first_pause_s = 0.2;  // before the device is opened again; doubles with each failure
    double max_pause_s = 5.0;
  };
  // Opens the device, calls opened() and serves the device until the stop is requested. Throws
  // std::exception when the device fails. A session that just returns is started again at once.
  using Session = std::function<void(const std::stop_token&)>;

  struct Link {
    bool is_open = false;
    std::uint64_t openings = 0;
    std::uint64_t failures = 0;  // to open, and of an open device
    double first_opened_s = 0.0;
    std::string failure;  // the last one
    std::string fault;    // of the open device, holds now
  };

  explicit DeviceThread(const Config& config);
  ~DeviceThread() = default;  // requests the stop and waits for the thread
  DeviceThread(const DeviceThread&) = delete;
  DeviceThread& operator=(const DeviceThread&) = delete;

  // Once; a device that is not configured is never started.
  void start(Session session);

  // For the session: the device is open; the device works, so the next pause is a short one again.
  void opened();
  void works();
  // The fault of an open device, counted when it begins; empty: none.
  void set_fault(const std::string& fault);

  Link link() const;
  // Name and errors; state, text and alarms as far as they do not need the device's data. kOk: open
  // and without a fault.
  DeviceReport report() const;

 private:
  void run(const std::stop_token& stop, const Session& session);
  void failed(const std::string& failure);
  void pause(const std::stop_token& stop);

  const Config config_;
  double pause_s_;            // of the thread only
  mutable std::mutex mutex_;  // of everything below
  std::condition_variable_any wake_;
  Link link_;
  std::uint64_t errors_ = 0;
  std::string last_error_;
  std::jthread thread_;  // last: it uses the rest
};

}  // namespace ols::station
