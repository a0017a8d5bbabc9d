// The trust list by which a host examines itself: the configured list, otherwise the one that its
// member has received and kept. The list is only read.
#pragma once

#include <string>

#include "base/trust/trust_config.h"

namespace ols::doctor {

// Returns `config`; if it names no existing list, with the list that member `name` has kept.
trust::TrustConfig with_kept_list(trust::TrustConfig config, const trust::Environment& environment,
                                  const std::string& name);

}  // namespace ols::doctor
