// A folder that all ranks share: made by rank 0, removed when all have left it.
#pragma once

#include <mpi.h>

#include <array>
#include <filesystem>
#include <optional>

#include "../unit/map_examples.hpp"

namespace peterka::map_file::examples {

class SharedFolder {
  public:
    SharedFolder() {
        int rank = 0;
        MPI_Comm_rank(MPI_COMM_WORLD, &rank);
        std::array<char, 4096> name{};
        if (rank == 0) (folder_.emplace() / "").string().copy(name.data(), name.size() - 1);
        MPI_Bcast(name.data(), static_cast<int>(name.size()), MPI_CHAR, 0, MPI_COMM_WORLD);
        path_ = name.data();
    }
    SharedFolder(const SharedFolder&) = delete;
    SharedFolder& operator=(const SharedFolder&) = delete;
    ~SharedFolder() { MPI_Barrier(MPI_COMM_WORLD); }

    [[nodiscard]] std::filesystem::path operator/(const char* name) const { return path_ / name; }

  private:
    std::optional<Folder> folder_;  // on rank 0
    std::filesystem::path path_;
};

}  // namespace peterka::map_file::examples
