// A connection to an MQTT broker, with libmosquitto. It uses quality of service 0 (no repetitions),
// because a late position is useless.
#pragma once

#include <memory>
#include <string>

#include "export/address.h"
#include "export/outlet/link.h"
#include "export/outlet/stream_link.h"

namespace ols::exports {

struct MqttLogin {
  std::string client;               // client id; the broker closes an older connection with the
                                    // same id
  std::string user, password_file;  // empty: none
  std::string status_topic;         // "online" while connected, then "offline"; both retained
};

class MqttLink : public Link {
 public:
  MqttLink(const Address& address, TlsFiles files, MqttLogin login);
  ~MqttLink() override;

  void open() override;
  void send(const Packet& packet) override;
  void wait(int wake_fd, double seconds) override;
  void close() override;

 private:
  struct Client;
  void log_in();
  int take();  // reads from the broker; returns the library's result
  void check(int result, const std::string& doing) const;
  void write_all();

  Address address_;
  TlsFiles files_;
  MqttLogin login_;
  std::unique_ptr<Client> client_;
};

}  // namespace ols::exports
