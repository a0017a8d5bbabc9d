// The store of owners: a key-value bucket of a NATS server. Uses two threads, because the server
// may be slow: one thread sends requests, the other receives changes.
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "bridge/nats_link.h"
#include "bridge/ownership/ownership.h"

struct __kvStore;
struct __jsCtx;

namespace ols::bridge {

class OwnerStore {
 public:
  // Called in these two threads; `answer` also in the thread that calls ask(). Each function has
  // the meaning and the arguments of a method of Ownership: learn(), learn_gone(), learn_wish(),
  // answer(), feel_store().
  struct Ears {
    std::function<void(const std::string& target, const OwnerRecord&, std::uint64_t)> learn;
    std::function<void(const std::string& target)> gone;
    std::function<void(const std::string& target, const std::string& by, std::uint64_t)> wish;
    std::function<void(const StoreRequest&, StoreAnswer, std::uint64_t)> answer;
    std::function<void(bool answers)> feel;
  };

  OwnerStore(NatsLink& link, std::string domain, Ears ears);
  ~OwnerStore();
  OwnerStore(const OwnerStore&) = delete;
  OwnerStore& operator=(const OwnerStore&) = delete;

  // Queues requests, which are handled one after the other. Requests beyond the queue's limit are
  // answered with kNone at once.
  void ask(std::vector<StoreRequest> requests);
  // How long the last answered request waited for its answer; or the age of the oldest request that
  // still waits, if that is greater.
  double delay_s() const;

 private:
  struct Waiting {
    StoreRequest request;
    double asked_s = 0.0;
  };
  void work();
  void watch();
  bool open();
  void close();
  bool probe();
  void carry_out(const StoreRequest& request);
  StoreAnswer look_again(const StoreRequest& request);
  void tell(const std::string& key, const std::string& value, std::uint64_t revision) const;

  NatsLink& link_;
  const std::string domain_;
  const Ears ears_;
  // worker_ sets both before it starts watcher_. From then on, both threads only read them.
  __jsCtx* js_ = nullptr;
  __kvStore* store_ = nullptr;
  mutable std::mutex mutex_;
  std::condition_variable asked_;
  std::deque<Waiting> requests_;  // under the lock
  double last_delay_s_ = 0.0;     // under the lock
  std::atomic<bool> ends_{false};
  std::thread worker_, watcher_;
};

}  // namespace ols::bridge
