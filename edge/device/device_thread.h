// The thread of one device. It opens the device and serves it. After a failure it reopens the
// device, with growing pauses. It counts errors and reports them. Exceptions of the device do not
// leave this class; no function throws after construction.
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
    std::string name;     // name of the device in its report: "gnss"
    std::string opening;  // text of the report until the first attempt to open the device has ended
    // First pause before the device is reopened. The pause doubles with each failure, up to
    // max_pause_s.
    double first_pause_s = 0.2;
    double max_pause_s = 5.0;
    // Makes the alarm for a failure; if null, the owner of this object makes the alarm.
    Alarm (*alarm)(const std::string& failure) = nullptr;
  };
  // A function that opens the device, calls opened(), and serves the device until a stop is
  // requested. It throws std::exception when the device fails. If it returns before a stop is
  // requested, it is called again at once.
  using Session = std::function<void(const std::stop_token&)>;

  struct Link {
    bool is_open = false;
    std::uint64_t openings = 0;
    // Number of failures to open the device, and of failures of the open device.
    std::uint64_t failures = 0;
    double first_opened_s = 0.0;
    std::string failure;  // the latest failure
    std::string fault;    // current fault of the open device
  };

  explicit DeviceThread(const Config& config);
  ~DeviceThread() = default;  // requests the stop and waits for the thread
  DeviceThread(const DeviceThread&) = delete;
  DeviceThread& operator=(const DeviceThread&) = delete;

  // Call once; do not call if the device is not configured.
  void start(Session session);

  // The session calls opened() when it has opened the device, and works() when it has seen that the
  // device works. works() resets the next pause to first_pause_s; opened() does not.
  void opened();
  void works();
  // Sets the fault of an open device; empty if there is no fault. A fault counts as one error, when
  // it begins.
  void set_fault(const std::string& fault);

  Link link() const;
  // Contains the name, the errors, and the state, text and alarm that follow from opening, failures
  // and fault. The owner adds the device's data. kOk means that the device is open and has no
  // fault.
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
  std::jthread thread_;  // last member, because it uses the others
};

}  // namespace ols::device
