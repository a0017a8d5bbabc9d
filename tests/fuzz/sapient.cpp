// Whatever a receiver of SAPIENT says to ols-export, in any pieces. What is answered is whole.
#include <stdexcept>
#include <string>

#include "export/sapient/frame.h"
#include "export/sapient/sapient_dialogue.h"
#include "tests/fuzz/fuzz_input.h"

using namespace ols::exports;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::int64_t kNow_us = 1'795'428'930'000'000;
  ols::fuzz::Input input(data, size);
  SapientDialogue dialogue({.site = "brno"});
  try {
    while (!input.empty()) {
      const std::size_t piece = 1 + 16 * static_cast<std::size_t>(input.byte());
      for (const std::string& answer : dialogue.take(input.take(piece), kNow_us)) {
        ols::fuzz::require(framed_length(answer) == answer.size() - kFrameHead_bytes,
                           "an answer has its length");
      }
    }
  } catch (const std::runtime_error&) {
    return 0;  // no SAPIENT: the link ends
  }
  ols::fuzz::require(
      dialogue.refusal().find('\n') == std::string::npos && dialogue.last_complaint().size() <= 200,
      "what is said is short and of one line");
  return 0;
}
