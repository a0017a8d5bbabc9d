#include "export/files/document.h"

#include <utility>

namespace ols::exports {

DocumentEncoder::DocumentEncoder(PictureLimits limits, Writer writer, std::string where,
                                 Packets companions)
    : picture_(limits),
      writer_(std::move(writer)),
      where_(std::move(where)),
      companions_(std::move(companions)) {}

Packets DocumentEncoder::due(std::int64_t utime_us) {
  picture_.forget(utime_us);
  Packets packets;
  if (std::exchange(is_new_, false)) packets = companions_;
  if (std::string document = writer_(picture_); !document.empty()) {
    packets.push_back({"document", std::move(document), where_});
  }
  return packets;
}

}  // namespace ols::exports
