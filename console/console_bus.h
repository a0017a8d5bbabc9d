// Connects the console to the bus: passes messages from the bus to the console, and sends the
// console's orders.
#pragma once

#include <string>
#include <vector>

#include "base/bus/bus_client.h"
#include "base/trust/trust_config.h"
#include "conditions/alarm.h"
#include "console/console.h"
#include "console/messages_incidents.h"
#include "console/messages_procedure.h"
#include "wire/orders.h"

namespace ols::console {

class ConsoleBus {
 public:
  ConsoleBus(const std::string& url, const trust::TrustConfig& trust, Console& console);

  // Handles the messages that have arrived, without waiting.
  void turn(const Now& now);
  void send(const std::vector<wire::Order>& orders, const Now& now);
  void send(const std::vector<ProcedureAnswer>& answers, const Now& now);
  void send(const std::vector<wire::CueOrder>& orders, const Now& now);
  void send(const IncidentBook::News& news, const Now& now);
  // Why orders cannot be sent; empty: they can.
  Alarm trouble() const { return client_.trouble(); }
  // The state of the bus in one line, for people.
  std::string in_one_line() const;

 private:
  void subscribe(LcmBus& bus);
  void note_trouble(const std::string& trouble);
  void note_alarms();

  Console& console_;
  const std::int64_t boot_id_;
  BusClient client_;
  wire::OrderSender sender_;
  AnswerSender answer_sender_;
  IncidentSender incident_sender_;
  Now now_;  // the time that turn() was given, for the handlers
  std::vector<Alarm> alarms_;
  bool send_failed_ = false;
};

}  // namespace ols::console
