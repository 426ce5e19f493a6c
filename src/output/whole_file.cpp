#include "output/whole_file.hpp"

#include <fmt/format.h>
#include <hdf5.h>

#include <fstream>
#include <string>
#include <system_error>
#include <vector>

#include "output/attributes.hpp"
#include "output/block.hpp"
#include "output/hdf5.hpp"
#include "output/inspect.hpp"
#include "output/make_file.hpp"
#include "output/make_layout.hpp"
#include "output/map_size.hpp"
#include "output/root_attributes.hpp"
#include "support/errors.hpp"

namespace peterka::output {

namespace {

constexpr Variable fact_variables[] = {
    {"ranks", Number::int32, 0, "1", "ranks of the run"},
    {"compute_seconds", Number::float64, 0, "s", "wall time of the run"},
    {"hosts", Number::text, 0, "", "hosts of the run"},
};
constexpr Variable finished{"finished", Number::int8, 0, "1", "1 once everything in the file is final"};

Block whole(const DatasetPlan& plan) {
    if (plan.dimensions.size() == 1) return {0, plan.dimensions[0].size};
    return Block(parallel::Tile{0, 0, 0, {plan.dimensions[0].size, plan.dimensions[1].size}});
}

void write_values(const Checked& check, hid_t file, const Table& table) {
    const std::string path = table.plan.path();
    if (table.plan.dimensions.empty()) return write_number(check, file, path.c_str(), table.values[0]);
    const DatasetId dataset(check(H5Dopen2(file, path.c_str(), H5P_DEFAULT), "H5Dopen2"));
    write_block(check, dataset.id(), Number::float64, whole(table.plan), table.values.data());
}

void write_whole(const std::filesystem::path& path, const job::Job& job, const Provenance& provenance,
                 const Contents& contents, const RunFacts& facts) {
    const Checked check(path);
    FileId file(
        check(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, file_creation(check).id(), file_access(check).id()),
              "H5Fcreate"));
    write_root_attributes(check, file.id(), job, provenance);
    for (const RootText& each : contents.texts) write_attribute(check, file.id(), each.name, each.text);
    std::vector<DatasetPlan> plans;
    for (const Table& table : contents.tables) plans.push_back(table.plan);
    for (const Variable& variable : fact_variables) plans.push_back({"/run", variable, {}});
    plans.push_back({"/summary", finished, {}});
    make_datasets(check, file.id(), plans);
    for (const Table& table : contents.tables) write_values(check, file.id(), table);
    write_number(check, file.id(), path::ranks, facts.ranks);
    write_number(check, file.id(), path::compute_seconds, facts.compute_seconds);
    write_text(check, file.id(), path::hosts, facts.hosts);
    write_number(check, file.id(), path::finished, 1);
    check(H5Fclose(file.release()), "H5Fclose");
}

}  // namespace

void require_place(const std::filesystem::path& path, std::int64_t largest_bytes) {
    static_cast<void>(holds_complete_map(path));  // refuses what is no file of this program
    require_space(path, largest_bytes);
    const std::filesystem::path temporary = temporary_name(path);
    const bool writable = std::ofstream(temporary).good();
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    if (writable) return;
    throw Failure(ExitCode::output, fmt::format("{}: no file can be made in its folder. Nothing was computed; "
                                                "choose another folder with --output.",
                                                path.string()));
}

void write_whole_file(const std::filesystem::path& path, const job::Job& job, const Provenance& provenance,
                      const Contents& contents, const RunFacts& facts) {
    const std::filesystem::path temporary = temporary_name(path);
    std::error_code error;
    try {
        write_whole(temporary, job, provenance, contents, facts);
    } catch (...) {
        std::filesystem::remove(temporary, error);
        throw;
    }
    std::filesystem::rename(temporary, path, error);
    if (!error) return;
    throw Failure(ExitCode::output, fmt::format("{}: cannot be renamed to {}: {}", temporary.string(),
                                                path.string(), error.message()));
}

}  // namespace peterka::output
