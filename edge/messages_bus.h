// A station on the bus: receives commands, sends bearings, status and previews. Decodes, checks the
// addressee and the freshness of a command, and counts what it refuses; decides nothing else. The
// station also runs without a network: the bus retries the connection every second.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/bus_connector.h"
#include "base/bus_monitor.h"
#include "edge/clock/clock_pair.h"
#include "edge/command_turn.h"
#include "edge/config.h"
#include "edge/messages.h"
#include "edge/messages_lens.h"
#include "edge/refusal_log.h"

namespace ols::station {

// The places of the station's key and of its persisted state.
trust::Environment trust_environment(const StationSettings& settings);

class StationBus {
 public:
  // Empty: accepted; otherwise the reason for the refusal.
  using Record = std::function<std::string(const recorder::RecordCommand&)>;
  using FrameWanted = std::function<std::string(const FrameRequest&)>;

  // The references must outlive the bus.
  StationBus(const StationSettings& settings, std::int64_t boot_id, Station& station,
             CommandTurn& turn, Record recorder, FrameWanted frame_wanted = {});

  // The present clocks, until the next call.
  void set_time(const clock::ClockPair& now, const clock::ClockQuality& quality);

  // Connects; waits at most this long.
  void connect(double wait_s);
  // Passes the waiting commands to the station. Without a connection, starts an attempt without
  // waiting for it.
  void receive();
  void take(const BusMessage& message);
  // True: the message is a stop. From any thread; end_turn() carries it out.
  bool take_stop(const BusMessage& message);
  // Call after the datagrams of a turn.
  void end_turn();

  // Why there is no connection; empty: connected.
  const std::string& trouble() const { return trouble_; }
  // The last refused command as text, and the number of refused commands.
  const std::string& last_refusal() const { return refused_.last(); }
  std::uint64_t refusals() const { return refused_.number(); }
  // Conditions of the bus for a person: commands that are repeatedly refused as not fresh, invalid
  // datagrams, newer settings of the site.
  std::vector<std::string> alarms() const;
  // Messages refused before they reached the station, and messages not sent. Part of each status.
  std::map<std::string, double> counters() const;

  void send(const Bearing& bearing);
  void send(const Sighting& sighting);
  void send(StationReport report);
  void send(const FramePart& part);
  void send_preview(const camera::Frame& frame, const std::optional<cv::Rect2d>& box);

 private:
  template <class Message>
  void publish(const std::string& channel, const Message& message);
  template <class Message>
  void on_command(std::string_view channel, const std::function<Refusal(const Message&)>& execute);
  void subscribe();
  void disconnect(const std::string& why);
  std::string ptu_channel() const;
  bool is_leased(const ols_msg::ptu_command_t& stop, std::int64_t utime_us) const;
  Refusal command_ptu(const ols_msg::ptu_command_t& message);
  Refusal command_lens(const ols_msg::lens_command_t& message);
  void record(const ols_msg::record_t& message);
  void want_frame(const ols_msg::frame_request_t& message);
  void note(const std::string& kind, Refusal refusal);

  const StationSettings& settings_;
  Station& station_;
  CommandTurn& turn_;
  // Fixed at construction: the bus's thread reads it while the control loop may replace the
  // settings.
  struct Given {
    CommandGate::Config gate;
    Record record;
    FrameWanted frame_wanted;
  };
  const Given given_;
  Sender sender_;
  double now_s_ = 0.0;
  using Receive = std::function<void(const BusMessage& message)>;
  std::vector<std::pair<std::string, Receive>> subscriptions_;
  BusConnector connector_;
  std::unique_ptr<LcmBus> bus_;
  BusMonitor monitor_;
  std::string trouble_ = "not connected yet";
  std::map<std::string, CommandGate> gates_;
  RefusalLog refused_;
  std::map<std::string, double> counters_;
  std::map<std::string, std::int64_t> sequences_;
};

}  // namespace ols::station
