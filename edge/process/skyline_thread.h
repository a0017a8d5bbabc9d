// Compares pictures with the skyline of the land, and collects the seen skyline (docs/glossary.md).
// Has its own thread, with lower priority than the control loop. The thread first reads the land,
// which takes seconds. If the land cannot be read, there is an alarm, and the station runs without
// land.
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "edge/process/skyline_store.h"
#include "edge/skyline/skyline_part.h"
#include "edge/skyline/skyline_watch.h"

namespace ols::station {

class SkylineThread {
 public:
  // `folder`: the land, as `ols-land import` has written it. `file`: the file in which the seen
  // skyline is saved; if empty, it is not saved.
  SkylineThread(const std::string& folder, const std::string& file,
                const skyline::SkylineOwner& owner);
  // Waits until the thread has finished its current work: reading one grid of the land, or
  // comparing one picture. Further grids are not read, and a waiting picture is dropped.
  ~SkylineThread() = default;
  SkylineThread(const SkylineThread&) = delete;
  SkylineThread& operator=(const SkylineThread&) = delete;

  // Whether the thread needs a picture. It needs one every five seconds, as soon as the land has
  // been read and no other picture is being compared.
  bool wants(double now_s) const;
  // Hands a picture to the thread; never waits. Call it only if wants() has returned true.
  void give(skyline::StatedPicture picture);
  // Call in every cycle of the control loop. `setup`: Station::setup_revision(). If it has changed,
  // the seen skyline is forgotten, because it was seen with another heading, tilt or position.
  void follow(int setup, const skyline::SkylineOwner& owner);
  std::vector<Alarm> alarms() const;
  // Returns the next part of the seen skyline, for publication, once a second; otherwise nullopt.
  // Also nullopt without land.
  std::optional<skyline::SkylinePart> next_part(double now_s);

 private:
  void work(const std::stop_token& stop, const std::string& folder);
  bool read_land(const std::stop_token& stop, const std::string& folder);
  void look(const skyline::StatedPicture& picture, const skyline::SkylineOwner& owner);
  void forget(const skyline::SkylineOwner& owner);

  // Used by the thread only.
  std::optional<skyline::SkylineWatch> watch_;
  SkylineStore store_;

  mutable std::mutex mutex_;  // guards all members below
  std::condition_variable_any arrived_;
  mutable std::condition_variable done_;
  std::optional<skyline::StatedPicture> picture_;
  bool has_land_ = false;
  bool works_ = true;     // the land is being read, or a picture is waiting or being compared
  bool forgets_ = false;  // true: forget the seen skyline before the next picture
  double due_s_ = 0.0, part_due_s_ = 0.0;
  int setup_ = 0;
  skyline::SkylineOwner owner_;
  Alarm alarm_, store_alarm_;
  std::shared_ptr<const skyline::HidingSkyline> seen_;  // null if no skyline was seen
  bool disagrees_ = false;                              // the pictures disagree with the heading
  skyline::SkylineParts parts_;
  std::jthread thread_;  // last member, because it uses the others
};

}  // namespace ols::station
