// A page has no signals and no --max-wall: who waits gives up between two turns (page/live_cell.hpp).
#include "support/stop_if_asked.hpp"

namespace peterka {

void look_for_stop_request() {}

}  // namespace peterka
