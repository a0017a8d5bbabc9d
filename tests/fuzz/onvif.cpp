// What an ONVIF camera may answer, also to those who look for it: whatever the bytes are, a number
// that is read is finite, a span is not empty, and an error has words.
#include <cmath>

#include "edge/mount/onvif/discovery.h"
#include "edge/mount/onvif/service_address.h"
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
  attempt([&] { static_cast<void>(onvif::listed_services(answer)); });
  for (const auto& read : {onvif::profiles, onvif::media2_profiles})
    attempt([&] {
      for (const onvif::Profile& profile : read(answer))
        ols::fuzz::require(!profile.token.empty() && std::isfinite(profile.frame_rate_hz),
                           "a profile has a token and a finite rate");
    });
  for (const auto& read : {onvif::options, onvif::node_options})
    attempt([&] {
      const onvif::PtzOptions options = read(answer);
      for (const auto& space : {options.absolute, options.relative, options.continuous})
        check(space);
    });
  attempt([&] {
    const onvif::PtzStatus status = onvif::status(answer);
    ols::fuzz::require(
        std::isfinite(status.x) && std::isfinite(status.y) && status.zoom.value_or(0.0) >= 0.0,
        "a position is finite");
  });
  attempt([&] { onvif::check_done(answer, "Stop"); });
  for (const auto& read : {onvif::stream_uri, onvif::media2_stream_uri})
    attempt([&] {
      const std::string url = onvif::stream_address("http://cam/d", read(answer));
      ols::fuzz::require(url.empty() || onvif::host_of(url) == "cam", "a stream is at the camera");
    });
  onvif::Discovery discovery("urn:uuid:1");
  discovery.add(answer, "10.0.0.5");
  for (const auto& camera : discovery.cameras())
    ols::fuzz::require(onvif::host_of(camera.url) == "10.0.0.5", "a camera is where it answered");
  return 0;
}
