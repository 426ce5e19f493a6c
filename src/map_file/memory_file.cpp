#include "map_file/memory_file.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>

#include "map_file/make_layout.hpp"

namespace peterka::map_file {

namespace {

// The memory in which HDF5 keeps the file. HDF5 frees it on closing the file, and only then is it complete:
// H5Fget_file_image gives a superblock whose checksum is wrong.
struct Image {
    std::size_t size = 0;
    std::vector<std::byte> bytes;
};

void* take_memory(std::size_t size, H5FD_file_image_op_t, void*) {
    return std::malloc(size);
}

void* copy_memory(void* to, const void* from, std::size_t size, H5FD_file_image_op_t, void*) {
    return std::memcpy(to, from, size);
}

void* resize_memory(void* memory, std::size_t size, H5FD_file_image_op_t, void* image) {
    void* const resized = std::realloc(memory, size);
    if (resized != nullptr) static_cast<Image*>(image)->size = size;
    return resized;
}

herr_t free_memory(void* memory, H5FD_file_image_op_t operation, void* user_data) {
    auto& image = *static_cast<Image*>(user_data);
    if (operation == H5FD_FILE_IMAGE_OP_FILE_CLOSE && memory != nullptr) {
        const auto* const begin = static_cast<const std::byte*>(memory);
        image.bytes.assign(begin, begin + image.size);
    }
    std::free(memory);
    return 0;
}

void* same_image(void* image) {
    return image;
}

herr_t keep_image(void*) {
    return 0;
}

}  // namespace

std::vector<std::byte> bytes_of_file(const hdf5::Checked& check,
                                     const std::function<std::uint64_t(hid_t)>& fill) {
    constexpr std::size_t growth = 1 << 20;
    Image image;
    H5FD_file_image_callbacks_t callbacks{take_memory, copy_memory, resize_memory, free_memory,
                                          same_image,  keep_image,  &image};
    const hdf5::PropertiesId access = file_access(check);
    check(H5Pset_fapl_core(access.id(), growth, false), "H5Pset_fapl_core");
    check(H5Pset_file_image_callbacks(access.id(), &callbacks), "H5Pset_file_image_callbacks");
    hdf5::FileId file(check(
        H5Fcreate(check.path().c_str(), H5F_ACC_TRUNC, file_creation(check).id(), access.id()), "H5Fcreate"));
    const std::uint64_t end = fill(file.id());
    check(H5Fflush(file.id(), H5F_SCOPE_GLOBAL), "H5Fflush");
    check(H5Fclose(file.release()), "H5Fclose");
    image.bytes.resize(static_cast<std::size_t>(end));
    return std::move(image.bytes);
}

}  // namespace peterka::map_file
