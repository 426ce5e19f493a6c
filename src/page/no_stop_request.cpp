// A page has no signals and no --max-wall: the caller stops between two calls (page/live_cell.hpp).
#include "support/stop_if_asked.hpp"

namespace peterka {

void look_for_stop_request() {}

}  // namespace peterka
