// A text signed by the site's root, such as the trust list and the site's settings:
//
//   …
//   # signature …128 hexadecimal digits…
//
// The signature covers a word for the kind of text and, byte by byte, all lines before the
// signature. Pure.
#pragma once

#include <string>
#include <string_view>

#include "base/trust/crypto.h"

namespace ols::trust {

struct SignedText {
  std::string body;
  Signature signature{};
};

// `name`: the file's name in errors. Throws ConfigError if there is no signature. Does not verify
// the signature.
SignedText split_signed(const std::string& text, const std::string& name);
// Throws ConfigError if the signature is not this root's for this kind of text.
void require_signed(const SignedText& parts, std::string_view kind, const PublicKey& root,
                    const std::string& name);
// Returns `body` followed by its signature.
std::string sign_text(const std::string& body, std::string_view kind, const SigningKey& root);

}  // namespace ols::trust
