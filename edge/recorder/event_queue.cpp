#include "edge/recorder/event_queue.h"

#include <algorithm>

#include "edge/recorder/record_command.h"

namespace ols::recorder {
namespace {

constexpr std::size_t kMostEvents = 4;  // at the same time

bool has_frames(const RecordedEvent& event) { return !event.waiting.empty(); }

}  // namespace

int EventQueue::add(const RecordedFrame& frame) {
  int dropped = 0;
  memory_.add(frame);
  for (RecordedEvent& event : events_) {
    if (event.closed || frame.mid_exposure_s < event.start_s) continue;
    if (frame.mid_exposure_s > event.end_s) {
      event.closed = true;
    } else if (!enqueue(event, frame)) {
      ++dropped;
    }
  }
  return dropped;
}

// Shares the pixels; drops frames beyond the memory limit.
bool EventQueue::enqueue(RecordedEvent& event, const RecordedFrame& frame) {
  if (static_cast<double>(waiting_bytes_ + bytes_of(frame)) > config_.memory_max_bytes) {
    return false;
  }
  event.waiting.push_back(frame);
  waiting_bytes_ += bytes_of(frame);
  return true;
}

std::string EventQueue::refusal(const RecordCommand& command, double now_s) const {
  if (std::string why = wrong_with(command, config_, now_s); !why.empty()) return why;
  const double from_s = command.event_s - command.before_s;
  const double to_s = command.event_s + command.after_s;
  if (to_s < now_s && memory_.between(from_s, to_s).empty()) {
    return "no frame of that time is in memory";
  }
  const auto busy = static_cast<std::size_t>(
      std::ranges::count_if(events_, &std::string::empty, &RecordedEvent::unfinished));
  return busy >= kMostEvents ? "busy with " + std::to_string(busy) + " events" : "";
}

int EventQueue::begin(const RecordCommand& command, std::int64_t event_utime_us) {
  RecordedEvent event;
  event.label = command.label;
  event.expected_bytes = expected_bytes(command);
  event.start_s = command.event_s - command.before_s;
  event.end_s = command.event_s + command.after_s;
  event.utime_us = event_utime_us;
  int dropped = 0;
  for (const RecordedFrame& frame : memory_.between(event.start_s, event.end_s)) {
    if (!enqueue(event, frame)) ++dropped;
  }
  events_.push_back(std::move(event));
  return dropped;
}

double EventQueue::expected_bytes(const RecordCommand& command) const {
  const auto& frames = memory_.frames();
  if (frames.size() < 2) return 0.0;
  const double span_s = frames.back().mid_exposure_s - frames.front().mid_exposure_s;
  return static_cast<double>(memory_.bytes()) / span_s * (command.before_s + command.after_s);
}

double EventQueue::still_to_write() const {
  double bytes = 0.0;
  for (const RecordedEvent& event : events_) bytes += event.expected_bytes;
  return bytes;
}

void EventQueue::close(double now_s) {
  for (RecordedEvent& event : events_) {
    if (now_s > event.end_s + kLateFrame_s) event.closed = true;
  }
}

void EventQueue::retry_all() {
  for (RecordedEvent& event : events_) event.retry_s = 0.0;
}

std::optional<EventQueue::Job> EventQueue::next(double now_s) {
  auto found = std::ranges::find_if(events_, has_frames);
  if (found == events_.end()) {
    found = std::ranges::find_if(events_, [now_s](const RecordedEvent& event) {
      return event.closed && event.retry_s <= now_s;
    });
  }
  if (found == events_.end()) return std::nullopt;
  Job job{&*found, std::nullopt};
  if (has_frames(*found)) {
    job.frame = std::move(found->waiting.front());
    found->waiting.pop_front();
    waiting_bytes_ -= bytes_of(*job.frame);
  }
  return job;
}

void EventQueue::remove(const RecordedEvent& event) {
  events_.remove_if([&event](const RecordedEvent& other) { return &other == &event; });
}

bool EventQueue::work_waits() const { return std::ranges::any_of(events_, has_frames); }

std::set<std::string> EventQueue::names() const {
  std::set<std::string> names;
  for (const RecordedEvent& event : events_) names.insert(event.name);
  return names;
}

std::string EventQueue::unfinished() const {
  for (const RecordedEvent& event : events_) {
    if (!event.unfinished.empty()) return event.unfinished;
  }
  return {};
}

}  // namespace ols::recorder
