// An HDF5 file that all ranks of a communicator hold open through MPI-IO.
//
// Closing waits for all ranks, so a rank that exits because of a failure does not close. Nothing is lost, since
// data are written immediately.
#pragma once

#include <mpi.h>

#include "hdf5/checked.hpp"
#include "hdf5/hdf5.hpp"

namespace peterka::map_file {

enum class Access { write, read };

class ParallelFile {
  public:
    // Collective. All ranks throw if one of them cannot open it.
    ParallelFile(const hdf5::Checked& check, MPI_Comm communicator, Access access);
    ParallelFile(ParallelFile&&) = default;
    ParallelFile& operator=(ParallelFile&&) = delete;
    ~ParallelFile();

    [[nodiscard]] hid_t id() const { return file_.id(); }

    // Collective. What one rank wrote, another may read only after both have synchronised the file.
    void settle();
    void close();

  private:
    hdf5::Checked check_;
    MPI_Comm communicator_;
    hdf5::FileId file_;
};

}  // namespace peterka::map_file
