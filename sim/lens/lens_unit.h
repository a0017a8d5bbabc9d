// A simulated zoom lens that speaks VISCA. It is written from docs/overview.md, without the
// product's codec, so that codec and simulation cannot share a mistake. Pure: bytes and time in,
// bytes and true positions out. sim/lens/lens_line.* puts it on a pty.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>

namespace ols::sim {

struct LensUnitConfig {
  double zoom_travel_s = 3.0;  // from one end to the other at full speed
  double focus_travel_s = 2.0;
  double cycle_s = 1.0 / 60.0;  // the lens answers once per picture
  int baud = 9600;
  double start_zoom = 0.0;  // 0 widest .. 1 longest
};

class LensUnit {
 public:
  explicit LensUnit(const LensUnitConfig& config, double power_up_s = 0.0);

  // Takes bytes that have arrived. Time never decreases between calls of receive() and transmit().
  void receive(std::string_view bytes, double time_s);
  // The bytes that are on the line by this time. Each byte is returned once.
  std::string transmit(double time_s);
  // When transmit() will next return something, as far as known now; nullopt: not before the lens
  // receives something.
  std::optional<double> next_output_s() const;

  // The true zoom position at an instant of the last two seconds, 0 widest .. 1 longest.
  double zoom_at(double time_s) const;
  double focus_at(double time_s) const { return focus_.at(time_s); }
  int iris() const { return iris_; }

 private:
  // A drive's motion in linear pieces.
  class Drive {
   public:
    Drive(double travel_s, double position, double time_s);
    void run(double rate, double time_s);          // `rate`: signed share of full speed
    double go_to(double position, double time_s);  // returns the time of arrival
    double at(double time_s) const;

   private:
    struct Piece {
      double from_s, position;  // at from_s
      double speed;             // [1/s]
      double until_s;           // then the drive is at rest
    };
    static double within(const Piece& piece, double time_s);
    void add(const Piece& piece);
    double travel_s_;
    std::deque<Piece> pieces_;
  };
  struct Output {
    double time_s;
    std::string bytes;
  };

  void take(const std::string& packet, double time_s);
  void obey(const std::string& packet, double time_s);
  void answer(const std::string& packet, double time_s);
  void drive(Drive& drive, int what, bool up_is_2, double time_s);
  void say(std::string bytes, double time_s);
  void acknowledge(double time_s, double done_s);

  LensUnitConfig config_;
  Drive zoom_, focus_;
  int iris_ = 0x11;
  bool focus_by_hand_ = false, exposure_by_hand_ = false;
  std::string packet_;
  std::deque<Output> output_;  // by time
};

}  // namespace ols::sim
