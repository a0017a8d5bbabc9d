#include "cue/inlet/inlet.h"

#include <utility>

#include "cue/inlet/poll_inlet.h"
#include "cue/inlet/tcp_inlet.h"
#include "cue/inlet/udp_inlet.h"

namespace ols::cues {

void Inlet::opened() {
  if (!report_.is_open) ++report_.openings;
  report_.is_open = true;
  report_.trouble.clear();
}

void Inlet::failed(const std::string& why) {
  ++report_.failures;
  report_.is_open = false;
  report_.trouble = why;
}

void Inlet::received(const InletSink& sink, std::string_view bytes) {
  report_.bytes += static_cast<std::int64_t>(bytes.size());
  sink.bytes(bytes);
}

std::unique_ptr<Inlet> make_inlet(boost::asio::io_context& context, const Source& source,
                                  double poll_s, InletSink sink) {
  switch (source.carrier) {
    case Carrier::kUdp:
      return std::make_unique<UdpInlet>(context, source, std::move(sink));
    case Carrier::kTcp:
      return std::make_unique<TcpInlet>(context, source, std::move(sink));
    case Carrier::kFile:
    case Carrier::kHttp:
      break;
  }
  return std::make_unique<PollInlet>(context, source, poll_s, std::move(sink));
}

}  // namespace ols::cues
