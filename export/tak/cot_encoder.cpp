#include "export/tak/cot_encoder.h"

namespace ols::exports {

Packets CotEncoder::packet(const CotEvent& event) const {
  return {{event.uid, framing_ ? cot_protobuf(event, *framing_) : cot_xml(event)}};
}

}  // namespace ols::exports
