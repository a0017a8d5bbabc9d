#include "base/trust/message_head.h"

#include <cstddef>

namespace ols::trust {
namespace {

constexpr std::size_t kFingerprint = 8;  // [byte] LCM's, of the type

// Reads big-endian integers and texts; stays invalid after the first that is not there.
class Reader {
 public:
  explicit Reader(Bytes bytes) : rest_(bytes) {}

  std::int64_t integer(std::size_t size) {
    std::uint64_t value = 0;
    if (!has(size)) return 0;
    for (const std::uint8_t byte : rest_.first(size)) value = value << 8U | byte;
    rest_ = rest_.subspan(size);
    return static_cast<std::int64_t>(value);
  }
  // LCM's: a length that counts the zero at the end.
  std::string_view text() {
    const auto length = static_cast<std::size_t>(integer(4));
    if (length == 0 || !has(length)) return fail();
    const std::string_view text(reinterpret_cast<const char*>(rest_.data()), length - 1);
    rest_ = rest_.subspan(length);
    return text;
  }
  bool valid() const { return valid_; }

 private:
  bool has(std::size_t size) {
    valid_ = valid_ && rest_.size() >= size;
    return valid_;
  }
  std::string_view fail() {
    valid_ = false;
    return {};
  }

  Bytes rest_;
  bool valid_ = true;
};

}  // namespace

std::optional<MessageHead> read_head(Bytes payload, HeadForm form) {
  Reader reader(payload);
  MessageHead head;
  reader.integer(kFingerprint);
  head.utime_us = reader.integer(8);
  if (form != HeadForm::kUtimeOnly) {
    reader.integer(4);
    if (form == HeadForm::kStationFirst) head.station = reader.text();
    head.boot_id = reader.integer(8);
    head.sequence = reader.integer(8);
  }
  if (!reader.valid()) return std::nullopt;
  return head;
}

}  // namespace ols::trust
