// Compares pictures with the skyline of the land in its own thread, with lower priority than the
// control loop, and keeps what hides targets. The thread also reads the land, which takes seconds:
// a folder that cannot be read is an alarm, and the station runs without it.
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
  // `file`: where the seen skyline is saved; if empty, it is not.
  SkylineThread(const std::string& folder, const std::string& file,
                const skyline::SkylineOwner& owner);
  // Waits until the grid that is being read has been read, or the picture been compared. Other
  // grids are not read any more, and a picture that is still waiting is dropped.
  ~SkylineThread() = default;
  SkylineThread(const SkylineThread&) = delete;
  SkylineThread& operator=(const SkylineThread&) = delete;

  // Whether a picture is wanted: some seconds after the last one, once the land has been read.
  bool wants(double now_s) const;
  // Never waits. Call it only if wants() says so.
  void give(skyline::StatedPicture picture);
  // `setup`: Station::setup_revision(). If it has changed, all that has been seen is forgotten.
  void follow(int setup, const skyline::SkylineOwner& owner);
  std::vector<Alarm> alarms() const;
  // A part of the seen skyline, once a second; nullopt while none is due, or no land is known.
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
  bool forgets_ = false;  // before the next picture
  double due_s_ = 0.0, part_due_s_ = 0.0;
  int setup_ = 0;
  skyline::SkylineOwner owner_;
  Alarm alarm_, store_alarm_;
  std::shared_ptr<const skyline::HidingSkyline> seen_;  // null: nothing
  bool disagrees_ = false;                              // the heading
  skyline::SkylineParts parts_;
  std::jthread thread_;  // last member, because it uses the others
};

}  // namespace ols::station
