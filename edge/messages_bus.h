// A station on the bus: takes commands in, sends bearings, status and previews out. Decodes, checks
// who is meant and whether the command is fresh, and counts whatever it refuses; decides nothing.
// Without a network the station runs all the same: the connection is tried again once a second.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/bus_connector.h"
#include "base/bus_monitor.h"
#include "edge/clock/clock_pair.h"
#include "edge/command_turn.h"
#include "edge/config.h"
#include "edge/messages.h"
#include "edge/refusal_log.h"

namespace ols::station {

class StationBus {
 public:
  // Empty: accepted; else why not.
  using Record = std::function<std::string(const recorder::RecordCommand&)>;

  // The references must outlive the bus.
  StationBus(const StationSettings& settings, std::int64_t boot_id, Station& station,
             CommandTurn& turn, Record recorder);

  // The clocks of this moment, for everything until the next call.
  void set_time(const clock::ClockPair& now, const clock::ClockQuality& quality);

  // Seeks a connection; waits so long for it at most.
  void connect(double wait_s);
  // Hands the waiting commands to the station. Where there is no connection, one is sought; nobody
  // waits for it.
  void receive();
  // One datagram, as it came from the network.
  void take(const std::string& channel, const void* data, int bytes);
  // A stop, in whatever thread it comes; false for anything else. end_turn() carries it out.
  bool take_stop(const void* data, int bytes);
  // After the datagrams of a turn.
  void end_turn();

  // Why there is no connection; empty when there is one.
  const std::string& trouble() const { return trouble_; }
  // The last refused command in words, and how many there were.
  const std::string& last_refusal() const { return refused_.last(); }
  std::uint64_t refusals() const { return refused_.number(); }
  // What a person should know of the bus: commands that keep being refused because they are not
  // fresh, datagrams that are none.
  std::vector<std::string> alarms() const;
  // Refusals before the station, messages not sent; go into each status.
  std::map<std::string, double> counters() const;

  void send(const Bearing& bearing);
  void send(StationReport report);
  void send_preview(const camera::Frame& frame, const std::optional<cv::Rect2d>& box);

 private:
  template <class Message>
  void publish(const std::string& channel, const Message& message);
  template <class Message>
  void on_command(const std::string& kind, const std::function<Refusal(const Message&)>& execute);
  void subscribe();
  void disconnect(const std::string& why);
  std::string ptu_channel() const;
  Refusal command_ptu(const ols_msg::ptu_command_t& message);
  void record(const ols_msg::record_t& message);
  void note(const std::string& kind, Refusal refusal);

  const StationSettings& settings_;
  Station& station_;
  CommandTurn& turn_;
  Record record_;
  Sender sender_;
  double now_s_ = 0.0;
  // One datagram of a channel.
  using Receive = std::function<void(const void* data, int bytes)>;
  std::vector<std::pair<std::string, Receive>> subscriptions_;
  BusConnector connector_;
  std::unique_ptr<LcmBus> bus_;
  BusMonitor watch_;
  std::string trouble_ = "not connected yet";
  std::map<std::string, CommandGate> gates_;
  RefusalLog refused_;
  std::map<std::string, double> counters_;
  std::map<std::string, std::int64_t> sequences_;
};

}  // namespace ols::station
