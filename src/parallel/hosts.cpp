#include "parallel/hosts.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "parallel/checked.hpp"

namespace peterka::parallel {
namespace {

using Name = std::array<char, MPI_MAX_PROCESSOR_NAME>;

Name own_name() {
    Name name{};
    int length = 0;
    checked("MPI_Get_processor_name", MPI_Get_processor_name(name.data(), &length));
    return name;
}

}  // namespace

std::string host_names(const Session& session) {
    const Name own = own_name();
    std::vector<Name> names(session.is_root() ? static_cast<std::size_t>(session.size()) : 0);
    const int length = static_cast<int>(own.size());
    checked("MPI_Gather", MPI_Gather(own.data(), length, MPI_CHAR, names.data(), length, MPI_CHAR, 0,
                                     session.communicator()));
    std::vector<std::string> different;
    for (const Name& name : names) {
        if (std::ranges::find(different, name.data()) == different.end()) different.emplace_back(name.data());
    }
    std::string text;
    for (const std::string& name : different) text += (text.empty() ? "" : ", ") + name;
    return text;
}

int ranks_of_host(MPI_Comm communicator) {
    MPI_Comm host = MPI_COMM_NULL;
    checked("MPI_Comm_split_type",
            MPI_Comm_split_type(communicator, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &host));
    int ranks = 1;
    checked("MPI_Comm_size", MPI_Comm_size(host, &ranks));
    checked("MPI_Comm_free", MPI_Comm_free(&host));
    return ranks;
}

}  // namespace peterka::parallel
