// The ASCII protocol of the FLIR (Directed Perception) pan-tilt units, as bytes: encodes requests
// and parses replies. Pure. A request is one or more commands, each followed by a blank. Each
// command is answered by one line, `* value`, `*` or `! text`, in order.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ols::ptu {

enum class PtuAxis : char { kPan = 'P', kTilt = 'T' };

// Quantities of an axis that can be queried. The first six can also be set.
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
  // Appends a command without an axis: ED FT CI I LE H V and so on.
  PtuRequest& plain(std::string_view command);

  PtuRequest& append(const PtuRequest& request);
  // Appends a delimiter alone, which ends an incomplete command in the unit's buffer. The unit does
  // not answer it.
  PtuRequest& delimiter();

  const std::string& bytes() const { return bytes_; }
  std::size_t commands() const { return ends_.size(); }
  // The command `index` with its delimiter.
  std::string_view command(std::size_t index) const;
  bool empty() const { return ends_.empty(); }
  // Number of bytes up to and including the delimiter of command `index`: the bytes that the unit
  // needs before it can execute the command.
  std::size_t end_of(std::size_t index) const { return ends_.at(index); }

 private:
  PtuRequest& finish();
  std::string bytes_;
  std::vector<std::size_t> ends_;
};

// The bytes that stop the unit at once, even after an incomplete command.
std::string halt_request();

struct PtuReply {
  bool ok = true;       // true for `*`, false for `!`
  bool echoed = false;  // an echo preceded the reply, so the unit's echo is on
  int limit_hits = 0;   // number of !P and !T in its line; homing leaves several: !T!T!P!P*
  std::string text;     // after the `*` or `!`, trimmed
  std::optional<double> number;  // the first word of the text that is a number
  double began_s = 0.0;          // instant by which the `*` or `!` had arrived
  double ended_s = 0.0;          // instant by which the first byte of the line end had arrived

  // The number as a count; nullopt unless it is whole and fits into 32 bits.
  std::optional<std::int32_t> count() const;
};

// The meaning of `! text`.
enum class PtuComplaint {
  // Maximum, Minimum allowable Pan position is N: the travel differs from what was read.
  kPositionLimit,
  kSpeedLimit,     // Pan speed cannot exceed N; Motor speed cannot be less than N
  kNotReferenced,  // Axis Error: the axis has not been homed since power-up
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

// It is incremental: however the bytes are split, the replies are the same. Blanks, echoes and
// asynchronous tokens (!P !T limit hits; !D #P #T $P $T) are discarded wherever they occur.
class PtuReplyParser {
 public:
  // `time_s`: an instant by which all these bytes had arrived. `byte_s`: duration of one byte on
  // the line (for PtuReply::began_s).
  std::vector<PtuReply> feed(std::string_view bytes, double time_s = 0.0, double byte_s = 0.0);

  // Discards an incomplete line.
  void reset();

  std::uint64_t garbled() const { return garbled_; }  // lines that are neither a reply nor an echo
  std::uint64_t banners() const { return banners_; }  // lines that a restarting unit prints
  const PtuLimitHits& limit_hits() const { return limit_hits_; }  // number of !P and !T

 private:
  std::optional<PtuReply> finish_line(double end_s);
  std::string without_tokens(std::string_view line);
  bool is_banner(std::string_view line);

  std::string line_;
  bool overlong_ = false;
  // Time of the first `*` of this line or, if there is none, of the first `!`
  double mark_s_ = 0.0;
  bool marked_ = false;
  std::uint64_t garbled_ = 0;
  std::uint64_t banners_ = 0;
  PtuLimitHits limit_hits_;
};

}  // namespace ols::ptu
