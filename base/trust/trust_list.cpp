#include "base/trust/trust_list.h"

#include <set>

#include "base/config/toml_config.h"
#include "base/trust/signed_text.h"

namespace ols::trust {
namespace {

constexpr std::string_view kDomain = "OLS-trust-v1";
constexpr std::int64_t kGreatestNumber = 1'000'000'000;

std::string word_of(const Member& member) {
  return member.role == Role::kUnknown ? member.unknown_role : to_string(member.role);
}

std::string body_of(const TrustList& list) {
  std::string text = "site = \"" + list.site + "\"\nnumber = " + std::to_string(list.number) +
                     "\nroot = \"" + to_hex(list.root) + "\"\n";
  for (const Member& member : list.members) {
    text += "\n[[member]]\nname = \"" + member.name + "\"\nrole = \"" + word_of(member) +
            "\"\nkey = \"" + to_hex(member.key) + "\"\n";
    if (member.revoked) text += "revoked = true\n";
  }
  return text;
}

Member read_member(ConfigTable& table) {
  table.refuse_unknown({"name", "role", "key", "revoked"});
  Member member;
  member.name = read_name(table, "name");
  const std::string word = read_name(table, "role");
  member.role = role_from(word).value_or(Role::kUnknown);
  // A list of a newer version must stay readable: its revocations matter more than its new roles.
  if (member.role == Role::kUnknown) member.unknown_role = word;
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
    // A member that has lost its key has a revoked entry and a new one.
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

std::string TrustList::in_one_line() const {
  std::string revoked;
  std::size_t valid = 0;
  for (const Member& member : members) {
    if (!member.revoked) {
      ++valid;
    } else {
      revoked += (revoked.empty() ? ", revoked: " : ", ") + member.name;
    }
  }
  return "trust list " + std::to_string(number) + ": " + std::to_string(valid) + " members" +
         revoked;
}

std::vector<std::string> TrustList::stations() const {
  std::vector<std::string> names;
  for (const Member& member : members) {
    if (member.role == Role::kStation && !member.revoked) names.push_back(member.name);
  }
  return names;
}

std::string TrustList::strange_members() const {
  std::string text;
  for (const Member& member : members) {
    if (member.role != Role::kUnknown || member.revoked) continue;
    text += (text.empty() ? "" : ", ") + member.name + " (" + member.unknown_role + ")";
  }
  return text;
}

std::string sign_list(const TrustList& list, const SigningKey& root) {
  return sign_text(body_of(list), kDomain, root);
}

// The signature first: what it does not cover is not even parsed.
TrustList read_list(const std::string& text, const std::string& name, const PublicKey& root) {
  const SignedText parts = split_signed(text, name);
  require_signed(parts, kDomain, root, name);
  TrustList list = read_body(parts.body, name);
  if (list.root != root) throw ConfigError(name + ": root: is not this site's");
  return list;
}

TrustList read_list(const std::string& text, const std::string& name) {
  return read_list(text, name, read_body(split_signed(text, name).body, name).root);
}

}  // namespace ols::trust
