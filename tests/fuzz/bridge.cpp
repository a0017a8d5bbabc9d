// Whatever other sites send, under any subject, and whatever is on the bus: only known channels go
// on, and nothing that came in goes out. And what the store of owners holds.
#include <string>

#include "bridge/messages.h"
#include "bridge/ownership/owner_record.h"
#include "bridge/passage.h"
#include "tests/fuzz/fuzz_input.h"

using namespace ols::bridge;

namespace {

constexpr Now kNow{1'795'428'930'000'000, 10.0};

PassageConfig config(bool is_region) {
  PassageConfig config;
  config.role = is_region ? Role::kRegion : Role::kSite;
  config.region = "r";
  config.site = "s";
  config.takes = {parse_selection(is_region ? "r.*.*" : "r.t.*")};
  config.commands = commands();
  config.targets = is_region;
  return config;
}

void pass(Passage& passage, const std::string& name, Bytes bytes) {
  const Headers headers{{kEpochHeader, name}, {kTargetHeader, name}};
  if (const auto channel = passage.in(name, headers, bytes, kNow)) {
    const auto content = content_of(*channel);
    ols::fuzz::require(content.has_value(), "only known channels go on");
    ols::fuzz::require(content->kind == Kind::kCommand || !passage.out(*channel, bytes, kNow),
                       "what came in does not go out");
  }
  if (const auto outgoing = passage.out(name, bytes, kNow)) {
    const auto subject = parse_subject(outgoing->subject);
    ols::fuzz::require(subject.has_value(), "only known subjects go out");
    ols::fuzz::require(channel_of(*subject) == name, "a channel is its subject's");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ols::fuzz::Input input(data, size);
  Passage passage(config((input.byte() & 1) != 0));
  while (!input.empty()) {
    const std::string_view name = input.take(input.byte());
    const std::string_view text = input.take(4 * static_cast<std::size_t>(input.byte()));
    const Bytes bytes(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
    pass(passage, std::string(name), bytes);
    pass(passage, "ols.v1.r.t.alfa.bearing", bytes);
    pass(passage, "ols.v1.r.s.alfa.cmd.slew", bytes);
    static_cast<void>(track_from(bytes));
    static_cast<void>(target_id_of(Kind::kCommand, bytes));
    if (const auto record = parse_record(std::string(text))) {
      ols::fuzz::require(parse_record(to_text(*record)).has_value(), "a record is read again");
    }
  }
  return 0;
}
