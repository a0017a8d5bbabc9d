// The connection to a NATS server: publishes and receives messages, and reconnects by itself. The
// link ends only if the server has refused it twice, or is not a NATS server. A message that cannot
// be sent at once is dropped and counted. Messages never wait for a connection, because a queued
// command is a stale command.
//
// On an open connection, the library collects up to 32 kB of messages. One of the library's threads
// writes them to the server. While that thread waits for the server, send() waits too. If the
// server reads nothing for kWrite_ms, the library reconnects.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "bridge/bridge_config.h"
#include "bridge/passage.h"

struct __natsConnection;
struct __natsMsg;
struct __natsOptions;
struct __natsSubscription;

namespace ols::bridge {

struct LinkReport {
  bool is_open = false;
  std::uint64_t openings = 0, losses = 0;
  std::uint64_t sent = 0, unsent = 0;  // unsent: dropped, because there was no connection
  std::uint64_t displaced = 0;         // received messages dropped, because they arrived faster
                                       // than they were handled
  std::uint64_t refusals = 0;          // refusals by the server on an open connection
  std::string refusal;                 // the last refusal, if it is recent
  std::string trouble;                 // why there is no connection; empty: the connection is open
  bool has_ended = false;              // the library does not reconnect any more
};

class NatsLink {
 public:
  // Called in the library's threads, for one message of a subject at a time.
  using Handler =
      std::function<void(std::string_view subject, const Headers& headers, Bytes bytes)>;

  // Connects in the background. Throws ConfigError if keys or certificates cannot be read.
  NatsLink(const NatsConfig& config, const std::string& name,
           const std::vector<std::string>& subjects, Handler handler);
  ~NatsLink();
  NatsLink(const NatsLink&) = delete;
  NatsLink& operator=(const NatsLink&) = delete;

  // Returns false if there is no connection.
  bool send(const Outgoing& outgoing, Bytes bytes);
  LinkReport report() const;
  // For streams and stores that use the same connection. Use it only while the link is open.
  __natsConnection* connection() const { return connection_; }

 private:
  struct Tally {
    std::atomic<std::uint64_t> openings{0}, losses{0}, sent{0}, unsent{0}, refusals{0};
  };
  struct Said {
    std::string trouble = "connecting";
    std::string unheard;  // a refused subscription; kept, because the server reports it only once
    std::string refusal;  // a refused publication
    double refused_s = -1e9;
  };
  void configure(const NatsConfig& config, const std::string& name);
  void connect(const std::vector<std::string>& servers);
  void hear(const std::string& subject, std::size_t most_bytes);
  void close();
  void note(const char* trouble);
  static void on_message(__natsConnection*, __natsSubscription*, __natsMsg* message, void* self);
  static void on_open(__natsConnection*, void* self);
  static void on_loss(__natsConnection* connection, void* self);
  static void on_closed(__natsConnection*, void* self);
  static void on_refusal(__natsConnection* connection, __natsSubscription*, int status, void* self);
  static void on_complete(void* self);
  void begin_callbacks();
  void end_callbacks();

  Handler handler_;
  __natsOptions* options_ = nullptr;
  __natsConnection* connection_ = nullptr;
  std::vector<__natsSubscription*> subscriptions_;
  std::atomic<bool> is_open_{false}, has_ended_{false};
  Tally tally_;
  mutable std::mutex mutex_;
  std::condition_variable ended_;
  std::size_t callers_ = 0;  // number of final callbacks still to come from the library's threads;
                             // under the lock
  Said said_;                // under the lock
};

}  // namespace ols::bridge
