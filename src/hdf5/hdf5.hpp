// Owners of HDF5 identifiers: each closes its identifier once, and can be moved but not copied.
//
// HDF5 returns every object as an hid_t that must be closed by the call for its kind; an owner of a negative
// one owns nothing.
#pragma once

#include <hdf5.h>

#include <utility>

namespace peterka::hdf5 {

template <herr_t (*Close)(hid_t)>
class Owner {
  public:
    Owner() = default;
    explicit Owner(hid_t id) : id_(id) {}
    Owner(Owner&& other) noexcept : id_(other.release()) {}
    Owner& operator=(Owner&& other) noexcept {
        Owner(std::move(other)).swap(*this);
        return *this;
    }
    ~Owner() {
        if (id_ >= 0) Close(id_);
    }

    [[nodiscard]] hid_t id() const { return id_; }
    hid_t release() { return std::exchange(id_, H5I_INVALID_HID); }
    void swap(Owner& other) noexcept { std::swap(id_, other.id_); }

  private:
    hid_t id_ = H5I_INVALID_HID;
};

using FileId = Owner<H5Fclose>;
using GroupId = Owner<H5Gclose>;
using DatasetId = Owner<H5Dclose>;
using SpaceId = Owner<H5Sclose>;
using TypeId = Owner<H5Tclose>;
using AttributeId = Owner<H5Aclose>;
using PropertiesId = Owner<H5Pclose>;

}  // namespace peterka::hdf5
