// What a recorder has in memory: the frames of the last seconds, and the events that are being
// recorded with their frames that wait to be written. Pure; not for several threads at once.
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
  double expected_bytes = 0.0;  // of which so many are still to be written
  bool closed = false;          // no frame of it will come any more
  std::uint64_t written = 0;    // frames
  std::string unfinished;       // why its end failed; all its frames are on the disk
  double retry_s = 0.0;         // then its end is tried again
  std::string name;             // from here on: of the writing thread alone
  std::optional<EventFolder> folder;
};

class EventQueue {
 public:
  explicit EventQueue(const RecorderConfig& config)
      : config_(config), memory_(config.memory_s, config.memory_max_bytes) {}

  // How many frames were dropped because too much is waiting.
  int add(const RecordedFrame& frame);
  // Why the command is refused, whatever the disk is like; empty: it may begin.
  std::string refusal(const RecordCommand& command, double now_s) const;
  // How many of the frames remembered were dropped.
  int begin(const RecordCommand& command, std::int64_t event_utime_us);
  // What the frames of such a command take on the disk at most, by those that are remembered.
  double expected_bytes(const RecordCommand& command) const;
  double still_to_write() const;

  // The events whose last frame must have come by now get no more of them.
  void close(double now_s);
  // Events that could not be finished are tried again at once.
  void retry_all();
  struct Job {
    RecordedEvent* event = nullptr;      // stays in place until remove()
    std::optional<RecordedFrame> frame;  // nothing: the event is to be finished
  };
  std::optional<Job> next(double now_s);
  void remove(const RecordedEvent& event);

  bool work_waits() const;
  bool empty() const { return events_.empty(); }
  std::set<std::string> names() const;  // empty ones: nothing is written yet
  // Why an event could not be finished; empty: there is none.
  std::string unfinished() const;

 private:
  bool enqueue(RecordedEvent& event, const RecordedFrame& frame);

  const RecorderConfig config_;
  FrameMemory memory_;
  std::list<RecordedEvent> events_;
  std::size_t waiting_bytes_ = 0;
};

}  // namespace ols::recorder
