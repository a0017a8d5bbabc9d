// The sequence numbers received from each key on each channel, so that no message is accepted
// twice. Pure.
//
// A sender's sequence grows within its boot; datagrams may overtake each other by less than
// kWindow. Each boot has its own mark: a recording of an earlier boot is refused, independent of
// any clock. Only the last kBoots boots are remembered. Messages of any other boot must be stamped
// later than everything that the forgotten boots have sent, unless the caller allows them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/trust/crypto.h"
#include "base/trust/message_head.h"

namespace ols::trust {

class ReplayMarks {
 public:
  static constexpr std::uint64_t kWindow = 64;
  static constexpr std::size_t kBoots = 32;

  // True if the message was heard before. Also true if its boot is forgotten and it may have been.
  bool is_replayed(const KeyId& key, const std::string& channel, const MessageHead& head) const;
  // Whether it was heard from a remembered boot.
  bool is_heard(const KeyId& key, const std::string& channel, const MessageHead& head) const;
  // Call only for a verified message that is no replay, so that the enrolled keys limit the number
  // of streams.
  void note(const KeyId& key, const std::string& channel, const MessageHead& head);

  // For a restart: one line per boot. read() ignores invalid lines, and returns their number.
  std::string text() const;
  std::size_t read(const std::string& text);
  // Changes with each note.
  std::uint64_t revision() const { return revision_; }

 private:
  struct Mark {
    std::int64_t boot_id = 0;
    std::int64_t newest = 0;    // sequence
    std::uint64_t heard = 0;    // bit n: sequence newest - n
    std::int64_t utime_us = 0;  // the latest
    std::uint64_t used = 0;     // revision at its last note
  };
  struct Stream {
    std::vector<Mark> boots;
    std::int64_t forgotten_utime_us = 0;  // the latest stamp of all forgotten boots
  };
  using Name = std::pair<KeyId, std::string>;

  const Stream* find(const KeyId& key, const std::string& channel) const;
  static const Mark* find(const Stream& stream, std::int64_t boot_id);
  static bool has(const Mark& mark, std::int64_t sequence);
  static void advance(Mark& mark, const MessageHead& head);
  static void keep_few(Stream& stream);

  std::map<Name, Stream> streams_;
  std::uint64_t revision_ = 0;
};

}  // namespace ols::trust
