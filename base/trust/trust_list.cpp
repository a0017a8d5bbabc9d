#include "base/trust/trust_list.h"

#include <set>

#include "base/toml_config.h"

namespace ols::trust {
namespace {

constexpr std::string_view kDomain = "OLS-trust-v1";
constexpr std::string_view kSignatureLine = "# signature ";
constexpr std::int64_t kGreatestNumber = 1'000'000'000;

std::string body_of(const TrustList& list) {
  std::string text = "site = \"" + list.site + "\"\nnumber = " + std::to_string(list.number) +
                     "\nroot = \"" + to_hex(list.root) + "\"\n";
  for (const Member& member : list.members) {
    text += "\n[[member]]\nname = \"" + member.name + "\"\nrole = \"" + to_string(member.role) +
            "\"\nkey = \"" + to_hex(member.key) + "\"\n";
    if (member.revoked) text += "revoked = true\n";
  }
  return text;
}

std::vector<std::uint8_t> signed_bytes(std::string_view body) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(kDomain.size() + body.size());
  for (const char c : kDomain) bytes.push_back(static_cast<std::uint8_t>(c));
  for (const char c : body) bytes.push_back(static_cast<std::uint8_t>(c));
  return bytes;
}

struct SignedText {
  std::string body;
  Signature signature{};
};

// The line of the signature is the last one.
SignedText split(const std::string& text, const std::string& name) {
  const std::size_t line = text.rfind(std::string(kSignatureLine));
  const bool begins = line != std::string::npos && (line == 0 || text[line - 1] == '\n');
  if (!begins) throw ConfigError(name + ": there is no line \"# signature …\" at its end");
  std::string_view rest = std::string_view(text).substr(line + kSignatureLine.size());
  while (!rest.empty() && (rest.back() == '\n' || rest.back() == '\r')) rest.remove_suffix(1);
  const auto signature = from_hex<64>(rest);
  if (!signature) throw ConfigError(name + ": its signature is not 128 hexadecimal digits");
  return {text.substr(0, line), *signature};
}

Member read_member(ConfigTable& table) {
  table.refuse_unknown({"name", "role", "key", "revoked"});
  Member member;
  member.name = read_name(table, "name");
  const auto role = role_from(table.text("role", ""));
  if (!role) throw table.error("role", "is none of the roles in docs/security.md");
  member.role = *role;
  member.key = read_hex(table, "key");
  member.revoked = table.boolean("revoked", false);
  return member;
}

TrustList read_body(const std::string& body, const std::string& name) {
  ConfigFile file(body, name);
  ConfigTable& root = file.root();
  root.refuse_unknown({"site", "number", "root", "member"});
  TrustList list;
  list.site = read_name(root, "site");
  list.number = root.integer("number", 0, 1, kGreatestNumber);
  list.root = read_hex(root, "root");
  std::set<std::string> names;
  std::set<KeyId> keys;
  for (ConfigTable* table : root.tables("member")) {
    list.members.push_back(read_member(*table));
    const Member& member = list.members.back();
    // One that lost its key has a revoked entry and a new one.
    if (!member.revoked && !names.insert(member.name).second) {
      throw table->error("name", "\"" + member.name + "\" is there twice");
    }
    if (!keys.insert(key_id(member.key)).second) {
      throw table->error("key", "is that of another member");
    }
  }
  if (list.number == 0) throw root.error("number", "is missing");
  return list;
}

}  // namespace

const Member* TrustList::find(std::string_view name) const {
  for (const Member& member : members) {
    if (member.name == name && !member.revoked) return &member;
  }
  return nullptr;
}

std::string sign_list(const TrustList& list, const SigningKey& root) {
  const std::string body = body_of(list);
  return body + std::string(kSignatureLine) + to_hex(root.sign(signed_bytes(body))) + "\n";
}

// The signature first: what it does not cover is not even parsed.
TrustList read_list(const std::string& text, const std::string& name, const PublicKey& root) {
  const SignedText parts = split(text, name);
  if (!is_signed_by(root, signed_bytes(parts.body), parts.signature)) {
    throw ConfigError(name + ": is not signed by this site's root, or was changed since");
  }
  TrustList list = read_body(parts.body, name);
  if (list.root != root) throw ConfigError(name + ": root: is not this site's");
  return list;
}

TrustList read_list(const std::string& text, const std::string& name) {
  return read_list(text, name, read_body(split(text, name).body, name).root);
}

}  // namespace ols::trust
