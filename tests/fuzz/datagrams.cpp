// Everything that reads the bus, from the datagram on: a station, the fusion, the recorder, the
// operator's programs. An input is a run of datagrams, each behind its length in two bytes; an odd
// length stands for a datagram of one of the site's channels, whose header is put before it.
#include <array>
#include <filesystem>
#include <optional>

#include "base/bus/bus_inbox.h"
#include "base/text/plain_text.h"
#include "central/app/messages.h"
#include "central/fusion/fusion.h"
#include "edge/messages/messages_bus.h"
#include "tests/fuzz/fuzz_input.h"
#include "tests/fuzz/no_tracker.h"
#include "tools/logger/log_writer.h"
#include "wire/station_status.h"

namespace {

constexpr double kNow_s = 1000.0;
constexpr std::int64_t kNow_us = 1'700'000'000'000'000;
constexpr ols::QueueLimits kLimits{.messages = 16, .bytes = 20'000};

ols::station::StationSettings settings() {
  ols::station::StationSettings made;
  made.id = "a";
  return made;
}

// A log of the process's own that never grows for long.
class Recorder {
 public:
  void write(const ols::BusMessage& message) {
    if (!writer_ || writer_->bytes() > 1'000'000) begin();
    writer_->write(message);
  }

 private:
  void begin() {
    writer_.reset();
    std::filesystem::remove(path_);
    writer_.emplace(path_);
  }
  std::string path_ = "/dev/shm/ols-fuzz-" + std::to_string(getpid()) + ".lcmlog";
  std::optional<ols::logger::LogWriter> writer_;
};

void to_fusion(ols::fusion::Fusion& fusion, const ols::BusMessage& message) {
  const int size = static_cast<int>(message.payload.size());
  const auto measurement =
      ols::fusion::measurement_from(message.channel, message.payload.data(), size);
  if (const auto* seen = std::get_if<ols::fusion::BearingMeasurement>(&measurement)) {
    static_cast<void>(fusion.add(*seen));
  }
}

void to_person(const ols::BusMessage& message) {
  const auto status = ols::wire::decode_status(message);
  if (!status) return;
  for (const auto* texts : {&status->device_name, &status->device_text, &status->alarm,
                            &status->reading_name, &status->counter_name}) {
    for (const std::string& text : *texts) {
      ols::fuzz::require(ols::plain_text(text) == text, "a status is plain text");
    }
  }
  ols::fuzz::require(ols::plain_text(status->station) == status->station, "so is a name");
}

std::string datagram_of(ols::fuzz::Input& input) {
  static constexpr std::array kChannels = {
      "OLS_SLEW_a",   "OLS_PTU_a",     "OLS_DESIGNATE_a",   "OLS_RECORD_a",
      "OLS_STATUS_a", "OLS_BEARING_a", "OLS_FUSION_STATUS", "X"};
  const std::size_t length = input.byte() | static_cast<std::size_t>(input.byte()) << 8U;
  if (length % 2 == 0) return std::string(input.take(length / 2));
  const std::string channel = kChannels[input.byte() % kChannels.size()];
  return "LC02abcd" + channel + std::string(1, '\0') + std::string(input.take(length / 2));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const ols::station::StationSettings kSettings = settings();
  static Recorder recorder;
  ols::station::Station station(kSettings.station, std::make_unique<ols::fuzz::NoTracker>());
  ols::station::CommandTurn turn(station);
  ols::station::StationBus station_bus(
      kSettings, 1, station, turn,
      [](const ols::recorder::RecordCommand&) { return std::string(); });
  station_bus.set_time({kNow_s, kNow_us}, {});
  ols::fusion::Fusion fusion({});
  ols::BusInbox inbox;
  const auto to_station = [&](const ols::BusMessage& message) { station_bus.take(message); };
  const auto stop = [&](const ols::BusMessage& message) { return station_bus.take_stop(message); };
  inbox.subscribe("OLS_PTU_a", to_station, kLimits, stop);
  inbox.subscribe("OLS_(SLEW|DESIGNATE|RECORD)_a", to_station, kLimits);
  inbox.subscribe(
      "OLS_BEARING_.*", [&](const auto& m) { to_fusion(fusion, m); }, kLimits);
  inbox.subscribe("OLS_STATUS_.*", to_person, kLimits);
  inbox.subscribe(
      ".*", [&](const auto& m) { recorder.write(m); }, kLimits);
  ols::fuzz::Input input(data, size);
  while (!input.empty()) {
    const std::string bytes = datagram_of(input);
    inbox.put({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, kNow_us);
    if (bytes.size() % 3 == 0) inbox.handle_one(0);
  }
  while (inbox.handle_one(0)) {
  }
  station_bus.end_turn();
  return 0;
}
