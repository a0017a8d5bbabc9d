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

// A target's position at one time [us UTC; deg, WGS84; m above the ellipsoid].
struct TrackPoint {
  std::int64_t utime_us = 0;
  double longitude_deg = 0.0, latitude_deg = 0.0, height_m = 0.0;
};

struct Incident {
  std::uint64_t number = 0;  // grows by one with each incident of this console
  std::string area;
  std::string target;  // the fusion's boot and its number for the target: "BOOT/NUMBER"
  std::string object_class = "unknown";
  double class_probability = 0.0;          // 0: unknown
  std::int64_t begun_us = 0;               // the target's time when it was first inside
  std::int64_t ended_us = 0;               // when it left or was lost; 0: it is still inside
  int entries = 1;                         // how often it came in
  std::vector<std::string> stations;       // those that saw the target when it came in
  TrackPoint last;                         // last position that counted as inside
  std::vector<TrackPoint> track;           // while it was inside, thinned out as it grows
  std::int64_t track_period_us = 500'000;  // the shortest time between its points
  Judgement verdict = Judgement::kOpen;
  std::string judged_by;
  std::int64_t judged_us = 0;
  // About the stored picture: {"station", "utime_us", "full_px", "box_px"}; null: there is no
  // picture.
  nlohmann::json picture;

  bool is_inside() const { return ended_us == 0; }
  bool is_alarm() const { return is_inside() && verdict != Judgement::kDismissed; }
  // The target's number.
  std::string_view target_number() const {
    return std::string_view(target).substr(target.find('/') + 1);
  }
};

// Adds the point. The track keeps at most kMostTrackPoints: when it is full, every second point is
// removed, and later ones are taken half as often.
void add_to_track(const TrackPoint& point, Incident& incident);
inline constexpr std::size_t kMostTrackPoints = 240;

// incident_from() throws std::invalid_argument; its words say what is wrong.
nlohmann::json json_of(const Incident& incident);
Incident incident_from(const nlohmann::json& json);

}  // namespace ols::console
