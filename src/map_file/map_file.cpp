#include "map_file/map_file.hpp"

#include <fmt/format.h>

#include <numeric>
#include <utility>

#include "findings/attractors.hpp"
#include "hdf5/block.hpp"
#include "hdf5/stored.hpp"
#include "map_file/attractor_samples.hpp"
#include "map_file/layout.hpp"
#include "map_file/make_layout.hpp"
#include "map_file/number_attractors.hpp"
#include "map_file/samples.hpp"
#include "map_file/seal.hpp"
#include "map_file/survey.hpp"
#include "map_file/tile_bytes.hpp"
#include "parallel/collective.hpp"
#include "support/readable.hpp"
#include "support/stop_if_asked.hpp"

namespace peterka::map_file {

namespace {

// Attractors stored for each cell.
std::int64_t kept_of(const job::Starts& starts) {
    return starts.count > 0 ? starts.attractors : 0;
}

std::string in_lines(std::span<const std::string> sentences) {
    std::string text;
    for (const std::string& sentence : sentences) text += sentence + "\n";
    return text;
}

std::string table_full_text(std::int64_t left_over) {
    if (left_over == 0) return "";
    return fmt::format("{} cells lead to attractors beyond the {} that the table holds: attractor {}\n",
                       readable_count(left_over), attractor_capacity, findings::no_attractor);
}

void write_facts(const hdf5::OpenMap& map, const RunFacts& facts) {
    const auto add = [&](const char* name, double seconds) {
        hdf5::put_number(map, name, hdf5::Number::float64,
                         hdf5::get_number(map, name, hdf5::Number::float64) + seconds);
    };
    add(path::compute_seconds, facts.compute_seconds);
    add(path::solve_seconds, facts.solve_seconds);
    hdf5::put_number(map, path::ranks, hdf5::Number::int32, facts.ranks);
    hdf5::put_text(map, path::hosts, facts.hosts);
}

}  // namespace

MapFile::MapFile(hdf5::Checked check, const job::Job& job, ScalesOfCell scales, MPI_Comm communicator,
                 Access access)
    : check_(std::move(check)),
      job_(job),
      audit_rows_(audit_rows(job)),
      scales_(std::move(scales)),
      communicator_(communicator),
      rank_(parallel::rank_in(communicator)),
      file_(check_, communicator, access),
      disk_(check_.path()),
      tiles_(open_map(), job) {}

MapFile MapFile::create(const std::filesystem::path& path, const job::Job& job, const Provenance& provenance,
                        const ScalesOfCell& scales, MPI_Comm communicator) {
    parallel::on_first_rank(communicator, [&] { make_file(path, job, provenance); });
    return open(path, job, scales, communicator);
}

MapFile MapFile::open(const std::filesystem::path& path, const job::Job& job, const ScalesOfCell& scales,
                      MPI_Comm communicator, Access access) {
    return {hdf5::Checked(path), job, scales, communicator, access};
}

void MapFile::write_tile(const parallel::Tile& tile, std::span<const attractors::SolvedCell> cells,
                         double seconds) {
    std::vector<quantities::StoredCell> stored;
    std::vector<scene::Scales> scales;
    for (std::int64_t i = 0; i < std::ssize(cells); ++i) {
        const std::int64_t row = tile.row + i / tile.extent.columns;
        const std::int64_t column = tile.column + i % tile.extent.columns;
        scales.push_back(scales_(row, column));
        stored.push_back(quantities::in_file_units(cells[static_cast<std::size_t>(i)].cell, scales.back()));
    }
    tiles_.write(tile, stored, {seconds, rank_}, bytes_of_slots(cells, scales));
}

std::vector<std::byte> MapFile::bytes_of_slots(std::span<const attractors::SolvedCell> cells,
                                               std::span<const scene::Scales> scales) const {
    std::vector<std::byte> bytes = encode(quantities::stored_attractor_fields(job_),
                                          stored_attractors(cells, kept_of(job_.starts), scales));
    if (job_.uncertainty.rigs == 0) return bytes;
    const std::vector<std::byte> more =
        encode(quantities::stored_outcome_fields(job_), stored_outcomes(cells, scales));
    bytes.insert(bytes.end(), more.begin(), more.end());
    return bytes;
}

void MapFile::write_branches(const parallel::Tile& tile, std::span<const regime::BranchPoint> points,
                             std::span<const attractors::PointAttractors> attractors, double seconds) {
    std::vector<quantities::StoredCell> stored;
    std::vector<attractors::SolvedCell> cells(attractors.empty() ? 0 : points.size());
    std::vector<scene::Scales> scales;
    for (std::int64_t i = 0; i < std::ssize(points); ++i) {
        const std::int64_t column = i % tile.extent.columns;
        scales.push_back(scales_(tile.row + i / tile.extent.columns, column));
        stored.push_back(quantities::in_file_units(points[static_cast<std::size_t>(i)].cell, scales.back()));
        if (cells.empty()) continue;
        cells[static_cast<std::size_t>(i)].attractors = attractors[static_cast<std::size_t>(column)].kept;
        cells[static_cast<std::size_t>(i)].outcomes = attractors[static_cast<std::size_t>(column)].outcomes;
    }
    std::vector<std::byte> several = bytes_of_slots(cells, scales);
    const auto append = [&](std::span<const std::byte> bytes) {
        several.insert(several.end(), bytes.begin(), bytes.end());
    };
    const std::vector<double> samples = sample_values(points, job_.sweep.samples);
    append(std::as_bytes(std::span(samples)));
    if (job_.starts.count > 0) append(attractor_sample_bytes(attractors, tile.extent.rows, job_.sweep.samples));
    tiles_.write(tile, stored, {seconds, rank_}, several);
}

void MapFile::write_attractors(std::int64_t index, std::span<const quantities::StoredCell> cells,
                               std::span<const quantities::StoredAttractor> attractors) {
    const parallel::Tile tile = tiling().tile(index);
    std::vector<std::byte> several = encode(quantities::stored_attractor_fields(job_), attractors);
    const std::vector<std::byte> outcomes =
        encode(quantities::stored_outcome_fields(job_), tiles_.read_outcomes(tile));
    several.insert(several.end(), outcomes.begin(), outcomes.end());
    tiles_.write_again(tile, cells, several);
}

RemainingTiles MapFile::remaining_tiles() {
    const parallel::Share share = parallel::share_of(tiling().count(), communicator_);
    RemainingTiles remaining{.tiles = parallel::TileSet(tiling().count())};
    parallel::together(communicator_, [&] {
        for (std::int64_t index = share.first; index < share.end; ++index) {
            look_for_stop_request();
            const TileState state = tiles_.state(tiling().tile(index));
            if (state != TileState::whole) remaining.tiles.add(index);
            if (state == TileState::damaged) ++remaining.damaged;
        }
    });
    parallel::unite(remaining.tiles, communicator_);
    const auto damaged = parallel::gather<std::int64_t>(std::span(&remaining.damaged, 1), communicator_);
    remaining.damaged = std::accumulate(damaged.begin(), damaged.end(), std::int64_t{0});
    return remaining;
}

quantities::StoredCell MapFile::read_cell(std::int64_t row, std::int64_t column) const {
    return tiles_.read_cell({row, column});
}

std::vector<quantities::StoredCell> MapFile::read_tile(std::int64_t index) const {
    return tiles_.read(tiling().tile(index));
}

std::vector<quantities::StoredAttractor> MapFile::read_attractors(std::int64_t index) const {
    return tiles_.read_attractors(tiling().tile(index));
}

std::vector<quantities::StoredOutcome> MapFile::read_outcomes(std::int64_t index) const {
    return tiles_.read_outcomes(tiling().tile(index));
}

std::vector<findings::Attractor> MapFile::basin_attractors() const {
    return read_attractor_table(open_map());
}

std::optional<AuditReport> MapFile::audit_report() {
    if (audit_rows_ == 0) return std::nullopt;
    settle();
    std::vector<AuditRow> rows;
    parallel::together(communicator_, [&] {
        rows = audit().read(audit_rows_);
        if (job_.refine.levels == 0) return;
        const std::int64_t columns = job_.columns.points;
        for (AuditRow& row : rows) {
            const quantities::StoredCell cell = read_cell(row.cell / columns, row.cell % columns);
            row.computed = cell.computed;
            if (!cell.computed) row.filled_force_error = force_error(cell, row.again);
        }
    });
    return report(rows);
}

void MapFile::settle() {
    file_.settle();
    parallel::together(communicator_, [&] { disk_.settle(); });
}

findings::Statistics MapFile::statistics() {
    settle();
    return survey(tiles_, job_, communicator_);
}

void MapFile::record(const RunFacts& facts) {
    parallel::on_first_rank(communicator_, [&] {
        require_presence();
        write_facts(open_map(), facts);
    });
}

void MapFile::finish(const findings::Statistics& statistics, std::span<const std::string> omitted,
                     const RunFacts& facts) {
    std::string failures = findings::failure_text(statistics.counts);
    if (job_.kind == job::Kind::basin) {
        failures += table_full_text(number_attractors(open_map(), tiles_, communicator_));
    }
    const std::optional<AuditReport> audited = audit_report();
    parallel::on_first_rank(communicator_, [&] {
        if (audited) audit().write(*audited);
        write_facts(open_map(), facts);
        hdf5::put_text(open_map(), path::omitted, in_lines(omitted));
        hdf5::put_text(open_map(), path::failures, failures);
    });
    settle();
    parallel::on_first_rank(communicator_, [&] {
        require_presence();
        seal();
        hdf5::put_number(open_map(), path::finished, hdf5::Number::int8, 1);
    });
    settle();
    parallel::on_first_rank(communicator_, [&] { remove_previous(check_.path()); });
}

// Verified once more from the disk: a seal computed from misread data must not remain.
void MapFile::seal() {
    const auto look = [&](const auto& use) {
        const hdf5::PropertiesId access = file_access(check_);
        const hdf5::FileId file(check_(H5Fopen(check_.path().c_str(), H5F_ACC_RDONLY, access.id()), "H5Fopen"));
        return use(file.id());
    };
    const std::uint64_t sum = look([&](hid_t file) { return seal_of(check_, file, &disk_); });
    hdf5::Stored(open_map(), path::sum_of_file, hdf5::Number::uint64).write(hdf5::Block(0, 1), &sum);
    if (look([&](hid_t file) { return is_sealed(check_, file); })) return;
    throw Failure(
        ExitCode::output,
        fmt::format("{}: can't be read twice alike: its disk may be failing, or memory has run out. Run "
                    "the same command again.",
                    check_.path().string()));
}

void MapFile::close() {
    { const TileStore closing = std::move(tiles_); }  // while their file is still open
    file_.close();
    parallel::on_first_rank(communicator_, [&] { remove_files_of_mpi(check_.path()); });
}

}  // namespace peterka::map_file
