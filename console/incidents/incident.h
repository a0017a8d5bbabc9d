// An incident: one target in one area, however often it leaves and comes back. Pure.
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ols::console {

enum class Judgement { kOpen, kConfirmed, kDismissed };
std::string_view name(Judgement verdict);  // "open", "confirmed", "dismissed"
std::optional<Judgement> judgement_named(std::string_view name);

// A target's position at one time. Units: us UTC; deg, WGS84; m above the ellipsoid.
struct TrackPoint {
  std::int64_t utime_us = 0;
  double longitude_deg = 0.0, latitude_deg = 0.0, height_m = 0.0;
};

struct Incident {
  std::uint64_t number = 0;  // grows by one with each incident of this console
  std::string area;
  std::string target;  // "BOOT/NUMBER": the fusion's boot id, and its number for the target
  std::string object_class = "unknown";
  double class_probability = 0.0;          // 0: unknown
  std::int64_t begun_us = 0;               // time of the target's first position inside
  std::int64_t ended_us = 0;               // time of its last position inside, once it has left or
                                           // is lost; 0: it is still inside
  int entries = 1;                         // how often the target came in
  std::vector<std::string> stations;       // stations that saw the target when it last came in
  TrackPoint last;                         // last position that counted as inside
  std::vector<TrackPoint> track;           // positions while it was inside; thinned out as they
                                           // become more
  std::int64_t track_period_us = 500'000;  // the shortest time between two points of the track
  Judgement verdict = Judgement::kOpen;
  std::string judged_by;
  std::int64_t judged_us = 0;
  // Describes the stored picture: {"station", "utime_us", "full_px", "box_px"}; null: there is no
  // picture.
  nlohmann::json picture;

  bool is_inside() const { return ended_us == 0; }
  bool is_alarm() const { return is_inside() && verdict != Judgement::kDismissed; }
  // The number in `target`.
  std::string_view target_number() const {
    return std::string_view(target).substr(target.find('/') + 1);
  }
};

// Adds the point to the incident's track. The track has at most kMostTrackPoints points: when it is
// full, every second point is removed, and later points are added half as often.
void add_to_track(const TrackPoint& point, Incident& incident);
inline constexpr std::size_t kMostTrackPoints = 240;

// incident_from() throws std::invalid_argument; the message says what is wrong.
nlohmann::json json_of(const Incident& incident);
Incident incident_from(const nlohmann::json& json);

}  // namespace ols::console
