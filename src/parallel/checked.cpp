#include "parallel/checked.hpp"

#include <fmt/format.h>

#include <array>
#include <string>

#include "support/errors.hpp"

namespace peterka::parallel {

void checked(std::string_view call, int code) {
    if (code == MPI_SUCCESS) return;
    std::array<char, MPI_MAX_ERROR_STRING> text{};
    int length = 0;
    MPI_Error_string(code, text.data(), &length);
    int rank = -1;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    throw Failure(
        ExitCode::internal,
        fmt::format("{} failed on rank {}: {}. A node or the network may be at fault; the same command "
                    "resumes the run.",
                    call, rank, std::string_view(text.data(), static_cast<std::size_t>(length))));
}

}  // namespace peterka::parallel
