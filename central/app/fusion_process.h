// The fusion on the bus: receives bearings and station statuses; sends targets, slews and its own
// status. Counts every refused message. Reconnects by itself.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <vector>

#include "base/journal/alarm_journal.h"
#include "central/app/fusion_bus.h"
#include "central/app/fusion_conflict_monitor.h"
#include "central/app/fusion_settings.h"
#include "central/app/messages.h"
#include "central/app/timeliness_gate.h"

namespace ols::fusion {

struct FusionProcessOptions {
  std::string slew_url;  // the LCM URL for slews
  bool replay = false;   // in a replay, messages may be old by the host's clock
  std::int64_t boot_id = 0;
};

class FusionProcess {
 public:
  FusionProcess(const FusionSettings& settings, const FusionProcessOptions& options);

  // Handles the messages that have arrived, and publishes the results. Waits briefly for the first
  // message.
  void turn();
  // The status in one line, for a person.
  std::string in_one_line() const;

 private:
  void subscribe(LcmBus& bus);
  void on_bearing(const BusMessage& message);
  void on_status(const BusMessage& message);
  void on_skyline(const BusMessage& message);
  void on_fusion_status(const BusMessage& message);
  void on_cue(const BusMessage& message);
  void on_cue_order(const BusMessage& message);
  // Why the order is refused, in words for the sender; empty if it is accepted.
  std::string obey(const CueOrder& order);
  std::int64_t present_us() const;
  void refuse(MessageRefusal refusal, const std::string& channel);
  bool is_present(std::int64_t utime_us, const char* counter);
  FusionHealth watched_health() const;
  void publish(const FusionOutput& output);
  void publish(const std::vector<Slew>& slews);
  void publish_status_when_due();

  // The newest error, of the fusion or of this process.
  struct Errors {
    std::string last{}, told{}, of_fusion{};

    // Returns the error that has occurred since the last status; if none has, the error that the
    // last status stated.
    const std::string& newest(const std::string& of_fusion_now);
  };
  // The time from a target's epoch to its publication.
  struct Latency {
    std::deque<double> lately_s{};

    void add(double latency_s);
    double median_s() const;
  };

  FusionSettings settings_;
  FusionProcessOptions options_;
  Fusion fusion_;
  FusionBus bus_;
  std::map<std::string, double> counters_;
  TimelinessGate present_;
  FusionConflictMonitor others_;
  Errors errors_;
  AlarmJournal alarms_;
  Latency latency_;
  // The last sequence number of an order, by the sender's boot id.
  std::map<std::int64_t, std::int64_t> cue_orders_;
  std::int64_t cue_message_us_ = 0;  // time of the newest cue
  double waited_s_ = 0.0;            // how long the current bearing waited before it was processed
  std::int64_t status_message_us_ = 0;  // Fusion::now_us() at the last status
  double status_s_ = 0.0;               // this host's monotonic clock at the last status
};

}  // namespace ols::fusion
