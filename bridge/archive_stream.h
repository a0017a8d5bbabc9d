// Sets up a JetStream stream, in which a NATS server stores messages, and reads the stream's state
// periodically. Uses its own thread, because a server may be slow to answer.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "bridge/nats_link.h"
#include "bridge/stream_plan.h"

namespace ols::bridge {

// A site whose stream is copied, with the time of the newest status in the copy.
struct SourceReport {
  std::string site;
  std::int64_t newest_utime_us = 0;  // 0: there is none
};

struct ArchiveReport {
  bool is_kept = false;
  std::string trouble = "no answer yet";
  std::uint64_t messages = 0, bytes = 0;
  std::vector<SourceReport> sources;
};

class ArchiveStream {
 public:
  ArchiveStream(NatsLink& link, StreamPlan plan, const BridgeConfig& config);
  ~ArchiveStream();
  ArchiveStream(const ArchiveStream&) = delete;
  ArchiveStream& operator=(const ArchiveStream&) = delete;

  ArchiveReport report() const;

 private:
  void work();
  ArchiveReport look();

  NatsLink& link_;
  const StreamPlan plan_;
  const BridgeConfig config_;
  bool is_made_ = false;  // used by the thread
  mutable std::mutex mutex_;
  std::condition_variable end_;
  bool ends_ = false;
  ArchiveReport report_;
  std::thread thread_;
};

}  // namespace ols::bridge
