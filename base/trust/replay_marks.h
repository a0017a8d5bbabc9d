// The sequence numbers received from each key on each channel, so that no message is accepted
// twice. Pure.
//
// Within one boot of a sender, the sequence grows, except that datagrams may overtake each other by
// fewer than kWindow numbers. Each boot has its own mark, so that a recording of an earlier boot is
// refused whatever the clocks show. Only the kBoots boots used last are remembered. A message of a
// boot that is not remembered must be stamped later than every message of the forgotten boots;
// otherwise it counts as a replay.
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

  // True if the message was received before. Also true if this cannot be excluded: the boot may be
  // a forgotten one, or the sequence number is kWindow or more below the newest.
  bool is_replayed(const KeyId& key, const std::string& channel, const MessageHead& head) const;
  // As is_replayed(), but false for a boot that is not remembered.
  bool is_heard(const KeyId& key, const std::string& channel, const MessageHead& head) const;
  // Call only for a verified message that is not a replay. Then only enrolled keys have streams,
  // and their number is limited.
  void note(const KeyId& key, const std::string& channel, const MessageHead& head);

  // The marks as text for a restart, one line per boot. read() ignores invalid lines, and returns
  // their number.
  std::string text() const;
  std::size_t read(const std::string& text);
  // Changes with each call of note().
  std::uint64_t revision() const { return revision_; }

 private:
  struct Mark {
    std::int64_t boot_id = 0;
    std::int64_t newest = 0;    // sequence
    std::uint64_t heard = 0;    // bit n: sequence newest - n was received
    std::int64_t utime_us = 0;  // the latest stamp
    std::uint64_t used = 0;     // revision at the last note() of this boot
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
