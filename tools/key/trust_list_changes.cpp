#include "tools/key/trust_list_changes.h"

#include <algorithm>
#include <stdexcept>

#include "conditions/printed.h"

namespace ols::key {
namespace {

using trust::Member;
using trust::TrustList;

// Revokes the member's keys; returns whether there was one.
bool revoke_in(TrustList& list, const std::string& name) {
  bool found = false;
  for (Member& member : list.members) {
    if (member.name != name || member.revoked) continue;
    member.revoked = found = true;
  }
  return found;
}

}  // namespace

TrustList new_list(const std::string& site, const trust::PublicKey& root) {
  trust::require_member_name(site);
  TrustList list;
  list.site = site;
  list.number = 1;
  list.root = root;
  return list;
}

TrustList enrol(const TrustList& before, const Member& member) {
  trust::require_member_name(member.name);
  TrustList list = before;
  if (std::ranges::find(list.members, member.key, &Member::key) != list.members.end()) {
    throw std::invalid_argument("this key is in the list already");
  }
  if (const Member* present = list.find(member.name); present && present->role != member.role) {
    throw std::invalid_argument(member.name + " is enrolled as " + to_string(present->role) +
                                ": revoke it first");
  }
  revoke_in(list, member.name);
  list.members.push_back(member);
  ++list.number;
  return list;
}

TrustList revoke(const TrustList& before, const std::string& name) {
  TrustList list = before;
  if (!revoke_in(list, name)) throw std::invalid_argument(name + " is not enrolled");
  ++list.number;
  return list;
}

std::string describe(const TrustList& list) {
  std::string text = "site " + list.site + ", list " + std::to_string(list.number) + ", root " +
                     trust::spoken(list.root) + "\n";
  for (const Member& member : list.members) {
    const std::string line = printed(
        "%-32s %-10s %-8s %s\n", member.name.c_str(),
        member.role == trust::Role::kUnknown ? member.unknown_role.c_str() : to_string(member.role),
        member.revoked ? "revoked" : "", trust::spoken(member.key).c_str());
    text += line;
  }
  return text;
}

}  // namespace ols::key
