// Rank 0's values for every rank, and what ranks agree on. Collective.
#pragma once

#include <cstdint>
#include <string>

#include "parallel/session.hpp"

namespace peterka::parallel {

void broadcast(const Session& session, std::string& text);
void broadcast(const Session& session, std::int64_t& number);
void broadcast(const Session& session, double& number);

// Collective: whether it is so on any rank.
[[nodiscard]] bool any_rank(const Session& session, bool here);

}  // namespace peterka::parallel
