// Connects a station to the bus: receives and answers commands, and sends bearings, status and
// previews. It decodes each command, checks its addressee and freshness, and counts the commands
// that it refuses; all other decisions are the station's. A station also runs without a network;
// this class then tries to connect every second.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/bus/bus_connector.h"
#include "base/bus/bus_monitor.h"
#include "base/trust/rate_limit.h"
#include "conditions/alarm.h"
#include "edge/clock/clock_pair.h"
#include "edge/command/command_turn.h"
#include "edge/command/refusal_log.h"
#include "edge/config/config.h"
#include "edge/messages/messages.h"
#include "edge/messages/messages_lens.h"

namespace ols::station {

// The places of the station's key and of its saved trust list, from the process's environment. If
// settings.state_folder is set, it replaces the environment's folder for persisted state.
trust::Environment trust_environment(const StationSettings& settings);

class StationBus {
 public:
  // Functions that carry out a request. They return an empty text if they accept it, otherwise the
  // reason for the refusal.
  using Record = std::function<std::string(const recorder::RecordCommand&)>;
  using FrameWanted = std::function<std::string(const FrameRequest&)>;

  // The referenced objects must outlive the bus.
  StationBus(const StationSettings& settings, std::int64_t boot_id, Station& station,
             CommandTurn& turn, Record recorder, FrameWanted frame_wanted = {});

  // Sets the present time, which is used until the next call.
  void set_time(const clock::ClockPair& now, const clock::ClockQuality& quality);

  // Tries to connect; waits at most `wait_s`.
  void connect(double wait_s);
  // Passes the waiting commands to the station and sends the answers. Without a connection, it
  // starts an attempt to connect and does not wait for the result.
  void receive();
  void take(const BusMessage& message);
  // Handles the message if it is a stop command; otherwise returns false. end_turn() carries the
  // stop out. May be called from any thread.
  bool take_stop(const BusMessage& message);
  // Call in each cycle of the control loop, after all messages of the cycle were taken
  // (CommandTurn). Carries out the cycle's designation and stop.
  void end_turn();
  // The answers since the last call. receive() takes and sends them.
  std::vector<Answer> take_answers() { return std::exchange(answers_, {}); }

  // Why there is no connection; empty while connected.
  const std::string& trouble() const { return trouble_; }
  // The last refusal as text, and the number of refusals.
  const std::string& last_refusal() const { return refused_.last(); }
  std::uint64_t refusals() const { return refused_.number(); }
  // Alarms about the bus: commands that are repeatedly refused because they are not fresh, invalid
  // datagrams, and newer settings of the site that wait for a restart.
  std::vector<Alarm> alarms() const;
  // Counters for the status message: messages that were refused before they reached the station,
  // messages that could not be sent, and others.
  std::map<std::string, double> counters() const;

  void send(const Bearing& bearing);
  void send(const Sighting& sighting);
  void send(const skyline::SkylinePart& part);
  void send(StationReport report);
  void send(const FramePart& part);
  void send_preview(const camera::Frame& frame, const std::optional<cv::Rect2d>& box);

 private:
  // The result of a command; `reason` and `detail` as in Answer.
  struct Verdict {
    std::string reason{}, detail{};
    bool is_open = false;  // true: end_turn() will decide
  };

  template <class Message>
  void publish(const std::string& channel, const Message& message);
  template <class Message>
  void on_command(std::string_view channel, const std::function<Verdict(const Message&)>& execute);
  void subscribe();
  void disconnect(const std::string& why);
  std::string ptu_channel() const;
  bool is_leased(const ols_msg::ptu_command_t& stop, std::int64_t utime_us) const;
  Verdict command_ptu(const ols_msg::ptu_command_t& message);
  Verdict command_lens(const ols_msg::lens_command_t& message);
  Verdict record(const ols_msg::record_t& message);
  Verdict want_frame(const ols_msg::frame_request_t& message);
  // Converts a refusal by the station to a verdict, and notes it.
  Verdict verdict(const std::string& kind, Refusal refusal);
  void answer(const CommandId& command, const Verdict& verdict);
  void answer_designations();

  const StationSettings& settings_;
  Station& station_;
  CommandTurn& turn_;
  // Copies made at construction, because the bus's thread reads them while the control loop may
  // replace the settings.
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
  std::vector<Answer> answers_;
  // Maximum rates of answers. kAccepted_Hz is high, because several operators may each repeat a
  // stop 50 times a second.
  static constexpr double kAccepted_Hz = 300.0, kRefused_Hz = 50.0;
  trust::RateLimit accepted_sent_{kAccepted_Hz}, refused_sent_{kRefused_Hz};
  // Stops that end_turn() must answer: the last one of each sender. Shared with the bus's thread.
  // Their number is limited, because forged stops may come from any number of senders.
  static constexpr std::size_t kMostStoppers = 16;
  std::mutex stops_mutex_;
  std::map<std::int64_t, std::int64_t> stops_;  // sender's boot id -> sequence number
};

}  // namespace ols::station
