// Chooses the trust list with which ols-doctor verifies messages: the configured list, or else the
// list that a program of this host has received over the bus and stored. Only reads lists.
#pragma once

#include <string>

#include "base/trust/trust_config.h"

namespace ols::doctor {

// Returns `config`. If its list does not exist, replaces it by the list that member `name` has
// stored, provided that this list belongs to the member's site.
trust::TrustConfig with_kept_list(trust::TrustConfig config, const trust::Environment& environment,
                                  const std::string& name);

}  // namespace ols::doctor
