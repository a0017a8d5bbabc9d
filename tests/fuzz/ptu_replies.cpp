// What a PTU's line may say: the replies do not depend on how the bytes are split.
#include "edge/ptu/codec.h"
#include "tests/fuzz/fuzz_input.h"

namespace {

std::string said(const std::vector<ols::ptu::PtuReply>& replies) {
  std::string all;
  for (const auto& reply : replies) {
    all += reply.ok ? '*' : '!';
    all += reply.text + '\n';
  }
  return all;
}

void parse(std::string_view bytes) {
  ols::ptu::PtuReplyParser whole, split;
  std::vector<ols::ptu::PtuReply> by_byte;
  for (const char byte : bytes) {
    const auto replies = split.feed({&byte, 1});
    by_byte.insert(by_byte.end(), replies.begin(), replies.end());
  }
  ols::fuzz::require(said(whole.feed(bytes)) == said(by_byte), "split bytes give the same replies");
  ols::fuzz::require(whole.garbled() == split.garbled(), "and the same count of garbled lines");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  parse(ols::fuzz::text(data, size));
  return 0;
}
