// The fusion on the bus: bearings and station status in; targets, slews and the fusion's own status
// out. Counts whatever it refuses. Without a network it waits for one.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "base/bus_connector.h"
#include "base/bus_monitor.h"
#include "central/fusion_settings.h"
#include "central/messages.h"
#include "central/other_fusions.h"
#include "central/present_watch.h"

namespace ols {

struct FusionProcessOptions {
  std::string slew_url;  // where slews go
  bool replay = false;   // the messages' time need not be the present
  std::int64_t boot_id = 0;
};

class FusionProcess {
 public:
  FusionProcess(const FusionSettings& settings, const FusionProcessOptions& options);

  // Handles what has arrived, waiting a little for the first message; publishes what follows.
  void turn();
  // How it is, in one line for a person.
  std::string in_one_line() const;

 private:
  void connect(double wait_s);
  void subscribe();
  template <class Message>
  void send(std::string_view channel, const Message& message);
  template <class Message>
  void send_slew(const std::string& channel, const Message& message);
  void on_bearing(const BusMessage& message);
  void on_status(const BusMessage& message);
  void on_fusion_status(const BusMessage& message);
  void refuse(MessageRefusal refusal, const std::string& channel);
  bool is_present(std::int64_t utime_us, const char* counter);
  FusionHealth watched_health() const;
  const std::string& newest_error(const std::string& of_fusion);
  void publish(const FusionOutput& output);
  void publish_status_when_due();
  double median_latency_s() const;
  void look_at_bus();
  MessageStamp next_stamp(std::string_view channel);
  void forget_sequences();

  FusionSettings settings_;
  FusionProcessOptions options_;
  Fusion fusion_;
  BusConnector connector_;
  std::unique_ptr<LcmBus> bus_;       // nothing: no network
  std::unique_ptr<LcmBus> slew_bus_;  // nothing: slews go on the same bus
  BusMonitor watch_;
  std::string bus_alarm_;
  std::string trouble_;  // of the network
  bool send_failed_ = false;
  std::map<std::string, std::int64_t, std::less<>> sequences_;
  std::int64_t forgotten_sequence_ = 0;  // the greatest of a channel that was forgotten
  std::map<std::string, double> counters_;
  PresentWatch present_;
  OtherFusions others_;
  std::string last_error_;  // the newest, of the fusion or of this process
  std::string told_error_;  // in the last status
  std::string fusion_error_;
  std::deque<double> latencies_s_;
  std::int64_t status_message_us_ = 0;  // "now" of the last status
  double status_s_ = 0.0;               // this host's monotonic clock at the last status
};

}  // namespace ols
