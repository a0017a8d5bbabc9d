#include "export/outlet/queued_outlet.h"

#include <poll.h>

#include <utility>

namespace ols::exports {
namespace {

constexpr double kIdle_s = 1.0;

}  // namespace

QueuedOutlet::QueuedOutlet(std::unique_ptr<Link> link)
    : link_(std::move(link)), thread_([this] { run(); }) {}

QueuedOutlet::~QueuedOutlet() {
  ends_ = true;
  wakeup_.set();
  thread_.join();
}

void QueuedOutlet::put(Packets packets) {
  if (packets.empty()) return;
  bool may_wait = false;
  {
    const std::lock_guard lock(mutex_);
    may_wait = queue_.size() == 0;
    for (Packet& packet : packets) queue_.put(std::move(packet));
  }
  if (may_wait) wakeup_.set();
}

OutletReport QueuedOutlet::report() const {
  const std::lock_guard lock(mutex_);
  OutletReport report = report_;
  report.displaced = queue_.displaced();
  return report;
}

void QueuedOutlet::note_open() {
  const std::lock_guard lock(mutex_);
  if (link_->forgets()) queue_.clear();
  report_.is_open = true;
  report_.trouble.clear();
  ++report_.openings;
}

void QueuedOutlet::note_complaints() {
  const std::lock_guard lock(mutex_);
  report_.complaints = link_->complaints();
  report_.trouble = link_->trouble();
}

void QueuedOutlet::note_failure(const std::string& why) {
  const std::lock_guard lock(mutex_);
  report_.is_open = false;
  report_.trouble = why;
  ++report_.failures;
}

// A packet that is put after the queue was found empty sets the wakeup again.
std::optional<Packet> QueuedOutlet::next() {
  const auto taken = [this] {
    const std::lock_guard lock(mutex_);
    return queue_.take();
  };
  if (auto packet = taken()) return packet;
  wakeup_.clear();
  return taken();
}

// New packets do not shorten the pause.
void QueuedOutlet::pause(double seconds) {
  constexpr double kStep_s = 0.05;
  for (double waited_s = 0.0; waited_s < seconds && !ends_; waited_s += kStep_s) {
    ::poll(nullptr, 0, static_cast<int>(1e3 * kStep_s));
  }
}

void QueuedOutlet::serve() {
  link_->open();
  note_open();
  while (!ends_) {
    if (const auto packet = next()) {
      link_->send(*packet);
      back_off_.after_success();
      const std::lock_guard lock(mutex_);
      ++report_.sent;
      report_.bytes += packet->bytes.size();
    } else {
      link_->wait(wakeup_.descriptor(), kIdle_s);
    }
    note_complaints();
  }
  link_->say_goodbye();
  link_->close();
}

void QueuedOutlet::run() {
  while (!ends_) {
    try {
      serve();
    } catch (const LinkError& failure) {
      link_->close();
      note_failure(failure.what());
      pause(back_off_.after_failure());
    }
  }
}

}  // namespace ols::exports
