// The console on the bus: what is heard goes to the console, orders go out. Retries while there is
// no network.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/bus_connector.h"
#include "base/bus_monitor.h"
#include "command/messages.h"
#include "console/console.h"
#include "console/messages_procedure.h"

namespace ols::console {

class ConsoleBus {
 public:
  ConsoleBus(const std::string& url, const trust::TrustConfig& trust, Console& console);

  // Handles what has arrived, without waiting.
  void turn(const Now& now);
  void send(const std::vector<command::Order>& orders, const Now& now);
  void send(const std::vector<ProcedureAnswer>& answers, const Now& now);
  void send(const std::vector<CueOrder>& orders, const Now& now);
  // Why no order goes out; empty: it does.
  std::string trouble() const;
  // For people: how the bus is.
  std::string in_one_line() const;

 private:
  void connect(const Now& now);
  void disconnect(const std::string& why, const Now& now);
  void subscribe();
  void note_alarms(const Now& now);

  std::string url_;
  Console& console_;
  const std::int64_t boot_id_;
  BusConnector connector_;
  std::unique_ptr<LcmBus> bus_;  // null: no network
  BusMonitor monitor_;
  command::OrderSender sender_;
  AnswerSender answer_sender_;
  Now now_;  // of this turn, for the handlers
  std::string trouble_;
  std::vector<std::string> alarms_;
  bool send_failed_ = false;
};

}  // namespace ols::console
