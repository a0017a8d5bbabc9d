#include "sim/lockstep/recording.h"

#include <vector>

#include "base/bus/channel_names.h"
#include "base/bus/log_record.h"
#include "base/files/atomic_file.h"
#include "edge/messages/messages.h"

namespace ols::sim {

void write_recording(const World& world, const LockstepResult& result, const std::string& path) {
  AtomicFile file(path);
  std::vector<std::int64_t> sequences(world.stations().size(), 0);
  std::uint64_t number = 0;
  for (const ToldSighting& told : result.sightings) {
    const StationTruth& truth = world.stations()[told.station];
    station::Sender sender;
    sender.station = truth.id;
    sender.boot_id = 1 + static_cast<std::int64_t>(told.station);
    sender.clock.state = clock::ClockState::kSynchronised;
    sender.clock.error_s = truth.clock_sd_s;
    const auto message = station::to_message(told.sighting, sender, ++sequences[told.station]);
    std::vector<std::uint8_t> payload(static_cast<std::size_t>(message.getEncodedSize()));
    message.encode(payload.data(), 0, static_cast<int>(payload.size()));
    const std::vector<std::uint8_t> bytes = log_record_bytes(
        number++, told.sighting.utime_us, station_channel(kSightingChannel, truth.id), payload);
    file.stream().write(reinterpret_cast<const char*>(bytes.data()),
                        static_cast<std::streamsize>(bytes.size()));
  }
  file.commit();
}

}  // namespace ols::sim
