// Encodes requests and parses replies in the ASCII protocol of FLIR's (Directed Perception's)
// pan-tilt units. Pure. A request is one or more commands, each followed by a blank. The unit
// answers each command by one line, in order: `* value`, `*` or `! text`.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ols::ptu {

enum class PtuAxis : char { kPan = 'P', kTilt = 'T' };

// The quantities of an axis that can be queried. The first six can also be set.
enum class PtuQuantity : char {
  kPosition = 'P',        // [counts]
  kSpeed = 'S',           // [counts/s] speed of travel
  kAcceleration = 'A',    // [counts/s^2]
  kBaseSpeed = 'B',       // [counts/s] speed that needs no ramp
  kUpperSpeed = 'U',      // [counts/s] upper bound of kSpeed
  kLowerSpeed = 'L',      // [counts/s] lower bound of kSpeed
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
  // Appends a command without an axis, such as ED, FT, CI, I, LE, H or V.
  PtuRequest& plain(std::string_view command);

  PtuRequest& append(const PtuRequest& request);
  // Appends a delimiter (a blank) alone. It ends an incomplete command in the unit's buffer. The
  // unit does not answer it.
  PtuRequest& delimiter();

  const std::string& bytes() const { return bytes_; }
  std::size_t commands() const { return ends_.size(); }
  // The command number `index`, with its delimiter.
  std::string_view command(std::size_t index) const;
  bool empty() const { return ends_.empty(); }
  // Number of bytes up to and including the delimiter of command `index`. The unit executes the
  // command when it has received these.
  std::size_t end_of(std::size_t index) const { return ends_.at(index); }

 private:
  PtuRequest& finish();
  std::string bytes_;
  std::vector<std::size_t> ends_;
};

// The bytes that halt the unit, even after an incomplete command.
std::string halt_request();

struct PtuReply {
  bool ok = true;       // true for `*`, false for `!`
  bool echoed = false;  // true: an echo preceded the reply, thus the unit's echo is on
  // Number of limit hits (!P, !T) in the reply's line; homing causes several: !T!T!P!P*.
  int limit_hits = 0;
  std::string text;              // the text after `*` or `!`, trimmed
  std::optional<double> number;  // value of the first word of the text that is a number
  double began_s = 0.0;          // time by which the `*` or `!` had arrived
  double ended_s = 0.0;          // time by which the first byte of the line end had arrived

  // `number` as a count; nullopt unless it is an integer of 32 bits.
  std::optional<std::int32_t> count() const;
};

// The meanings of `! text`.
enum class PtuComplaint {
  // "Maximum (Minimum) allowable Pan position is N": the travel is no longer the one that was read.
  kPositionLimit,
  kSpeedLimit,     // "Pan speed cannot exceed N", "Motor speed cannot be less than N"
  kNotReferenced,  // "Axis Error": the axis has not been homed since power-up
  // "Illegal Command Entered": the command was corrupted on the line, or this firmware does not
  // know it
  kIllegal,
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

// Parses replies incrementally: the result does not depend on how the bytes are split into calls.
// Discards blanks, echoes and asynchronous tokens wherever they occur. The tokens are the limit
// hits !P and !T, and !D, #P, #T, $P and $T.
class PtuReplyParser {
 public:
  // Takes bytes and returns the replies that they complete. `time_s`: a time by which all these
  // bytes had arrived. `byte_s`: duration of one byte on the line, from which the times in PtuReply
  // are computed.
  std::vector<PtuReply> feed(std::string_view bytes, double time_s = 0.0, double byte_s = 0.0);

  // Discards an incomplete line.
  void reset();

  // Number of lines that are neither a reply nor an echo.
  std::uint64_t garbled() const { return garbled_; }
  // Number of lines that only a restarting unit sends.
  std::uint64_t banners() const { return banners_; }
  const PtuLimitHits& limit_hits() const { return limit_hits_; }  // number of !P and !T

 private:
  std::optional<PtuReply> finish_line(double end_s);
  std::string without_tokens(std::string_view line);
  bool is_banner(std::string_view line);

  std::string line_;
  bool overlong_ = false;
  // Time of the first `*` in this line or, if there is none, of the first `!`
  double mark_s_ = 0.0;
  bool marked_ = false;
  std::uint64_t garbled_ = 0;
  std::uint64_t banners_ = 0;
  PtuLimitHits limit_hits_;
};

}  // namespace ols::ptu
