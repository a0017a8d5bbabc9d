// The public key of a device's TLS certificate, by which a configuration pins the device. Pure.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace ols::device {

// "sha256//" and the base64 of the SHA-256 of the certificate's SubjectPublicKeyInfo (RFC 5280), as
// curl states it. `der`: the certificate; empty if it is none.
std::string certificate_key(std::span<const std::uint8_t> der);
// The same of the first certificate in a PEM text.
std::string certificate_key_of_pem(std::string_view pem);

// Throws std::invalid_argument unless the text is empty or has the form of certificate_key().
void check_pinned_key(const std::string& text);

}  // namespace ols::device
