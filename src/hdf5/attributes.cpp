#include "hdf5/attributes.hpp"

#include "hdf5/hdf5.hpp"

namespace peterka::hdf5 {

namespace {

// Variable-length UTF-8 text, which h5py reads as str.
TypeId text_type(const Checked& check) {
    TypeId type(check(H5Tcopy(H5T_C_S1), "H5Tcopy"));
    check(H5Tset_size(type.id(), H5T_VARIABLE), "H5Tset_size");
    check(H5Tset_cset(type.id(), H5T_CSET_UTF8), "H5Tset_cset");
    return type;
}

void write(const Checked& check, hid_t object, const char* name, hid_t stored, hid_t given,
           const SpaceId& space, const void* value) {
    const AttributeId attribute(
        check(H5Acreate2(object, name, stored, space.id(), H5P_DEFAULT, H5P_DEFAULT), "H5Acreate2"));
    check(H5Awrite(attribute.id(), given, value), "H5Awrite");
}

SpaceId scalar(const Checked& check) {
    return SpaceId(check(H5Screate(H5S_SCALAR), "H5Screate"));
}

AttributeId open_scalar(hid_t object, const char* name) {
    if (H5Aexists(object, name) <= 0) return {};
    AttributeId attribute(H5Aopen(object, name, H5P_DEFAULT));
    const SpaceId space(H5Aget_space(attribute.id()));
    if (H5Sget_simple_extent_npoints(space.id()) != 1) return {};
    return attribute;
}

}  // namespace

void write_attribute(const Checked& check, hid_t object, const char* name, const std::string& text) {
    const TypeId type = text_type(check);
    const char* const pointer = text.c_str();
    write(check, object, name, type.id(), type.id(), scalar(check), &pointer);
}

void write_attribute(const Checked& check, hid_t object, const char* name, double number) {
    write(check, object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, scalar(check), &number);
}

void write_attribute(const Checked& check, hid_t object, const char* name, std::int32_t number) {
    write(check, object, name, H5T_STD_I32LE, H5T_NATIVE_INT32, scalar(check), &number);
}

void write_attribute(const Checked& check, hid_t object, const char* name,
                     std::span<const std::int8_t> numbers) {
    const hsize_t count = numbers.size();
    const SpaceId space(check(H5Screate_simple(1, &count, nullptr), "H5Screate_simple"));
    write(check, object, name, H5T_STD_I8LE, H5T_NATIVE_INT8, space, numbers.data());
}

void write_attribute(const Checked& check, hid_t object, const char* name,
                     std::span<const std::int32_t> numbers) {
    const hsize_t count = numbers.size();
    const SpaceId space(check(H5Screate_simple(1, &count, nullptr), "H5Screate_simple"));
    write(check, object, name, H5T_STD_I32LE, H5T_NATIVE_INT32, space, numbers.data());
}

std::optional<std::string> read_text(hid_t object, const char* name) {
    const AttributeId attribute = open_scalar(object, name);
    if (attribute.id() < 0) return std::nullopt;
    const TypeId stored(H5Aget_type(attribute.id()));
    if (H5Tis_variable_str(stored.id()) <= 0) return std::nullopt;
    char* text = nullptr;
    if (H5Aread(attribute.id(), stored.id(), &text) < 0 || text == nullptr) return std::nullopt;
    std::string copy(text);
    H5free_memory(text);
    return copy;
}

std::optional<std::int32_t> read_integer(hid_t object, const char* name) {
    const AttributeId attribute = open_scalar(object, name);
    if (attribute.id() < 0) return std::nullopt;
    const TypeId stored(H5Aget_type(attribute.id()));
    std::int32_t number = 0;
    if (H5Tget_class(stored.id()) != H5T_INTEGER) return std::nullopt;
    if (H5Aread(attribute.id(), H5T_NATIVE_INT32, &number) < 0) return std::nullopt;
    return number;
}

}  // namespace peterka::hdf5
