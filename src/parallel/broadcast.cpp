#include "parallel/broadcast.hpp"

#include <fmt/format.h>

#include <limits>

#include "parallel/checked.hpp"

namespace peterka::parallel {

void broadcast(const Session& session, std::int64_t& number) {
    checked("MPI_Bcast", MPI_Bcast(&number, 1, MPI_INT64_T, 0, session.communicator()));
}

void broadcast(const Session& session, double& number) {
    checked("MPI_Bcast", MPI_Bcast(&number, 1, MPI_DOUBLE, 0, session.communicator()));
}

void broadcast(const Session& session, std::string& text) {
    auto length = static_cast<std::int64_t>(text.size());
    broadcast(session, length);
    if (length > std::numeric_limits<int>::max()) {
        throw Failure(ExitCode::internal, fmt::format("a text of {} bytes is too long to broadcast", length));
    }
    text.resize(static_cast<std::size_t>(length));
    checked("MPI_Bcast", MPI_Bcast(text.data(), static_cast<int>(length), MPI_CHAR, 0, session.communicator()));
}

}  // namespace peterka::parallel
