#include "output/parallel_file.hpp"

#include <exception>

#include "output/collective.hpp"
#include "output/make_layout.hpp"

namespace peterka::output {

ParallelFile::ParallelFile(const Checked& check, MPI_Comm communicator, Access access)
    : check_(check), communicator_(communicator) {
    together(communicator, [&] {
        const PropertiesId properties = file_access(check);
        check(H5Pset_fapl_mpio(properties.id(), communicator, MPI_INFO_NULL), "H5Pset_fapl_mpio");
        const unsigned mode = access == Access::write ? H5F_ACC_RDWR : H5F_ACC_RDONLY;
        file_ = FileId(check(H5Fopen(check.path().c_str(), mode, properties.id()), "H5Fopen"));
    });
}

ParallelFile::~ParallelFile() {
    if (std::uncaught_exceptions() > 0) file_.release();
}

void ParallelFile::settle() {
    together(communicator_, [&] { check_(H5Fflush(file_.id(), H5F_SCOPE_GLOBAL), "H5Fflush"); });
}

void ParallelFile::close() {
    together(communicator_, [&] { check_(H5Fclose(file_.release()), "H5Fclose"); });
}

}  // namespace peterka::output
