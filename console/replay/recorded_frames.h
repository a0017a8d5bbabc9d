// Reads the frames that a station's recorder has kept (docs/field-guide.md): folders of events with
// frames.csv and PNG files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "console/received.h"

namespace ols::console {

class RecordedFrames {
 public:
  // Adds the events in a recorder's folder. Throws std::invalid_argument naming the folder if it
  // cannot be listed or has no event. A damaged row or event is skipped and reported in problems().
  void add(const std::string& station, const std::string& folder);

  // The station's newest frame at this time. nullopt if the frame is older than kOld_us, or if the
  // last call has already returned it.
  std::optional<Picture> newest(const std::string& station, std::int64_t utime_us);
  // Lets newest() return the same frames once more.
  void give_again() {
    for (auto& [station, frames] : stations_) frames.given_us = 0;
  }
  // An array of {station, name, first_us, last_us, frames}.
  const Json& events() const { return events_; }
  const std::vector<std::string>& problems() const { return problems_; }
  std::vector<std::string> stations() const;

  static constexpr std::int64_t kOld_us = 1'000'000;
  static constexpr std::size_t kMostFrames = 200'000;  // of all events together
  static constexpr std::size_t kMostFrameBytes = 64'000'000;

 private:
  struct Frames {
    std::map<std::int64_t, std::string> files;  // by time [us UTC]
    std::int64_t given_us = 0;
  };
  void add_event(const std::string& station, const std::string& path, const std::string& name);
  void problem(const std::string& text);

  std::map<std::string, Frames> stations_;
  Json events_ = Json::array();
  std::vector<std::string> problems_;
  std::size_t frames_ = 0;
};

// Width and height from the header of a PNG file; nullopt if the bytes are not a PNG file.
std::optional<std::pair<int, int>> png_size(const std::string& png);

}  // namespace ols::console
