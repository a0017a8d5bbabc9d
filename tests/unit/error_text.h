// What an exception says, for tests of what is refused.
#pragma once

#include <string>

namespace ols {

// `otherwise` where the action throws nothing; other exceptions go on.
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
