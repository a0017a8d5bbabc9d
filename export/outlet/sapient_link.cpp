#include "export/outlet/sapient_link.h"

#include <exception>
#include <utility>

#include "base/process/clocks.h"
#include "export/sapient/registration.h"
#include "export/sapient/sapient_messages.h"

namespace ols::exports {
namespace {

constexpr double kTroubled_s = 10.0;  // after a complaint
constexpr int kNoWakeup = -1;
// Answers to what is received at once: each may wait for a receiver that reads slowly.
constexpr std::size_t kMostAnswers = 16;

}  // namespace

SapientLink::SapientLink(const Address& address, TlsFiles files, SapientSettings settings)
    : StreamLink(address, std::move(files)), settings_(settings), dialogue_(std::move(settings)) {}

void SapientLink::open() {
  StreamLink::open();
  dialogue_.clear();
  StreamLink::send({"", sapient_registration(settings_, clock_utime_us())});
  const double end_s = clock_monotonic_s() + kPatience_s;
  while (!dialogue_.acceptance()) {
    const double left_s = end_s - clock_monotonic_s();
    if (left_s <= 0.0) throw error("does not acknowledge the registration");
    wait(kNoWakeup, left_s);
  }
}

void SapientLink::say_goodbye() {
  StreamLink::send({"", sapient_goodbye(settings_, clock_utime_us())});
}

// Also hears the receiver, because a busy sender does not wait for anything.
void SapientLink::send(const Packet& packet) {
  StreamLink::send(packet);
  wait(kNoWakeup, 0.0);
}

void SapientLink::heard(std::string_view bytes) {
  const std::uint64_t complaints = dialogue_.complaints();
  std::vector<std::string> answers;
  try {
    answers = dialogue_.take(bytes, clock_utime_us());
  } catch (const std::exception& nonsense) {
    throw error(nonsense.what());
  }
  if (dialogue_.complaints() != complaints) complained_s_ = clock_monotonic_s();
  if (dialogue_.acceptance() == false)
    throw error("refuses the registration: " + dialogue_.refusal());
  if (answers.size() > kMostAnswers) throw error("floods tasks");
  for (const std::string& answer : answers) StreamLink::send({"", answer});
}

std::string SapientLink::trouble() const {
  if (dialogue_.complaints() == 0 || clock_monotonic_s() - complained_s_ > kTroubled_s) return {};
  return "complains: " + dialogue_.last_complaint();
}

}  // namespace ols::exports
