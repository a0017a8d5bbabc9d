// The recorder's memory: the frames of the last few seconds, and the current events with their
// frames that are still to be written. Pure; not thread-safe.
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
  double expected_bytes = 0.0;  // estimated bytes still to be written
  bool closed = false;          // no more frames will be added
  std::uint64_t written = 0;    // number of frames written
  std::string unfinished;       // why the event could not be finished; its frames are all on disk
  double retry_s = 0.0;         // time of the next attempt to finish it
  std::string name;             // this member and the next one are used only by the writing thread
  std::optional<EventFolder> folder;
};

class EventQueue {
 public:
  explicit EventQueue(const RecorderConfig& config)
      : config_(config), memory_(config.memory_s, config.memory_max_bytes) {}

  // Returns the number of frames that were dropped because too many are waiting.
  int add(const RecordedFrame& frame);
  // Why the command is refused, regardless of the disk; empty if it is accepted.
  std::string refusal(const RecordCommand& command, double now_s) const;
  // Returns the number of buffered frames that were dropped.
  int begin(const RecordCommand& command, std::int64_t event_utime_us);
  // Largest disk space that the command's frames may need, estimated from those in memory.
  double expected_bytes(const RecordCommand& command) const;
  double still_to_write() const;

  // Closes the events whose last frame must have arrived.
  void close(double now_s);
  // Tries at once to finish the unfinished events.
  void retry_all();
  struct Job {
    RecordedEvent* event = nullptr;      // valid until remove()
    std::optional<RecordedFrame> frame;  // nullopt if the event is to be finished
  };
  std::optional<Job> next(double now_s);
  void remove(const RecordedEvent& event);

  bool work_waits() const;
  bool empty() const { return events_.empty(); }
  // Names of events; empty for an event of which nothing is written yet.
  std::set<std::string> names() const;
  // Why an event could not be finished; empty if there is no such event.
  std::string unfinished() const;

 private:
  bool enqueue(RecordedEvent& event, const RecordedFrame& frame);

  const RecorderConfig config_;
  FrameMemory memory_;
  std::list<RecordedEvent> events_;
  std::size_t waiting_bytes_ = 0;
};

}  // namespace ols::recorder
