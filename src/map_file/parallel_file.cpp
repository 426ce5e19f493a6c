#include "map_file/parallel_file.hpp"

#include <exception>

#include "map_file/make_layout.hpp"
#include "parallel/collective.hpp"

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

void ParallelFile::close() {
    parallel::together(communicator_, [&] { check_(H5Fclose(file_.release()), "H5Fclose"); });
}

}  // namespace peterka::map_file
