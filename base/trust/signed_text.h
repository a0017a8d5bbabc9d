// A text that the site's root has signed, as the trust list and the site's settings are:
//
//   …
//   # signature …128 hexadecimal digits…
//
// The last line signs a word for the kind of text and all lines before it, byte by byte. Pure.
#pragma once

#include <string>
#include <string_view>

#include "base/trust/crypto.h"

namespace ols::trust {

struct SignedText {
  std::string body;
  Signature signature{};
};

// `name` stands for the file in errors. Throws ConfigError if it has no signature; whose that is,
// is not looked at.
SignedText split_signed(const std::string& text, const std::string& name);
// Throws ConfigError if it is not this root's for this kind of text.
void require_signed(const SignedText& parts, std::string_view kind, const PublicKey& root,
                    const std::string& name);
// `body` with its signature.
std::string sign_text(const std::string& body, std::string_view kind, const SigningKey& root);

}  // namespace ols::trust
