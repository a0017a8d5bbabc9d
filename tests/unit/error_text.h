// The text of an exception, for tests of what is refused.
#pragma once

#include <string>

namespace ols {

// Returns `otherwise` if the action throws nothing. Passes on exceptions of other types.
template <class Exception, class Action>
std::string error_text(Action action, std::string otherwise = "") {
  try {
    action();
  } catch (const Exception& error) {
    return error.what();
  }
  return otherwise;
}

}  // namespace ols
