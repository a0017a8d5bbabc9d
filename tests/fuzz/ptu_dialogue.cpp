// The PTU's driver at work, on a line that answers anything at all, and on one that damages what a
// real dialogue says, with an operator who homes, stops and vouches in between: the unit stays
// within the limits unless it homes, stands after an emergency stop, is not told to home in one,
// and samples are finite. Some hundred steps an input: slower than the other fuzzers.
#include <cmath>

#include "edge/ptu/driver.h"
#include "sim/ptu/unit.h"
#include "tests/fuzz/fuzz_input.h"

namespace {

void check(ols::ptu::PtuDriver& driver) {
  for (const auto& sample : driver.take_samples()) {
    ols::fuzz::require(std::isfinite(sample.angles.pan_rad) &&
                           std::isfinite(sample.angles.tilt_rad) && sample.time_sd_s >= 0.0,
                       "samples are finite");
  }
}

// What a person or the station may do at any moment; most bytes do nothing.
void interfere(ols::ptu::PtuDriver& driver, std::uint8_t what, double now_s) {
  switch (what) {
    case 1:
      return driver.home(now_s);
    case 2:
      return driver.stop_homing(now_s);
    case 3:
      static_cast<void>(driver.emergency_halt(now_s));
      return;
    case 4:
      return driver.clear_emergency();
    case 5:
    case 10:
    case 11:
    case 12: {
      return driver.restore_doubt(
          ols::mount::doubt_from_word(ols::mount::doubt_words().at(what == 5 ? 1 : what - 8)));
    }
    case 6:
      return driver.reference_ok();
    case 7:
      return driver.restart(now_s);
    case 8:
    case 9:
      return driver.allow_rehoming(what == 8);
    default:
      return;
  }
}

ols::ptu::PtuConfig config() {
  ols::ptu::PtuConfig made;
  made.baud = 38400;
  made.poll_interval_s = 0.025;
  return made;
}

// A line on which each request is answered by the next piece of the input; pieces end at a zero,
// and begin with what else happens.
void drive(std::string_view rest) {
  ols::ptu::PtuConfig wanted = config();
  wanted.rehome = ols::ptu::PtuRehome::kWhenUnreferenced;
  ols::ptu::PtuDriver driver(wanted);
  driver.restart(0.0);
  double now_s = 0.0;
  for (int step = 0; step < 400 && !rest.empty(); ++step) {
    now_s += 0.01;
    driver.set_goal(ols::mount::Goal{now_s, {0.3, 0.1}, {0.2, 0.0}, now_s + 0.5});
    const std::string request = driver.step(now_s);
    ols::fuzz::require(request.size() < 512, "requests are short");
    ols::fuzz::require(!driver.in_emergency() || request.find(" R ") == std::string::npos,
                       "nothing homes in an emergency");
    if (request.empty() && step % 8 != 7) continue;
    const auto end = rest.find('\0');
    const std::string_view piece = rest.substr(0, end);
    driver.receive(piece, now_s + 0.005);
    if (!piece.empty()) interfere(driver, static_cast<std::uint8_t>(piece.front()), now_s + 0.006);
    rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
    check(driver);
  }
}

// A real dialogue with a simulated unit, whose bytes the input damages: 0 to 127 leaves so many as
// they are; 128 to 191 loses the next, more puts a byte in its place or before it.
class DamagedLine {
 public:
  explicit DamagedLine(ols::fuzz::Input input) : input_(input) {}
  std::string through(std::string_view bytes) {
    std::string out;
    for (const char byte : bytes) {
      if (untouched_ == 0) choose();
      if (untouched_ > 0) {
        --untouched_;
        out += byte;
      } else {
        out += damage_ == Damage::kLost ? "" : std::string(1, with_);
        if (damage_ == Damage::kInserted) out += byte;
        untouched_ = 1;
      }
    }
    return out;
  }

 private:
  enum class Damage { kLost, kReplaced, kInserted };
  void choose() {
    if (input_.empty()) {
      untouched_ = 1 << 20;
      return;
    }
    const std::uint8_t what = input_.byte();
    untouched_ = what < 128 ? what + 1 : 0;
    damage_ = what < 192 ? Damage::kLost : what < 224 ? Damage::kReplaced : Damage::kInserted;
    if (what >= 192) with_ = static_cast<char>(input_.byte());
  }
  ols::fuzz::Input input_;
  int untouched_ = 0;
  Damage damage_ = Damage::kLost;
  char with_ = 0;
};

void dialogue(ols::fuzz::Input input) {
  ols::sim::PtuUnitConfig unit_config;
  unit_config.home_at_power_up = false;
  unit_config.baud = 0;
  ols::sim::PtuUnit unit(unit_config, 1, 0.0);
  constexpr double kEarly_s = 0.4;  // so that it has come to rest at the end
  const double when_s = kEarly_s * input.byte() / 255.0;
  const std::uint8_t what = input.byte();
  bool done = false;
  DamagedLine line(input);
  ols::ptu::PtuConfig driver_config = config();
  driver_config.limits = {-0.5, 0.5, -0.3, 0.3};
  ols::ptu::PtuDriver driver(driver_config);
  driver.restart(0.0);
  for (double now_s = 0.0; now_s < 1.5; now_s += 0.01) {
    driver.set_goal(ols::mount::Goal{now_s, {2.0 * now_s, 0.1}, {2.0, 0.0}, now_s + 0.5});
    if (const std::string request = driver.step(now_s); !request.empty()) {
      unit.receive(request, now_s);
    }
    if (!done && now_s >= when_s) {
      done = true;
      interfere(driver, what, now_s);
      if (driver.in_emergency()) unit.receive(ols::ptu::halt_request(), now_s);
    }
    driver.receive(line.through(unit.transmit(now_s + 0.005)), now_s + 0.005);
    check(driver);
  }
  const double pan_rad = unit.angles_at(1.4).pan_rad;
  ols::fuzz::require(std::abs(pan_rad) < 0.51 || driver.counters().homings > 0,
                     "the unit never leaves the configured limits");
  ols::fuzz::require(!driver.in_emergency() || unit.angles_at(1.3).pan_rad == pan_rad,
                     "the unit stands after an emergency stop");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ols::fuzz::Input input(data, size);
  if (input.byte() % 2 == 0) {
    drive(input.rest());
  } else {
    dialogue(input);
  }
  return 0;
}
