// Encodes targets, stations and lines of sight in ASTERIX, one record per datagram. Pure.
#pragma once

#include <optional>
#include <utility>

#include "export/asterix/categories.h"
#include "export/asterix/track_numbers.h"
#include "export/encoder.h"

namespace ols::exports {

class AsterixEncoder : public Encoder {
 public:
  explicit AsterixEncoder(AsterixSettings settings) : settings_(std::move(settings)) {}

  Packets encode(const Target& target) override;
  Packets encode(const Station& station) override;
  Packets encode(const Line& line) override;
  Packets due(std::int64_t utime_us) override;

 private:
  std::optional<int> sensor(const std::string& station) const;

  AsterixSettings settings_;
  TrackNumbers numbers_;
};

}  // namespace ols::exports
