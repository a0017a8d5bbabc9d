// Encodes records as Cursor on Target, one event per packet. Pure.
#pragma once

#include <optional>

#include "export/encoder.h"
#include "export/tak/cot_text.h"

namespace ols::exports {

class CotEncoder : public Encoder {
 public:
  // framing: of the protobuf encoding; nullopt: the events are XML.
  CotEncoder(CotSettings settings, std::optional<TakFraming> framing)
      : settings_(std::move(settings)), framing_(framing) {}

  Packets encode(const Target& target) override { return packet(cot_event(target, settings_)); }
  Packets encode(const Station& station) override { return packet(cot_event(station, settings_)); }
  Packets encode(const Line& line) override { return packet(cot_event(line, settings_)); }
  Packets encode_incident(const Incident& incident) override {
    return packet(cot_event(incident, settings_));
  }

 private:
  Packets packet(const CotEvent& event) const;

  CotSettings settings_;
  std::optional<TakFraming> framing_;
};

}  // namespace ols::exports
