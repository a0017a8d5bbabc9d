#include "edge/process/skyline_thread.h"

#include <exception>
#include <utility>

#include "base/process/time_source.h"
#include "conditions/alarms.h"
#include "edge/device/behind_control_loop.h"
#include "land/terrain_folder.h"

namespace ols::station {

SkylineThread::SkylineThread(const std::string& folder, const std::string& file,
                             const skyline::SkylineOwner& owner)
    : store_(file),
      owner_(owner),
      store_alarm_(store_.trouble()),
      thread_([this, folder](const std::stop_token& stop) { work(stop, folder); }) {}

bool SkylineThread::wants(double now_s) const {
  const std::lock_guard lock(mutex_);
  return has_land_ && !works_ && now_s >= due_s_;
}

void SkylineThread::give(skyline::StatedPicture picture) {
  constexpr double kInterval_s = 5.0;
  const std::lock_guard lock(mutex_);
  due_s_ = picture.mid_exposure_s + kInterval_s;
  picture_ = std::move(picture);
  works_ = true;
  arrived_.notify_one();
}

void SkylineThread::follow(int setup, const skyline::SkylineOwner& owner) {
  const std::lock_guard lock(mutex_);
  owner_ = owner;
  if (std::exchange(setup_, setup) == setup || !has_land_) return;
  if (std::exchange(picture_, std::nullopt)) works_ = false;
  forgets_ = true;
  alarm_ = {};
  seen_.reset();
  arrived_.notify_one();
}

std::vector<Alarm> SkylineThread::alarms() const {
  std::unique_lock lock(mutex_);
  done_.wait_for(lock, time_source().for_work(), [this] { return !works_; });
  std::vector<Alarm> alarms;
  for (const Alarm& alarm : {alarm_, store_alarm_}) {
    if (!alarm.empty()) alarms.push_back(alarm);
  }
  return alarms;
}

std::optional<skyline::SkylinePart> SkylineThread::next_part(double now_s) {
  constexpr double kInterval_s = 1.0;
  const std::lock_guard lock(mutex_);
  if (!has_land_ || now_s < part_due_s_) return std::nullopt;
  part_due_s_ = now_s + kInterval_s;
  return parts_.next(seen_ ? *seen_ : skyline::HidingSkyline(), disagrees_);
}

bool SkylineThread::read_land(const std::stop_token& stop, const std::string& folder) {
  Alarm alarm;
  try {
    // Scenery was measured with the stations' headings, so it cannot be used to check them.
    watch_.emplace(land::read_terrain_folder(folder, land::Scenery::kLeftOut, stop).terrain);
  } catch (const std::exception& wrong) {
    alarm = alarm::skyline_not_compared(wrong.what());
  }
  const std::lock_guard lock(mutex_);
  has_land_ = watch_.has_value();
  alarm_ = std::move(alarm);
  works_ = false;
  done_.notify_all();
  return has_land_;
}

void SkylineThread::look(const skyline::StatedPicture& picture,
                         const skyline::SkylineOwner& owner) {
  Alarm alarm;
  try {
    if (auto found = store_.take_found(owner)) watch_->resume(*std::move(found));
    watch_->look(picture);
    alarm = watch_->alarm();
  } catch (const std::exception& wrong) {
    alarm = alarm::skyline_not_compared(wrong.what());
  }
  auto seen = std::make_shared<const skyline::HidingSkyline>(watch_->hiding());
  // After a restart, nobody would know at first that the heading is wrong.
  if (watch_->disagrees()) {
    store_.drop(owner);
  } else {
    store_.keep({owner, *seen}, picture.mid_exposure_s);
  }
  const std::lock_guard lock(mutex_);
  store_alarm_ = store_.trouble();
  if (!forgets_) {
    alarm_ = std::move(alarm);
    seen_ = std::move(seen);
    disagrees_ = watch_->disagrees();
  }
  works_ = false;
  done_.notify_all();
}

// At a start, the mount's reference is not known yet: that says nothing of what was saved.
void SkylineThread::forget(const skyline::SkylineOwner& owner) {
  if (!watch_->hiding().crests.empty()) store_.drop(owner);
  watch_->forget();
}

void SkylineThread::work(const std::stop_token& stop, const std::string& folder) {
  device::go_behind_control_loop();
  if (!read_land(stop, folder)) return;
  std::unique_lock lock(mutex_);
  // What is to be forgotten is forgotten even at a stop: the file is of the setup before.
  while (arrived_.wait(lock, stop, [this] { return picture_ || forgets_; })) {
    const auto picture = std::exchange(picture_, std::nullopt);
    const skyline::SkylineOwner owner = owner_;
    const bool forgets = std::exchange(forgets_, false);
    lock.unlock();
    if (forgets) forget(owner);
    if (picture && !stop.stop_requested()) look(*picture, owner);
    lock.lock();
  }
}

}  // namespace ols::station
