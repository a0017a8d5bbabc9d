// The recorder's memory. Contains the frames of the last few seconds, and the current events with
// those of their frames that are not written yet. Pure; not thread-safe.
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
  double expected_bytes = 0.0;  // estimate of the bytes still to be written
  bool closed = false;          // no more frames will be added
  std::uint64_t written = 0;    // number of frames written
  // Why EventFolder::finish() failed, after all frames were written; empty if it did not fail.
  std::string unfinished;
  double retry_s = 0.0;  // time of the next attempt to finish the event
  std::string name;      // name of the folder; only the writing thread uses `name` and `folder`
  std::optional<EventFolder> folder;
};

class EventQueue {
 public:
  explicit EventQueue(const RecorderConfig& config)
      : config_(config), memory_(config.memory_s, config.memory_max_bytes) {}

  // Takes a frame into the memory and into the events that it belongs to. Returns how many events
  // have lost this frame, because too many frames are waiting to be written.
  int add(const RecordedFrame& frame);
  // The reason to refuse the command; empty if there is none. The space on the disk is not checked
  // here.
  std::string refusal(const RecordCommand& command, double now_s) const;
  // Begins an event, with the frames of its time that are in memory. Returns the number of frames
  // that were dropped because too many are waiting to be written.
  int begin(const RecordCommand& command, std::int64_t event_utime_us);
  // The disk space that the command's frames will need at most, estimated from the frames in
  // memory.
  double expected_bytes(const RecordCommand& command) const;
  double still_to_write() const;

  // Closes the events whose last frame must have arrived by now.
  void close(double now_s);
  // Makes next() return the unfinished events at once, before their retry_s.
  void retry_all();
  struct Job {
    RecordedEvent* event = nullptr;      // valid until remove(*event)
    std::optional<RecordedFrame> frame;  // frame to write; nullopt if the event is to be finished
  };
  std::optional<Job> next(double now_s);
  void remove(const RecordedEvent& event);

  bool work_waits() const;
  bool empty() const { return events_.empty(); }
  // Folder names of the current events; an empty name for an event of which nothing is written yet.
  std::set<std::string> names() const;
  // Why an event could not be finished, if there is one; otherwise empty.
  std::string unfinished() const;

 private:
  bool enqueue(RecordedEvent& event, const RecordedFrame& frame);

  const RecorderConfig config_;
  FrameMemory memory_;
  std::list<RecordedEvent> events_;
  std::size_t waiting_bytes_ = 0;
};

}  // namespace ols::recorder
