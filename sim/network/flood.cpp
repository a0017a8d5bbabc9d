#include "sim/network/flood.h"

#include <array>
#include <utility>

#include "base/bus/channel_names.h"
#include "ols_msg/bearing_t.hpp"
#include "ols_msg/designate_t.hpp"
#include "ols_msg/fusion_status_t.hpp"
#include "ols_msg/preview_t.hpp"
#include "ols_msg/ptu_command_t.hpp"
#include "ols_msg/record_t.hpp"
#include "ols_msg/slew_t.hpp"
#include "ols_msg/station_status_t.hpp"
#include "ols_msg/target_t.hpp"

namespace ols::sim {
namespace {

constexpr int kLongestName = 63;    // of an LCM channel
constexpr int kMostRubbish = 1400;  // [byte]
constexpr int kFingerprint = 8;     // [byte]

template <class Message>
std::vector<std::uint8_t> encoded() {
  const Message message{};
  std::vector<std::uint8_t> data(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(data.data(), 0, static_cast<int>(data.size()));
  return data;
}

struct Channel {
  std::string_view name;
  bool of_station;
  std::vector<std::uint8_t> (*message)();
};

constexpr std::array kChannels = {
    Channel{kBearingChannel, true, encoded<ols_msg::bearing_t>},
    Channel{kStatusChannel, true, encoded<ols_msg::station_status_t>},
    Channel{kSlewChannel, true, encoded<ols_msg::slew_t>},
    Channel{kPtuChannel, true, encoded<ols_msg::ptu_command_t>},
    Channel{kDesignateChannel, true, encoded<ols_msg::designate_t>},
    Channel{kRecordChannel, true, encoded<ols_msg::record_t>},
    Channel{kPreviewChannel, true, encoded<ols_msg::preview_t>},
    Channel{kTargetChannel, false, encoded<ols_msg::target_t>},
    Channel{kFusionStatusChannel, false, encoded<ols_msg::fusion_status_t>},
};

}  // namespace

Flood::Flood(std::vector<std::string> stations, int names, std::uint64_t seed)
    : stations_(std::move(stations)), names_(names), random_(seed) {}

// Without std::uniform_int_distribution, whose results differ between libraries.
int Flood::below(int limit) {
  return static_cast<int>(random_() % static_cast<std::uint64_t>(limit));
}

std::vector<std::uint8_t> Flood::rubbish(int most_bytes) {
  std::vector<std::uint8_t> data(static_cast<std::size_t>(below(most_bytes + 1)));
  for (std::uint8_t& byte : data) byte = static_cast<std::uint8_t>(random_());
  return data;
}

std::string Flood::foreign_channel() {
  // A name is a function of its number, so that there are no more names than asked for.
  const int number = below(names_);
  std::string name = "X";
  name += std::to_string(number);
  name += '_';
  while (static_cast<int>(name.size()) < 8 + number % (kLongestName - 8)) name.push_back('x');
  return name;
}

// One of the site's own channels, sometimes for a non-existent station with a huge number.
Packet Flood::damaged() {
  const Channel& channel = kChannels[static_cast<std::size_t>(below(kChannels.size()))];
  std::string name(channel.name);
  if (channel.of_station) {
    const int which = below(static_cast<int>(stations_.size()) + 1);
    name += which < static_cast<int>(stations_.size())
                ? stations_[static_cast<std::size_t>(which)]
                : std::to_string(2'000'000'000 + below(names_));
  }
  if (below(2) == 0) return {name, rubbish(kMostRubbish)};
  std::vector<std::uint8_t> data = channel.message();
  data.resize(kFingerprint);
  const std::vector<std::uint8_t> rest = rubbish(kMostRubbish);
  data.insert(data.end(), rest.begin(), rest.end());
  return {name, std::move(data)};
}

Packet Flood::next() {
  if (below(2) == 0) return damaged();
  return {foreign_channel(), rubbish(kMostRubbish)};
}

Packet unknown_channel(std::uint64_t number) {
  return {"SOMEBODY_ELSES_CHANNEL_" + std::to_string(number), std::vector<std::uint8_t>(16)};
}

}  // namespace ols::sim
