#include "output/map_file.hpp"

#include <fmt/format.h>

#include <numeric>
#include <system_error>
#include <utility>

#include "output/attractors.hpp"
#include "output/block.hpp"
#include "output/collective.hpp"
#include "output/layout.hpp"
#include "output/number_attractors.hpp"
#include "output/samples.hpp"
#include "output/survey.hpp"
#include "support/readable.hpp"

namespace peterka::output {

namespace {

std::string in_lines(std::span<const std::string> sentences) {
    std::string text;
    for (const std::string& sentence : sentences) text += sentence + "\n";
    return text;
}

std::string table_full_text(std::int64_t left_over) {
    if (left_over == 0) return "";
    return fmt::format("{} cells lead to attractors beyond the {} that the table holds: attractor {}\n",
                       readable_count(left_over), attractor_capacity, no_attractor);
}

void write_facts(const Checked& check, hid_t file, const RunFacts& facts) {
    const auto add = [&](const char* name, double seconds) {
        write_number(check, file, name, read_number(check, file, name) + seconds);
    };
    add(path::compute_seconds, facts.compute_seconds);
    add(path::solve_seconds, facts.solve_seconds);
    write_number(check, file, path::ranks, facts.ranks);
    write_text(check, file, path::hosts, facts.hosts);
}

}  // namespace

MapFile::MapFile(Checked check, const job::Job& job, const scene::Scales& scales, MPI_Comm communicator,
                 Access access)
    : check_(std::move(check)),
      job_(job),
      audit_rows_(output::audit_rows(job)),
      scales_(scales),
      communicator_(communicator),
      rank_(rank_in(communicator)),
      file_(check_, communicator, access),
      tiles_(check_, file_.id(), job) {}

MapFile MapFile::create(const std::filesystem::path& path, const job::Job& job, const Provenance& provenance,
                        const scene::Scales& scales, MPI_Comm communicator) {
    on_first_rank(communicator, [&] { make_file(path, job, provenance); });
    return open(path, job, scales, communicator);
}

MapFile MapFile::open(const std::filesystem::path& path, const job::Job& job, const scene::Scales& scales,
                      MPI_Comm communicator, Access access) {
    return {Checked(path), job, scales, communicator, access};
}

void MapFile::write_tile(const parallel::Tile& tile, std::span<const regime::CellResult> cells,
                         double seconds) {
    std::vector<StoredCell> stored;
    for (const regime::CellResult& cell : cells) stored.push_back(in_file_units(cell, scales_));
    tiles_.write(tile, stored, {seconds, rank_});
}

void MapFile::require_presence() const {
    std::error_code error;
    if (std::filesystem::exists(check_.path(), error) || error) return;
    throw Failure(
        ExitCode::output,
        fmt::format("{}: has vanished while the run was writing it: somebody removed or renamed it or its "
                    "folder. Put it back, or let the same command start over.",
                    check_.path().string()));
}

void MapFile::write_branch(const parallel::Tile& tile, std::span<const regime::BranchPoint> points,
                           double seconds) {
    std::vector<StoredCell> stored;
    for (const regime::BranchPoint& point : points) stored.push_back(in_file_units(point.cell, scales_));
    tiles_.write(tile, stored, {seconds, rank_},
                 sample_values(points, job_.sweep.branch(tile.row).gap_ratio, job_.sweep.samples));
}

RemainingTiles MapFile::remaining_tiles() {
    const Share share = share_of(tiling().count(), communicator_);
    RemainingTiles remaining{.tiles = parallel::TileSet(tiling().count())};
    together(communicator_, [&] {
        for (std::int64_t index = share.first; index < share.end; ++index) {
            const TileState state = tiles_.state(tiling().tile(index));
            if (state != TileState::whole) remaining.tiles.add(index);
            if (state == TileState::damaged) ++remaining.damaged;
        }
    });
    unite(remaining.tiles, communicator_);
    const auto damaged = gather<std::int64_t>(std::span(&remaining.damaged, 1), communicator_);
    remaining.damaged = std::accumulate(damaged.begin(), damaged.end(), std::int64_t{0});
    return remaining;
}

StoredCell MapFile::read_cell(std::int64_t row, std::int64_t column) const {
    return tiles_.read({.row = row, .column = column, .extent = {1, 1}}).front();
}

std::vector<StoredCell> MapFile::read_tile(std::int64_t index) const {
    return tiles_.read(tiling().tile(index));
}

std::optional<AuditReport> MapFile::audit_report() {
    if (audit_rows_ == 0) return std::nullopt;
    file_.settle();
    std::vector<AuditRow> rows;
    together(communicator_, [&] { rows = audit().read(audit_rows_); });
    return report(rows);
}

Statistics MapFile::statistics() {
    file_.settle();
    return survey(tiles_, communicator_);
}

void MapFile::record(const RunFacts& facts) {
    on_first_rank(communicator_, [&] {
        require_presence();
        write_facts(check_, file_.id(), facts);
    });
}

void MapFile::finish(const Statistics& statistics, std::span<const std::string> omitted,
                     const RunFacts& facts) {
    std::string failures = failure_text(statistics.counts);
    if (job_.kind == job::Kind::basin) {
        failures += table_full_text(number_attractors(check_, file_.id(), tiles_, communicator_));
    }
    const std::optional<AuditReport> audited = audit_report();
    on_first_rank(communicator_, [&] {
        if (audited) audit().write(*audited);
        write_facts(check_, file_.id(), facts);
        write_text(check_, file_.id(), path::omitted, in_lines(omitted));
        write_text(check_, file_.id(), path::failures, failures);
    });
    file_.settle();
    on_first_rank(communicator_, [&] {
        require_presence();
        write_number(check_, file_.id(), path::finished, 1);
        std::error_code ignored;
        std::filesystem::remove(previous_name(check_.path()), ignored);
    });
}

void MapFile::close() {
    { const TileStore closing = std::move(tiles_); }  // HDF5 refuses to close a file with datasets open
    file_.close();
}

}  // namespace peterka::output
