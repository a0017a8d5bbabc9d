// An inlet receives the bytes of one input. All inlets share the process's io_context, and none
// makes another wait.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "cue/source.h"

namespace boost::asio {
class io_context;
}
namespace ols::cues {

struct InletReport {
  bool is_open = false;
  std::string trouble;  // in words for a person; empty: no trouble
  std::int64_t openings = 0, failures = 0, bytes = 0;
};

// Where an inlet passes its bytes. `begins`: called before the first bytes of each connection.
struct InletSink {
  std::function<void()> begins;
  std::function<void(std::string_view)> bytes;
};

class Inlet {
 public:
  virtual ~Inlet() = default;
  const InletReport& report() const { return report_; }

 protected:
  void opened();
  void failed(const std::string& why);
  void received(const InletSink& sink, std::string_view bytes);

 private:
  InletReport report_;
};

// Makes the inlet for a source. `poll_s`: interval of reading, for a file or a web address.
std::unique_ptr<Inlet> make_inlet(boost::asio::io_context& context, const Source& source,
                                  double poll_s, InletSink sink);

}  // namespace ols::cues
