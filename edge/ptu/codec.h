// The ASCII protocol of the FLIR (Directed Perception) pan-tilt units, as bytes: requests out,
// replies in. Pure. A request is one or more commands, each ended by a blank; each is answered by
// one line, `* value`, `*` or `! text`, in order.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ols::ptu {

enum class PtuAxis : char { kPan = 'P', kTilt = 'T' };

// Quantities of an axis that can be queried; the first six can be set as well.
enum class PtuQuantity : char {
  kPosition = 'P',        // [counts]
  kSpeed = 'S',           // [counts/s] to travel at
  kAcceleration = 'A',    // [counts/s^2]
  kBaseSpeed = 'B',       // [counts/s] without a ramp
  kUpperSpeed = 'U',      // [counts/s] bound of kSpeed
  kLowerSpeed = 'L',      // [counts/s] bound of kSpeed
  kTargetPosition = 'O',  // [counts]
  kCurrentSpeed = 'D',    // [counts/s]
  kResolution = 'R',      // [arc seconds per count]
  kMinPosition = 'N',     // [counts]
  kMaxPosition = 'X',     // [counts]
};

class PtuRequest {
 public:
  PtuRequest& query(PtuAxis axis, PtuQuantity quantity);
  PtuRequest& set(PtuAxis axis, PtuQuantity quantity, std::int32_t value);
  // A command without an axis: ED FT CI I LE H V and so on.
  PtuRequest& plain(std::string_view command);

  PtuRequest& append(const PtuRequest& request);
  // A delimiter alone: ends an incomplete command in the unit's buffer. It is not answered.
  PtuRequest& delimiter();

  const std::string& bytes() const { return bytes_; }
  std::size_t commands() const { return ends_.size(); }
  // Command `index` with its delimiter.
  std::string_view command(std::size_t index) const;
  bool empty() const { return ends_.empty(); }
  // Number of bytes up to and including the delimiter of command `index`: what the unit needs to
  // execute it.
  std::size_t end_of(std::size_t index) const { return ends_.at(index); }

 private:
  PtuRequest& finish();
  std::string bytes_;
  std::vector<std::size_t> ends_;
};

// Bytes that stop the unit at once, even after an incomplete command.
std::string halt_request();

struct PtuReply {
  bool ok = true;                // `*`; else `!`
  bool echoed = false;           // an echo preceded it: the unit's echo is on
  int limit_hits = 0;            // !P and !T in its line; homing leaves several: !T!T!P!P*
  std::string text;              // after the `*` or `!`, trimmed
  std::optional<double> number;  // the first word of the text that is a number
  double began_s = 0.0;          // instant by which the `*` or `!` was complete
  double ended_s = 0.0;          // the same for the first byte of the line end

  // The number as a count: whole and within 32 bits.
  std::optional<std::int32_t> count() const;
};

// The meaning of `! text`.
enum class PtuComplaint {
  kPositionLimit,  // Maximum, Minimum allowable Pan position is N: its travel is not what was read
  kSpeedLimit,     // Pan speed cannot exceed N; Motor speed cannot be less than N
  kNotReferenced,  // Axis Error: the axis was not homed since power-up
  kIllegal,        // Illegal Command Entered: corrupted on the line, or unknown to this firmware
  kOther,
};
PtuComplaint complaint(std::string_view text);

struct PtuLimitHits {
  std::uint64_t pan = 0, tilt = 0;

  bool any() const { return pan + tilt > 0; }
  PtuLimitHits& operator+=(const PtuLimitHits& more) {
    pan += more.pan;
    tilt += more.tilt;
    return *this;
  }
  PtuLimitHits operator-(const PtuLimitHits& less) const {
    return {pan - less.pan, tilt - less.tilt};
  }
};

// Incremental: any split of the bytes gives the same replies. Blanks, echoes and asynchronous
// tokens (!P !T limit hits; !D #P #T $P $T) are discarded wherever they occur.
class PtuReplyParser {
 public:
  // `time_s`: an instant by which all bytes had arrived. `byte_s`: duration of a byte on the line
  // (for PtuReply::began_s).
  std::vector<PtuReply> feed(std::string_view bytes, double time_s = 0.0, double byte_s = 0.0);

  // Discards an incomplete line.
  void reset();

  std::uint64_t garbled() const { return garbled_; }  // lines that are neither reply nor echo
  std::uint64_t banners() const { return banners_; }  // lines of a unit that restarts
  const PtuLimitHits& limit_hits() const { return limit_hits_; }  // !P and !T

 private:
  std::optional<PtuReply> finish_line(double end_s);
  std::string without_tokens(std::string_view line);
  bool is_banner(std::string_view line);

  std::string line_;
  bool overlong_ = false;
  double mark_s_ = 0.0;  // of the first `*`, or failing that `!`, of this line
  bool marked_ = false;
  std::uint64_t garbled_ = 0;
  std::uint64_t banners_ = 0;
  PtuLimitHits limit_hits_;
};

}  // namespace ols::ptu
