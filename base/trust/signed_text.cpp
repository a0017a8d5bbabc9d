#include "base/trust/signed_text.h"

#include <cstdint>
#include <vector>

#include "base/config/toml_config.h"

namespace ols::trust {
namespace {

constexpr std::string_view kSignatureLine = "# signature ";

std::vector<std::uint8_t> signed_bytes(std::string_view kind, std::string_view body) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(kind.size() + body.size());
  for (const char c : kind) bytes.push_back(static_cast<std::uint8_t>(c));
  for (const char c : body) bytes.push_back(static_cast<std::uint8_t>(c));
  return bytes;
}

}  // namespace

// The line of the signature is the last one.
SignedText split_signed(const std::string& text, const std::string& name) {
  const std::size_t line = text.rfind(std::string(kSignatureLine));
  const bool begins = line != std::string::npos && (line == 0 || text[line - 1] == '\n');
  if (!begins) throw ConfigError(name + ": there is no line \"# signature …\" at its end");
  std::string_view rest = std::string_view(text).substr(line + kSignatureLine.size());
  while (!rest.empty() && (rest.back() == '\n' || rest.back() == '\r')) rest.remove_suffix(1);
  const auto signature = from_hex<64>(rest);
  if (!signature) throw ConfigError(name + ": its signature is not 128 hexadecimal digits");
  return {text.substr(0, line), *signature};
}

void require_signed(const SignedText& parts, std::string_view kind, const PublicKey& root,
                    const std::string& name) {
  if (is_signed_by(root, signed_bytes(kind, parts.body), parts.signature)) return;
  throw ConfigError(name + ": is not signed by this site's root, or was changed since");
}

std::string sign_text(const std::string& body, std::string_view kind, const SigningKey& root) {
  const std::string signature = to_hex(root.sign(signed_bytes(kind, body)));
  return std::string(body).append(kSignatureLine).append(signature).append("\n");
}

}  // namespace ols::trust
