#include "wire/refusal_words.h"

#include "conditions/sayings.h"

namespace ols::wire {

Outcome refusal_in_words(const Reply& reply) {
  const Outcome refused = outcome::order_refused(reply.reason);
  return reply.detail.empty() ? refused : refused.with_detail(reply.detail);
}

}  // namespace ols::wire
