// A map that tests change behind its back, to see what is said of it.
#pragma once

#include <gtest/gtest.h>
#include <hdf5_hl.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "hdf5/attributes.hpp"
#include "hdf5/block.hpp"
#include "hdf5/hdf5.hpp"
#include "map_examples.hpp"
#include "map_file/inspect.hpp"
#include "map_file/layout.hpp"
#include "map_file/make_file.hpp"
#include "map_file/make_layout.hpp"
#include "map_file/raw_bytes.hpp"
#include "map_file/seal.hpp"
#include "map_file/tile_store.hpp"
#include "support/errors.hpp"

namespace peterka::map_file::examples {

class InspectedMap : public ::testing::Test {
  protected:
    void make() { make_file(path_, job_, made_by()); }

    // As somebody would who knows how to renew the record of the file's bytes.
    void change(const std::function<void(const hdf5::Checked&, hid_t)>& task) {
        const hdf5::Checked check(path_);
        hdf5::FileId file(check(H5Fopen(path_.c_str(), H5F_ACC_RDWR, file_access(check).id()), "H5Fopen"));
        task(check, file.id());
        check(H5Fclose(file.release()), "H5Fclose");
        if (are_broken(path_)) write_record(path_, {place_of_record(std::filesystem::file_size(path_))});
    }

    void write_all_tiles() {
        change([&](const hdf5::Checked& check, hid_t file) {
            const hdf5::DiskFile disk(path_);
            TileStore store({check, file, disk}, job_);
            for (std::int64_t i = 0; i < store.tiling().count(); ++i) {
                const parallel::Tile tile = store.tiling().tile(i);
                store.write(tile, made_up_stored_cells(tile), {});
            }
        });
    }

    void finish() {
        change([&](const hdf5::Checked& check, hid_t file) {
            const hdf5::DiskFile disk(path_);
            const std::uint64_t sum = seal_of(check, file, &disk);
            hdf5::Stored({check, file, disk}, path::sum_of_file, hdf5::Number::uint64)
                .write(hdf5::Block(0, 1), &sum);
            hdf5::write_number(check, file, path::finished, 1);
        });
    }

    void expect_refused(const std::string& reason) {
        try {
            (void)inspect(path_, job_);
            ADD_FAILURE() << "was not refused: " << reason;
        } catch (const Failure& failure) {
            const std::string text = failure.what();
            EXPECT_EQ(failure.code(), ExitCode::output);
            EXPECT_NE(text.find(path_.string()), std::string::npos) << text;
            EXPECT_NE(text.find(reason), std::string::npos) << text;
        }
    }

    void replace_dataset(const char* name, hid_t type, const std::vector<hsize_t>& sizes) {
        change([&](const hdf5::Checked& check, hid_t file) {
            check(H5Ldelete(file, name, H5P_DEFAULT), "H5Ldelete");
            check(H5LTmake_dataset(file, name, static_cast<int>(sizes.size()), sizes.data(), type,
                                   std::vector<double>(4000).data()),
                  "H5LTmake_dataset");
        });
    }

    Folder folder_;
    std::filesystem::path path_ = folder_ / "map.h5";
    job::Job job_ = small_map(20, 20);
};

}  // namespace peterka::map_file::examples
