#include "edge/recorder/recorder.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstring>
#include <deque>
#include <exception>
#include <limits>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <stop_token>
#include <thread>
#include <utility>

#include "base/clocks.h"
#include "edge/recorder/event_folder.h"
#include "edge/recorder/event_store.h"
#include "edge/recorder/frame_memory.h"
#include "edge/recorder/record_command.h"

namespace ols {
namespace {

constexpr double kSurvey_s = 2.0;       // the disk is looked at so often
constexpr double kRetry_s = 2.0;        // until an event that could not be finished is tried again
constexpr double kAtEnd_s = 5.0;        // for what is unwritten when the station stops
constexpr std::size_t kMostEvents = 4;  // at the same time
constexpr int kNice = 10;               // the control loop goes first

struct Event {
  std::string label;
  std::int64_t utime_us;
  double start_s, end_s;
  std::deque<RecordedFrame> waiting;
  double expected_bytes = 0.0;  // of which so many are still to be written
  bool closed = false;          // no frame of it will come any more
  std::uint64_t written = 0;    // frames
  std::string unfinished;       // why its end failed; all its frames are on the disk
  double retry_s = 0.0;         // then its end is tried again
  std::string name;             // from here on: of the writing thread alone
  std::optional<EventFolder> folder;
};

}  // namespace

struct Recorder::Impl {
  explicit Impl(const RecorderConfig& recorder_config)
      : config(recorder_config),
        store({config.folder, config.quota_bytes, config.disk_reserve_bytes, config.protect_s}),
        memory(config.memory_s, config.memory_max_bytes) {}

  // --- of any thread

  void add(const RecordedFrame& frame) {
    const std::lock_guard lock(mutex);
    memory.add(frame);
    for (Event& event : events) {
      if (event.closed || frame.mid_exposure_s < event.start_s) continue;
      if (frame.mid_exposure_s > event.end_s) {
        event.closed = true;
      } else {
        enqueue(event, frame);
      }
    }
    wake.notify_all();
  }

  // Shares the pixels; what is too much for the memory is dropped.
  void enqueue(Event& event, const RecordedFrame& frame) {
    if (static_cast<double>(waiting_bytes + bytes_of(frame)) > config.memory_max_bytes) {
      ++frames_dropped;
      note("the disk is too slow");
      return;
    }
    event.waiting.push_back(frame);
    waiting_bytes += bytes_of(frame);
  }

  // What the frames of such a command take on the disk at most, by those that are remembered.
  double expected_bytes(const RecordCommand& command) const {
    const auto& frames = memory.frames();
    if (frames.size() < 2) return 0.0;
    const double span_s = frames.back().mid_exposure_s - frames.front().mid_exposure_s;
    return static_cast<double>(memory.bytes()) / span_s * (command.before_s + command.after_s);
  }

  double still_to_write() const {
    double bytes = 0.0;
    for (const Event& event : events) bytes += event.expected_bytes;
    return bytes;
  }

  std::string refusal_of_more(const RecordCommand& command, double now_s) {
    const double wanted = expected_bytes(command);
    if (good_s && wanted + still_to_write() > room_bytes) {
      ++refused_no_room;
      wanted_bytes = wanted;
      return "no room for " + std::to_string(std::llround(wanted * 1e-6)) + " MB";
    }
    if (rate.admit(now_s)) return {};
    ++refused_too_many;
    return "too many recordings in a short time";
  }

  std::string refusal(const RecordCommand& command, double now_s) const {
    if (std::string why = wrong_with(command, config, now_s); !why.empty()) return why;
    const bool over = command.event_s + command.after_s < now_s;
    if (over &&
        memory.between(command.event_s - command.before_s, command.event_s + command.after_s)
            .empty()) {
      return "no frame of that time is remembered";
    }
    const auto busy = static_cast<std::size_t>(
        std::ranges::count_if(events, [](const Event& e) { return e.unfinished.empty(); }));
    if (busy >= kMostEvents) return "busy with " + std::to_string(busy) + " events";
    return trouble;
  }

  std::string record(const RecordCommand& command) {
    const double now_s = clock_monotonic_s();
    const std::lock_guard lock(mutex);
    std::string why = refusal(command, now_s);
    if (why.empty()) why = refusal_of_more(command, now_s);
    if (!why.empty()) {
      ++refused;
      return why;
    }
    wanted_bytes = 0.0;
    Event event{};
    event.label = command.label;
    event.expected_bytes = expected_bytes(command);
    event.start_s = command.event_s - command.before_s;
    event.end_s = command.event_s + command.after_s;
    event.utime_us = clock_utime_us() - std::llround((now_s - command.event_s) * 1e6);
    for (const RecordedFrame& frame : memory.between(event.start_s, event.end_s)) {
      enqueue(event, frame);
    }
    events.push_back(std::move(event));
    wake.notify_all();
    return {};
  }

  void note(const std::string& what) {
    error = what;
    ++errors;
  }

  // --- of the writing thread

  void run(const std::stop_token& ended) {
    go_behind();
    double survey_s = 0.0;
    while (!ended.stop_requested()) {
      if (clock_monotonic_s() >= survey_s) {
        survey();
        survey_s = clock_monotonic_s() + kSurvey_s;
      }
      if (write_one()) continue;
      std::unique_lock lock(mutex);
      wake.wait_for(lock, ended, std::chrono::duration<double>(0.2),
                    [this] { return work_waits(); });
    }
    const double end_s = clock_monotonic_s() + kAtEnd_s;
    close_events(std::numeric_limits<double>::infinity());
    retry_all();
    while (clock_monotonic_s() < end_s && write_one()) {
    }
  }

  // Where a filter of system calls refuses it nothing is lost but the order, and that is told.
  void go_behind() {
    const auto thread_id = static_cast<id_t>(::gettid());
    if (::getpriority(PRIO_PROCESS, thread_id) >= kNice) return;
    if (::setpriority(PRIO_PROCESS, thread_id, kNice) == 0) return;
    const int failed = errno;
    const std::lock_guard lock(mutex);
    beside = std::string("runs at the control loop's priority (") + std::strerror(failed) + ")";
  }

  bool work_waits() const {
    return std::ranges::any_of(events, [](const Event& e) { return !e.waiting.empty(); });
  }

  // Condition of the disk, for the report and for the commands to come.
  void survey() {
    std::string found;
    try {
      bool in_trouble = false;
      {
        const std::lock_guard lock(mutex);
        in_trouble = !trouble.empty();
      }
      in_trouble ? store.try_writing() : store.survey();
      if (store.full()) found = store.full_text();
    } catch (const std::exception& failure) {
      found = failure.what();
    }
    set_trouble(found);
  }

  void set_trouble(const std::string& what) {
    const double room = store.room_bytes(open_names(), clock_utime_us());
    const std::lock_guard lock(mutex);
    // The room left changes all the time; only that it became too little is news.
    if (!what.empty() && trouble.empty()) note(what);
    trouble = what;
    free_bytes = store.free_bytes();
    room_bytes = room;
    stored_bytes = store.bytes();
    stored_events = store.events();
    events_removed = store.removed();
    if (what.empty()) good_s = clock_monotonic_s();
  }

  void close_events(double now_s) {
    const std::lock_guard lock(mutex);
    for (Event& event : events) {
      if (now_s > event.end_s + kLateFrame_s) event.closed = true;
    }
  }

  void retry_all() {
    const std::lock_guard lock(mutex);
    for (Event& event : events) event.retry_s = 0.0;
  }

  // One frame, or one event's end. False when there was nothing to do.
  bool write_one() {
    const double now_s = clock_monotonic_s();
    close_events(now_s);
    Event* event = nullptr;
    std::optional<RecordedFrame> frame;
    {
      const std::lock_guard lock(mutex);
      auto found = std::ranges::find_if(events, [](const Event& e) { return !e.waiting.empty(); });
      if (found == events.end()) {
        found = std::ranges::find_if(
            events, [now_s](const Event& e) { return e.closed && e.retry_s <= now_s; });
      }
      if (found == events.end()) return false;
      event = &*found;  // a list: it stays in place, and only this thread removes it
      if (!event->waiting.empty()) {
        frame = std::move(event->waiting.front());
        event->waiting.pop_front();
        waiting_bytes -= bytes_of(*frame);
      }
    }
    frame ? write_frame(*event, *frame) : end_event(*event);
    return true;
  }

  std::set<std::string> open_names() const {
    const std::lock_guard lock(mutex);
    std::set<std::string> names;
    for (const Event& event : events) names.insert(event.name);  // empty: nothing is written yet
    return names;
  }

  void write_frame(Event& event, const RecordedFrame& frame) {
    std::string failed;
    try {
      if (!event.folder) {
        store.survey();
        if (event.name.empty()) event.name = store.free_name(event.utime_us, event.label);
      }
      // A frame is hardly ever greater as PNG.
      store.make_room(static_cast<double>(bytes_of(frame)), open_names(), clock_utime_us());
      if (!event.folder) event.folder.emplace(config.folder, event.name);
      const std::size_t bytes = event.folder->write(frame, encode_png(frame));
      store.add(event.name + kPartial, static_cast<double>(bytes));
    } catch (const std::exception& failure) {
      failed = failure.what();
    }
    set_trouble(failed);
    // Somebody took the folder away: another one as soon as that is possible.
    const bool lost = event.folder && !event.folder->exists();
    if (lost) event.folder.reset();
    const std::lock_guard lock(mutex);
    if (lost) event.written = 0;
    failed.empty() ? ++frames_written : ++frames_dropped;
    if (failed.empty()) ++event.written;
    event.expected_bytes =
        std::max(0.0, event.expected_bytes - static_cast<double>(bytes_of(frame)));
  }

  void end_event(Event& event) {
    const bool vanished = event.folder && !event.folder->exists();
    if (event.folder && !vanished) {
      try {
        event.written > 0 ? event.folder->finish() : event.folder->discard();
        store.finished(event.name);
      } catch (const std::exception& failure) {
        return put_off(event, failure.what());
      }
    }
    {
      const std::lock_guard lock(mutex);
      if (vanished) note(event.name + " vanished before it was complete");
      event.written > 0 && !vanished ? ++events_written : ++events_failed;
      events.remove_if([&event](const Event& e) { return &e == &event; });
    }
    survey();
  }

  // The others go on meanwhile.
  void put_off(Event& event, const std::string& why) {
    const std::lock_guard lock(mutex);
    if (event.unfinished.empty()) note(why);
    event.unfinished = why;
    event.retry_s = clock_monotonic_s() + kRetry_s;
  }

  // What a person has to know of now: of the disk, or of an event. Empty when all is well.
  std::string wrong() const {
    if (!trouble.empty()) return trouble;
    const auto found =
        std::ranges::find_if(events, [](const Event& e) { return !e.unfinished.empty(); });
    return found == events.end() ? std::string() : found->unfinished;
  }

  const RecorderConfig config;
  EventStore store;  // of the writing thread alone

  mutable std::mutex mutex;  // of everything below
  std::condition_variable_any wake;
  FrameMemory memory;
  std::list<Event> events;
  std::size_t waiting_bytes = 0;
  std::string trouble;  // what is wrong with the disk at this moment
  std::string error;    // the last trouble
  std::string beside;   // why its thread does not stand back for the control loop; empty: it does
  std::optional<double> good_s;
  double free_bytes = 0.0, stored_bytes = 0.0, room_bytes = 0.0;
  double wanted_bytes = 0.0;  // of the last recording, where there was no room for it
  RecordRate rate;
  std::size_t stored_events = 0;
  std::uint64_t errors = 0, frames_written = 0, frames_dropped = 0, events_written = 0,
                events_failed = 0, events_removed = 0, refused = 0, refused_no_room = 0,
                refused_too_many = 0;
  std::jthread thread;  // last: it uses the rest
};

Recorder::Recorder(const RecorderConfig& config) : impl_(std::make_unique<Impl>(config)) {
  if (config.folder.empty()) return;
  impl_->thread = std::jthread([impl = impl_.get()](const std::stop_token& t) { impl->run(t); });
}

Recorder::~Recorder() = default;  // the jthread asks to stop and joins

void Recorder::add(const Frame& frame, std::int64_t utime_us) {
  if (impl_->config.folder.empty()) return;
  impl_->add({frame.raw.empty() ? frame.gray : frame.raw, frame.pixel_format, utime_us,
              frame.mid_exposure_s, frame.stamp_sd_s, frame.number});
}

std::string Recorder::record(const RecordCommand& command) { return impl_->record(command); }

DeviceReport Recorder::report() const {
  const std::lock_guard lock(impl_->mutex);
  DeviceReport report;
  report.name = "recorder";
  report.last_good_s = impl_->good_s;
  report.last_error = impl_->error;
  report.errors = impl_->errors;
  report.counters = {{"recorder_frames_written", impl_->frames_written},
                     {"recorder_frames_dropped", impl_->frames_dropped},
                     {"recorder_events_written", impl_->events_written},
                     {"recorder_events_failed", impl_->events_failed},
                     {"recorder_events_removed", impl_->events_removed},
                     {"recorder_commands_refused", impl_->refused},
                     {"recorder_refused_no_room", impl_->refused_no_room},
                     {"recorder_refused_too_many", impl_->refused_too_many}};
  report.readings = {{"disk_free_bytes", impl_->free_bytes},
                     {"recorder_events", static_cast<double>(impl_->stored_events)},
                     {"recorder_bytes", impl_->stored_bytes},
                     {"recorder_room_bytes", impl_->room_bytes}};
  if (impl_->wanted_bytes > impl_->room_bytes) {
    report.alarms.emplace_back(
        "recorder: recordings are refused, the quota is full of events that are kept: fetch some "
        "and remove them");
  }
  if (const std::string wrong = impl_->wrong(); !wrong.empty()) {
    report.state = DeviceState::kFault;
    report.text = wrong;
    report.alarms.push_back("recorder: " + wrong);
  } else if (!impl_->good_s) {
    report.state = DeviceState::kStarting;
    report.text = impl_->config.folder;
  } else {
    report.state = DeviceState::kOk;
    report.text = std::to_string(impl_->stored_events) + " events in " + impl_->config.folder;
    if (!impl_->events.empty()) report.text += ", recording";
    if (!impl_->beside.empty()) report.text += "; " + impl_->beside;
  }
  return report;
}

}  // namespace ols
