#include "tools/doctor/kept_list.h"

#include <exception>
#include <filesystem>
#include <system_error>

#include "base/files/small_file.h"
#include "base/trust/key_file.h"
#include "base/trust/trust_list.h"

namespace ols::doctor {
namespace {

// A station that is new to a site ignores the list of its former site, and so does this.
bool is_of_site(const std::string& list, const std::string& key) {
  try {
    const std::string text = read_small_file(list, trust::kLargestList);
    static_cast<void>(trust::read_list(text, list, trust::read_member_key(key).root));
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

}  // namespace

trust::TrustConfig with_kept_list(trust::TrustConfig config, const trust::Environment& environment,
                                  const std::string& name) {
  std::error_code unknown;
  if (std::filesystem::exists(trust::list_path(config, environment), unknown)) return config;
  const std::string kept = trust::kept_path(environment, "trust", name);
  if (is_of_site(kept, trust::key_path(config, environment, name))) config.list = kept;
  return config;
}

}  // namespace ols::doctor
