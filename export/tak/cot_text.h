// Encodes an event of Cursor on Target as XML or protobuf. Pure.
#pragma once

#include <string>

#include "export/tak/cot_event.h"

namespace ols::exports {

std::string cot_xml(const CotEvent& event);
// An event without the XML declaration, and a document made of such elements. A TAK server answers
// a request for an object's history with a document of this form.
std::string cot_element(const CotEvent& event);
std::string cot_document(const std::string& elements);

// The TAK protocol, version 1: a header, then protobuf. In a datagram to a mesh, the header is `bf
// 01 bf`; in a stream, it is `bf` and the length as a varint.
enum class TakFraming { kMesh, kStream };
std::string cot_protobuf(const CotEvent& event, TakFraming framing);

}  // namespace ols::exports
