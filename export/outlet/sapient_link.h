// A connection to a SAPIENT receiver. First sends the registration, and nothing else until the
// receiver has accepted it.
#pragma once

#include "export/outlet/stream_link.h"
#include "export/sapient/sapient_dialogue.h"
#include "export/sapient/sapient_node.h"

namespace ols::exports {

class SapientLink : public StreamLink {
 public:
  SapientLink(const Address& address, TlsFiles files, SapientSettings settings);

  void open() override;
  void send(const Packet& packet) override;
  void say_goodbye() override;
  // The receiver's last complaint about a message, for some seconds; then empty.
  std::string trouble() const override;
  std::uint64_t complaints() const override { return dialogue_.complaints(); }

 private:
  void heard(std::string_view bytes) override;

  SapientSettings settings_;
  SapientDialogue dialogue_;
  double complained_s_ = 0.0;
};

}  // namespace ols::exports
