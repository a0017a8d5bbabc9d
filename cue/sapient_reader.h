// Reads SAPIENT (BSI Flex 335 v2.0): the detections of other nodes, as a SAPIENT middleware passes
// them on. Pure.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>

#include "cue/reading.h"
#include "geometry/wgs84.h"
#include "sapient/sapient.pb.h"

namespace ols::cues {

// Height of the geoid above the ellipsoid [m] at a latitude and longitude [deg]; not finite:
// unknown.
using GeoidHeight = std::function<double(double, double)>;

class SapientReader {
 public:
  // If `geoid_m` is empty, heights above the geoid are refused.
  explicit SapientReader(GeoidHeight geoid_m) : geoid_m_(std::move(geoid_m)) {}

  // `message`: without the four bytes of its length. Returns no reading for a message that is not a
  // detection.
  Readings take(const std::string& message);

 private:
  // What must be known about a node before its detections can be read: they may be relative to the
  // node's place, and use the units that the node has registered.
  struct Node {
    std::optional<Geodetic> place;
    double speed_unit_m_s = 1.0;
    std::string utm_zone;  // for locations that state no UTM zone
  };
  Reading reading_of(const exports::sapient::DetectionReport& report, const std::string& node,
                     std::int64_t utime_us) const;
  static void note_registration(Node& node, const exports::sapient::Registration& registration);
  // Each sets values of the report; if that is impossible, returns why.
  std::optional<Refusal> place(Report& report, const exports::sapient::Location& location,
                               const Node& from) const;
  std::optional<Refusal> set_height(Report& report,
                                    const exports::sapient::Location& location) const;
  static std::optional<Refusal> place(Report& report, const exports::sapient::RangeBearing& sight,
                                      const Node& from);
  void note_place(Node& node, const exports::sapient::Location& where);
  Node* node(const std::string& id);

  static constexpr std::size_t kMost = 1000;
  GeoidHeight geoid_m_;
  std::map<std::string, Node> nodes_;
};

}  // namespace ols::cues
