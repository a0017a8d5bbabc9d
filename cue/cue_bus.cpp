#include "cue/cue_bus.h"

#include <utility>

#include "base/bus/boot_id.h"
#include "base/bus/channel_names.h"
#include "cue/messages.h"

namespace ols::cues {

CueBus::CueBus(std::string url, const trust::TrustConfig& trust)
    : CueBus(std::move(url), trust, draw_boot_id()) {}

CueBus::CueBus(std::string url, const trust::TrustConfig& trust, std::int64_t boot_id)
    : BusClient(std::move(url), trust::BusTrust::open(trust, trust::process_environment(),
                                                      {.name = "cue", .boot_id = boot_id})),
      boot_id_(boot_id) {}

void CueBus::send(const std::vector<LiveCue>& cues, std::int64_t utime_us) {
  for (const LiveCue& cue : cues) {
    if (bus() == nullptr) return;
    const Stamp stamp{utime_us, boot_id_, ++sequence_};
    if (!bus()->publish(std::string(kCueChannel), to_message(cue, stamp))) {
      end("sending fails: the network is down");
    }
  }
}

}  // namespace ols::cues
