// Orderly shutdown on SIGTERM and SIGINT.
#pragma once

namespace ols {

// Installs the handlers; call once, first in main.
void install_shutdown_handler();

bool shutdown_requested();

}  // namespace ols
