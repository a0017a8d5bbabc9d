// An encoder for a file that is rewritten each time it is due, from all records so far. Pure.
#pragma once

#include <functional>
#include <string>

#include "export/encoder.h"
#include "export/files/picture.h"

namespace ols::exports {

class DocumentEncoder : public Encoder {
 public:
  // Returns the text of the file with these contents; empty: there is nothing to write yet.
  using Writer = std::function<std::string(const Picture&)>;
  // `where`: as Packet::where. `companions`: further files beside this one, sent only once.
  DocumentEncoder(PictureLimits limits, Writer writer, std::string where = {},
                  Packets companions = {});

  Packets encode(const Target& target) override { return take(target); }
  Packets encode(const Station& station) override { return take(station); }
  Packets encode(const Line& line) override { return take(line); }
  Packets due(std::int64_t utime_us) override;
  void begin_again() override { is_new_ = true; }

 private:
  template <class Record>
  Packets take(const Record& record) {
    picture_.take(record);
    return {};
  }

  Picture picture_;
  Writer writer_;
  std::string where_;
  Packets companions_;
  bool is_new_ = true;
};

}  // namespace ols::exports
