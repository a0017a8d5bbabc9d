// What an ONVIF camera may answer: whatever the bytes are, a number that is read is finite, a span
// is not empty, and an error has words.
#include <cmath>

#include "edge/mount/onvif/soap_answer.h"
#include "tests/fuzz/fuzz_input.h"

namespace {

namespace onvif = ols::onvif;

template <class Read>
void attempt(Read read) {
  try {
    read();
  } catch (const onvif::AnswerError& error) {
    ols::fuzz::require(*error.what() != '\0', "an error has words");
  }
}

void check(const std::optional<onvif::Space>& space) {
  if (!space) return;
  ols::fuzz::require(space->x.min < space->x.max && space->y.min < space->y.max,
                     "a span is not empty");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string answer(ols::fuzz::text(data, size));
  attempt([&] { static_cast<void>(onvif::date_and_time(answer)); });
  attempt([&] { static_cast<void>(onvif::device_information(answer)); });
  attempt([&] { static_cast<void>(onvif::services(answer)); });
  attempt([&] { static_cast<void>(onvif::profiles(answer)); });
  attempt([&] {
    const onvif::PtzOptions options = onvif::options(answer);
    for (const auto& space : {options.absolute, options.relative, options.continuous}) check(space);
  });
  attempt([&] {
    const onvif::PtzStatus status = onvif::status(answer);
    ols::fuzz::require(
        std::isfinite(status.x) && std::isfinite(status.y) && status.zoom.value_or(0.0) >= 0.0,
        "a position is finite");
  });
  attempt([&] { onvif::check_done(answer, "Stop"); });
  return 0;
}
