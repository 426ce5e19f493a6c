#include "hdf5/variable.hpp"

namespace peterka::hdf5 {

std::size_t bytes_of(Number number) {
    if (number == Number::text) return text_capacity;
    return visit_number(number, [](auto zero) { return sizeof(zero); });
}

hid_t memory_type(Number number) {
    switch (number) {
        case Number::int8:
            return H5T_NATIVE_INT8;
        case Number::int32:
            return H5T_NATIVE_INT32;
        case Number::int64:
            return H5T_NATIVE_INT64;
        case Number::uint64:
            return H5T_NATIVE_UINT64;
        case Number::float64:
            return H5T_NATIVE_DOUBLE;
        case Number::text:
            break;
    }
    return H5I_INVALID_HID;
}

namespace {

hid_t standard_type(Number number) {
    switch (number) {
        case Number::int8:
            return H5T_STD_I8LE;
        case Number::int32:
            return H5T_STD_I32LE;
        case Number::int64:
            return H5T_STD_I64LE;
        case Number::uint64:
            return H5T_STD_U64LE;
        case Number::float64:
            return H5T_IEEE_F64LE;
        case Number::text:
            break;
    }
    return H5T_C_S1;
}

}  // namespace

TypeId file_type(const Checked& check, Number number) {
    TypeId type(check(H5Tcopy(standard_type(number)), "H5Tcopy"));
    if (number == Number::text) {
        check(H5Tset_size(type.id(), text_capacity), "H5Tset_size");
        check(H5Tset_cset(type.id(), H5T_CSET_UTF8), "H5Tset_cset");
    }
    return type;
}

}  // namespace peterka::hdf5
