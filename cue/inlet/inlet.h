// The source of an input's bytes. All inlets share the process's io_context, so none makes another
// wait.
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
  std::string trouble;  // in words; empty: no trouble
  std::int64_t openings = 0, failures = 0, bytes = 0;
};

// Receives the bytes. `begins`: called before the first bytes of each connection.
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

// `poll_s`: interval between two reads of a file.
std::unique_ptr<Inlet> make_inlet(boost::asio::io_context& context, const Source& source,
                                  double poll_s, InletSink sink);

}  // namespace ols::cues
