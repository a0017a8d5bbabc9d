// The connection to a server of NATS: publishes and hears, and comes back by itself, unless the
// server refuses it twice or is none. Nothing waits in it: what cannot be sent now is lost and
// counted, because a queued command is a stale one.
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
  std::uint64_t sent = 0, unsent = 0;  // unsent: there was no connection
  std::uint64_t displaced = 0;         // arrived, and came faster than they were handled
  std::string trouble;                 // why there is no connection; empty: there is one
  bool has_ended = false;              // the library does not try again
};

class NatsLink {
 public:
  // Called in threads of the library, one after the other for each subject.
  using Handler =
      std::function<void(std::string_view subject, const Headers& headers, Bytes bytes)>;

  // Connects in the background. Throws ConfigError if keys or certificates cannot be read.
  NatsLink(const NatsConfig& config, const std::string& name,
           const std::vector<std::string>& subjects, Handler handler);
  ~NatsLink();
  NatsLink(const NatsLink&) = delete;
  NatsLink& operator=(const NatsLink&) = delete;

  // False: there is no connection.
  bool send(const Outgoing& outgoing, Bytes bytes);
  LinkReport report() const;
  // For streams and stores on the same connection, while it is open.
  __natsConnection* connection() const { return connection_; }

 private:
  void configure(const NatsConfig& config, const std::string& name);
  void connect(const std::vector<std::string>& servers);
  void hear(const std::string& subject);
  void close();
  void note(const char* trouble);
  static void on_message(__natsConnection*, __natsSubscription*, __natsMsg* message, void* self);
  static void on_open(__natsConnection*, void* self);
  static void on_loss(__natsConnection* connection, void* self);
  static void on_closed(__natsConnection*, void* self);
  static void on_complete(void* self);
  void begin_callbacks();
  void end_callbacks();

  Handler handler_;
  __natsOptions* options_ = nullptr;
  __natsConnection* connection_ = nullptr;
  std::vector<__natsSubscription*> subscriptions_;
  std::atomic<bool> is_open_{false}, has_ended_{false};
  std::atomic<std::uint64_t> openings_{0}, losses_{0}, sent_{0}, unsent_{0};
  mutable std::mutex mutex_;
  std::condition_variable ended_;
  std::size_t callers_ = 0;             // threads of the library that may call; under the lock
  std::string trouble_ = "connecting";  // under the lock
};

}  // namespace ols::bridge
