// Whatever reaches the console from outside: a browser's messages and requests, users' files, the
// map's queries, and the bus. An input is a run of parts, each behind a byte that says what it is
// and two with its length.
#include "console/console.h"

#include <stdexcept>

#include "console/map_geometry.h"
#include "console/messages.h"
#include "console/messages_pictures.h"
#include "console/web_api.h"
#include "tests/fuzz/fuzz_input.h"

namespace {

using namespace ols::console;

constexpr Now kNow{1000.0, 1'700'000'000'000'000};

ols::BusMessage on(const char* channel, std::string_view bytes) {
  ols::BusMessage message;
  message.channel = channel;
  message.payload.assign(bytes.begin(), bytes.end());
  return message;
}

void receive(Console& console, std::string_view bytes) {
  if (const auto heard = station_from(on("OLS_STATUS_a", bytes))) console.receive(*heard, kNow);
  if (const auto heard = bearing_from(on("OLS_BEARING_a", bytes))) {
    console.receive_bearing(heard->first, heard->second);
  }
  if (const auto heard = target_from(on("OLS_TARGET", bytes))) console.receive(*heard, kNow);
  if (const auto heard = fusion_from(on("OLS_FUSION_STATUS", bytes))) console.receive(*heard, kNow);
  if (auto heard = picture_from(on("OLS_PREVIEW_a", bytes))) console.receive(std::move(*heard));
}

// A request whose parts are separated by zeros.
void ask(WebApi& api, std::string_view bytes) {
  ols::fuzz::Input input(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  WebRequest request;
  for (std::string* part : {&request.method, &request.path, &request.host, &request.origin,
                            &request.cookies, &request.content_type, &request.body}) {
    const std::size_t length = input.byte();
    *part = input.take(length);
  }
  const auto answer = api.answer(request, kNow);
  if (const auto* response = std::get_if<WebResponse>(&answer)) {
    ols::fuzz::require(response->status >= 200 && response->status < 600, "a status of HTTP");
  }
  static_cast<void>(api.admit(request, kNow));
}

void read_users(std::string_view bytes) {
  try {
    const Users users = parse_users(std::string(bytes), "fuzz");
    ols::fuzz::require(parse_users(users_text(users), "again").size() == users.size(),
                       "users are read as they are written");
  } catch (const std::invalid_argument& error) {
    ols::fuzz::require(std::string(error.what()).starts_with("fuzz"), "an error names the file");
  }
}

void talk(Console& console, std::uint64_t viewer, std::string_view bytes) {
  console.take(viewer, bytes, kNow);
  const auto parsed = parse_client_message(bytes);
  if (const auto* request = std::get_if<CommandRequest>(&parsed)) {
    ols::fuzz::require(!request->order.station.empty(), "an order names its station");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Console console(60.0);
  WebApi api(
      {}, {{"ana", {Role::kAdmin, "$argon2id$x"}}}, console, [] { return std::string("token"); },
      [](const Users&) {});
  const auto viewer = console.open("ana", Role::kOperator);
  ols::fuzz::Input input(data, size);
  while (!input.empty()) {
    const auto kind = input.byte();
    const std::size_t length = input.byte() | static_cast<std::size_t>(input.byte()) << 8U;
    const std::string_view part = input.take(length);
    if (kind % 5 == 0) talk(console, viewer, part);
    if (kind % 5 == 1) receive(console, part);
    if (kind % 5 == 2) ask(api, part);
    if (kind % 5 == 3) read_users(part);
    if (kind % 5 == 4) {
      static_cast<void>(measure(std::string(part)));
      static_cast<void>(utm_grid(std::string(part)));
    }
  }
  static_cast<void>(console.turn(kNow));
  while (console.next(viewer, kNow)) {
  }
  return 0;
}
