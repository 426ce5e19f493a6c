#include "parallel/collective.hpp"

#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <string>

#include "parallel/checked.hpp"
#include "support/errors.hpp"
#include "support/stop_if_asked.hpp"

namespace peterka::parallel {

namespace {

int size_of(MPI_Comm communicator) {
    int size = 1;
    parallel::checked("MPI_Comm_size", MPI_Comm_size(communicator, &size));
    return size;
}

std::optional<Failure> failure_of(const std::function<void()>& task) {
    try {
        task();
    } catch (const Stopped&) {
        return Failure(ExitCode::stopped_early, "");
    } catch (const std::exception& error) {
        return as_failure(error);
    }
    return std::nullopt;
}

void throw_lowest(const std::optional<Failure>& mine, MPI_Comm communicator) {
    constexpr int none = std::numeric_limits<int>::max();
    int lowest = mine ? rank_in(communicator) : none;
    parallel::checked("MPI_Allreduce", MPI_Allreduce(MPI_IN_PLACE, &lowest, 1, MPI_INT, MPI_MIN, communicator));
    if (lowest == none) return;
    std::string text = mine ? mine->what() : "";
    int head[2] = {mine ? static_cast<int>(mine->code()) : 0, static_cast<int>(text.size())};
    parallel::checked("MPI_Bcast", MPI_Bcast(head, 2, MPI_INT, lowest, communicator));
    text.resize(static_cast<std::size_t>(head[1]));
    parallel::checked("MPI_Bcast", MPI_Bcast(text.data(), head[1], MPI_CHAR, lowest, communicator));
    const auto code = static_cast<ExitCode>(head[0]);
    if (code == ExitCode::stopped_early) throw Stopped();
    throw Failure(code, text);
}

}  // namespace

int rank_in(MPI_Comm communicator) {
    int rank = 0;
    parallel::checked("MPI_Comm_rank", MPI_Comm_rank(communicator, &rank));
    return rank;
}

Share share_of(std::int64_t tiles, MPI_Comm communicator) {
    const std::int64_t rank = rank_in(communicator);
    const std::int64_t size = size_of(communicator);
    return {tiles * rank / size, tiles * (rank + 1) / size};
}

void together(MPI_Comm communicator, const std::function<void()>& task) {
    throw_lowest(failure_of(task), communicator);
}

void on_first_rank(MPI_Comm communicator, const std::function<void()>& task) {
    together(communicator, [&] {
        if (rank_in(communicator) == 0) task();
    });
}

void unite(parallel::TileSet& tiles, MPI_Comm communicator) {
    const std::span<std::uint64_t> words = tiles.words();
    parallel::checked("MPI_Allreduce", MPI_Allreduce(MPI_IN_PLACE, words.data(), static_cast<int>(words.size()),
                                                     MPI_UINT64_T, MPI_BOR, communicator));
}

std::vector<std::byte> gather_bytes(std::span<const std::byte> mine, MPI_Comm communicator) {
    std::vector<int> counts(static_cast<std::size_t>(size_of(communicator)));
    const auto count = static_cast<int>(mine.size());
    parallel::checked("MPI_Allgather",
                      MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, communicator));
    std::vector<int> starts(counts.size());
    std::exclusive_scan(counts.begin(), counts.end(), starts.begin(), 0);
    std::vector<std::byte> all(static_cast<std::size_t>(starts.back() + counts.back()));
    parallel::checked("MPI_Allgatherv", MPI_Allgatherv(mine.data(), count, MPI_BYTE, all.data(), counts.data(),
                                                       starts.data(), MPI_BYTE, communicator));
    return all;
}

}  // namespace peterka::parallel
