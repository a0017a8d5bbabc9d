// The recorder's memory: the frames of the last seconds, and the current events with their frames
// that wait to be written. Pure; not thread-safe.
#pragma once

#include <cstdint>
#include <deque>
#include <list>
#include <optional>
#include <set>
#include <string>

#include "edge/recorder/event_folder.h"
#include "edge/recorder/frame_memory.h"
#include "edge/recorder/recorder.h"

namespace ols::recorder {

struct RecordedEvent {
  std::string label;
  std::int64_t utime_us = 0;
  double start_s = 0.0, end_s = 0.0;
  std::deque<RecordedFrame> waiting;
  double expected_bytes = 0.0;  // still to be written
  bool closed = false;          // no more frames belong to it
  std::uint64_t written = 0;    // frames
  std::string unfinished;       // why finishing failed; all frames are on disk
  double retry_s = 0.0;         // when finishing is retried
  std::string name;             // this and the following are used by the writing thread only
  std::optional<EventFolder> folder;
};

class EventQueue {
 public:
  explicit EventQueue(const RecorderConfig& config)
      : config_(config), memory_(config.memory_s, config.memory_max_bytes) {}

  // Returns the number of frames dropped because too many are waiting.
  int add(const RecordedFrame& frame);
  // Why the command is refused, regardless of the disk; empty: accepted.
  std::string refusal(const RecordCommand& command, double now_s) const;
  // Returns the number of buffered frames that were dropped.
  int begin(const RecordCommand& command, std::int64_t event_utime_us);
  // Maximum disk space of the command's frames, estimated from those in memory.
  double expected_bytes(const RecordCommand& command) const;
  double still_to_write() const;

  // Ends the events whose last frame must have arrived.
  void close(double now_s);
  // Retries the unfinished events at once.
  void retry_all();
  struct Job {
    RecordedEvent* event = nullptr;      // valid until remove()
    std::optional<RecordedFrame> frame;  // nullopt: the event is to be finished
  };
  std::optional<Job> next(double now_s);
  void remove(const RecordedEvent& event);

  bool work_waits() const;
  bool empty() const { return events_.empty(); }
  std::set<std::string> names() const;  // an empty name: nothing written yet
  // Why an event could not be finished; empty: no such event.
  std::string unfinished() const;

 private:
  bool enqueue(RecordedEvent& event, const RecordedFrame& frame);

  const RecorderConfig config_;
  FrameMemory memory_;
  std::list<RecordedEvent> events_;
  std::size_t waiting_bytes_ = 0;
};

}  // namespace ols::recorder
