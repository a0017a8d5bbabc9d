// Every generated decoder behind decode_exactly(): refused, or encoded again. The first byte
// chooses the type.
#include <array>

#include "base/bus/lcm_bus.h"
#include "ols_msg/bearing_t.hpp"
#include "ols_msg/command_reply_t.hpp"
#include "ols_msg/cue_order_t.hpp"
#include "ols_msg/cue_t.hpp"
#include "ols_msg/designate_t.hpp"
#include "ols_msg/fusion_status_t.hpp"
#include "ols_msg/incident_t.hpp"
#include "ols_msg/lens_command_t.hpp"
#include "ols_msg/occlusion_t.hpp"
#include "ols_msg/preview_t.hpp"
#include "ols_msg/ptu_command_t.hpp"
#include "ols_msg/record_t.hpp"
#include "ols_msg/sighting_t.hpp"
#include "ols_msg/sim_fault_t.hpp"
#include "ols_msg/skyline_t.hpp"
#include "ols_msg/slew_t.hpp"
#include "ols_msg/station_status_t.hpp"
#include "ols_msg/target_t.hpp"
#include "tests/fuzz/fuzz_input.h"

namespace {

template <class Message>
void decode(std::string_view bytes) {
  Message message;
  if (!ols::decode_exactly(bytes.data(), static_cast<int>(bytes.size()), message)) return;
  // One that it has grown from is shorter (lcmtypes/README.md).
  ols::fuzz::require(message.getEncodedSize() >= static_cast<int>(bytes.size()),
                     "what was decoded is as long as it was");
  std::vector<char> again(static_cast<std::size_t>(message.getEncodedSize()));
  const int written = message.encode(again.data(), 0, static_cast<int>(again.size()));
  // A text with a zero in it ends there when it is encoded.
  ols::fuzz::require(written > 0 && written <= static_cast<int>(again.size()), "and is encoded");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static constexpr std::array kDecoders = {
      decode<ols_msg::bearing_t>,        decode<ols_msg::designate_t>,
      decode<ols_msg::fusion_status_t>,  decode<ols_msg::preview_t>,
      decode<ols_msg::ptu_command_t>,    decode<ols_msg::record_t>,
      decode<ols_msg::sim_fault_t>,      decode<ols_msg::slew_t>,
      decode<ols_msg::station_status_t>, decode<ols_msg::target_t>,
      decode<ols_msg::lens_command_t>,   decode<ols_msg::cue_t>,
      decode<ols_msg::cue_order_t>,      decode<ols_msg::sighting_t>,
      decode<ols_msg::command_reply_t>,  decode<ols_msg::incident_t>,
      decode<ols_msg::occlusion_t>,      decode<ols_msg::skyline_t>};
  ols::fuzz::Input input(data, size);
  const std::size_t kind = input.byte();
  kDecoders[kind % kDecoders.size()](input.rest());
  return 0;
}
