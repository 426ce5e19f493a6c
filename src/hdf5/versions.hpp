// Names that differ between releases of HDF5: objects of a file are distinguished by their address up to 1.10
// (Debian 12) and by a token from 1.12 on (Debian 13). No other code depends on the release.
#pragma once

#include <hdf5.h>

#include <array>
#include <bit>
#include <cstddef>

namespace peterka::hdf5 {

#if H5_VERSION_GE(1, 12, 0)

using ObjectInfo = H5O_info2_t;
using ObjectToken = H5O_token_t;
inline herr_t get_object_info(hid_t location, const char* name, ObjectInfo* info, unsigned fields) {
    return H5Oget_info_by_name3(location, name, info, fields, H5P_DEFAULT);
}
inline ObjectToken token_of(const ObjectInfo& info) {
    return info.token;
}

#else

using ObjectInfo = H5O_info_t;
using ObjectToken = haddr_t;
inline herr_t get_object_info(hid_t location, const char* name, ObjectInfo* info, unsigned fields) {
    return H5Oget_info_by_name2(location, name, info, fields, H5P_DEFAULT);
}
inline ObjectToken token_of(const ObjectInfo& info) {
    return info.addr;
}

#endif

// Two objects of one file are the same if these are equal.
using ObjectIdentity = std::array<std::byte, sizeof(ObjectToken)>;
inline ObjectIdentity identity_of(const ObjectInfo& info) {
    return std::bit_cast<ObjectIdentity>(token_of(info));
}

}  // namespace peterka::hdf5
