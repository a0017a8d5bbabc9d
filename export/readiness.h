// Checks whether the outputs of a configuration can work on this computer: whether their files and
// the geoid can be read.
#pragma once

#include <vector>

#include "export/export_config.h"
#include "export/messages.h"

namespace ols::exports {

// The site with its geoid. If the geoid is not installed and no format needs it, the site has none.
// If a format needs it, throws std::invalid_argument that names the format and what to do.
SiteContext site_context(const ExportConfig& config, const std::vector<Format>& formats);
std::vector<Format> formats_of(const ExportConfig& config);

// Throws std::invalid_argument naming the output whose certificate, key or password cannot be read.
// Without this check the output would fail again and again.
void check_files(const ExportConfig& config);

}  // namespace ols::exports
