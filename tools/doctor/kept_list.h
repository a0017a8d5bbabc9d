// The trust list by which a host examines itself: the configured one, otherwise the one that its
// member has heard and kept. It is only read.
#pragma once

#include <string>

#include "base/trust/trust_config.h"

namespace ols::doctor {

// `config`, with `name`'s kept list as the configured one if there is no other.
trust::TrustConfig with_kept_list(trust::TrustConfig config, const trust::Environment& environment,
                                  const std::string& name);

}  // namespace ols::doctor
