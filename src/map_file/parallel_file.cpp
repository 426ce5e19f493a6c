#include "map_file/parallel_file.hpp"

#include <fmt/format.h>

#include <exception>

#include "map_file/make_layout.hpp"
#include "parallel/collective.hpp"
#include "support/errors.hpp"

namespace peterka::map_file {

ParallelFile::ParallelFile(const hdf5::Checked& check, MPI_Comm communicator, Access access)
    : check_(check), communicator_(communicator) {
    parallel::together(communicator, [&] {
        const hdf5::PropertiesId properties = file_access(check);
        check(H5Pset_fapl_mpio(properties.id(), communicator, MPI_INFO_NULL), "H5Pset_fapl_mpio");
        const unsigned mode = access == Access::write ? H5F_ACC_RDWR : H5F_ACC_RDONLY;
        file_ = hdf5::FileId(check(H5Fopen(check.path().c_str(), mode, properties.id()), "H5Fopen"));
    });
}

ParallelFile::~ParallelFile() {
    if (std::uncaught_exceptions() > 0) file_.release();
}

void ParallelFile::settle() {
    parallel::together(communicator_, [&] { check_(H5Fflush(file_.id(), H5F_SCOPE_GLOBAL), "H5Fflush"); });
}

// H5Fclose would rewrite the superblock unchanged. If that fails, the rank that does so goes on to
// MPI_File_close, while the others wait for it before that, forever (H5AC__run_sync_point of HDF5 1.10).
void ParallelFile::close() {
    parallel::together(communicator_, [&] {
        void* mpi_file = nullptr;
        check_(H5Fget_vfd_handle(file_.id(), H5P_DEFAULT, &mpi_file), "H5Fget_vfd_handle");
        file_.release();
        if (MPI_File_close(static_cast<MPI_File*>(mpi_file)) == MPI_SUCCESS) return;
        throw Failure(ExitCode::output,
                      fmt::format("{}: MPI_File_close failed; its disk may be failing. Run the same command "
                                  "again.",
                                  check_.path().string()));
    });
}

}  // namespace peterka::map_file
