// Sends rank 0's values to every rank. Collective.
#pragma once

#include <cstdint>
#include <string>

#include "parallel/session.hpp"

namespace peterka::parallel {

void broadcast(const Session& session, std::string& text);
void broadcast(const Session& session, std::int64_t& number);
void broadcast(const Session& session, double& number);

}  // namespace peterka::parallel
