#include "map_file/raw_bytes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <string_view>

#include "hdf5/disk_file.hpp"
#include "hdf5/hdf5.hpp"
#include "hdf5/storage.hpp"
#include "map_file/sum.hpp"
#include "map_file/trial.hpp"
#include "support/errors.hpp"

namespace peterka::map_file {

namespace {

constexpr std::uint64_t record_size = hdf5::text_capacity;
constexpr std::string_view title = "peterka bytes 1, XXH3 ";
constexpr std::size_t sum_digits = 16;
constexpr std::size_t first_line = title.size() + sum_digits + 1;

std::string line_of(std::uint64_t sum) {
    return fmt::format("{}{:0{}x}\n", title, sum, sum_digits);
}

std::vector<ByteRange> joined(std::vector<ByteRange> ranges) {
    std::ranges::sort(ranges, {}, &ByteRange::begin);
    std::vector<ByteRange> result;
    for (const ByteRange& range : ranges) {
        if (!result.empty() && result.back().end == range.begin) {
            result.back().end = range.end;
        } else if (range.begin < range.end) {
            result.push_back(range);
        }
    }
    return result;
}

std::string in_lines(const std::vector<ByteRange>& ranges) {
    std::string text;
    for (const ByteRange& range : ranges) text += fmt::format("{} {}\n", range.begin, range.end);
    return text;
}

// `lines`: the record after its first line, to its end.
std::uint64_t sum_of(std::string_view lines, const std::vector<ByteRange>& ranges, const ReadBytes& read) {
    Sum sum;
    sum.add(std::as_bytes(std::span(lines)));
    std::vector<std::byte> room;
    std::uint64_t next = 0;
    for (const ByteRange& range : ranges) {
        while (next < range.begin) {
            constexpr std::uint64_t at_once = 1 << 20;
            room.resize(std::min(at_once, range.begin - next));
            read(next, room);
            sum.add(room);
            next += room.size();
        }
        next = range.end;
    }
    return sum.value();
}

// Nothing for what no record contains.
std::optional<std::uint64_t> number(std::string_view& text, char behind) {
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const auto length = static_cast<std::size_t>(end - text.data());
    if (error != std::errc() || length == text.size() || *end != behind) return std::nullopt;
    text.remove_prefix(length + 1);
    return value;
}

// Ranges in order, disjoint, and with the record itself as the last; empty otherwise.
std::vector<ByteRange> ranges_in(std::string_view lines, std::uint64_t file_size) {
    std::vector<ByteRange> ranges;
    while (!lines.empty() && lines.front() != '\0') {
        const auto begin = number(lines, ' ');
        const auto end = begin ? number(lines, '\n') : std::nullopt;
        if (!end || *begin >= *end || (!ranges.empty() && *begin <= ranges.back().end)) return {};
        ranges.push_back({*begin, *end});
    }
    if (ranges.empty() || ranges.back().end != file_size) return {};
    return ranges.back().begin <= place_of_record(file_size).begin ? ranges : std::vector<ByteRange>{};
}

std::string read_record(std::uint64_t file_size, const ReadBytes& read) {
    std::string record(record_size, '\0');
    read(place_of_record(file_size).begin, std::as_writable_bytes(std::span(record)));
    return record;
}

std::optional<bool> look_at(const std::filesystem::path& path) {
    const hdf5::DiskFile disk(path);
    return are_sound(disk.size(),
                     [&](std::uint64_t offset, std::span<std::byte> bytes) { disk.read(offset, bytes); });
}

}  // namespace

ByteRange place_of_record(std::uint64_t file_size) {
    return {file_size - std::min(file_size, record_size), file_size};
}

std::string record_for(std::uint64_t file_size, std::vector<ByteRange> numbers, const ReadBytes& read) {
    numbers.push_back(place_of_record(file_size));
    const std::vector<ByteRange> ranges = joined(std::move(numbers));
    std::string lines = in_lines(ranges);
    if (lines.size() > record_size - first_line) {
        throw Failure(ExitCode::internal,
                      fmt::format("{} ranges are more than the record has room for", ranges.size()));
    }
    lines.resize(record_size - first_line, '\0');
    return line_of(sum_of(lines, ranges, read)) + lines;
}

std::optional<bool> are_sound(std::uint64_t file_size, const ReadBytes& read) {
    if (file_size < record_size) return std::nullopt;
    const std::string record = read_record(file_size, read);
    if (!record.starts_with(title)) return std::nullopt;
    const std::string_view lines = std::string_view(record).substr(first_line);
    const std::vector<ByteRange> ranges = ranges_in(lines, file_size);
    return !ranges.empty() && record.starts_with(line_of(sum_of(lines, ranges, read)));
}

std::vector<ByteRange> ranges_of(const hdf5::Checked& check, hid_t file, std::span<const DatasetPlan> plans) {
    std::vector<ByteRange> ranges;
    for (const DatasetPlan& plan : plans) {
        const hdf5::DatasetId dataset(check(H5Dopen2(file, plan.path().c_str(), H5P_DEFAULT), "H5Dopen2"));
        if (const auto storage = hdf5::Storage::of(check, dataset.id()))
            ranges.push_back({storage->begin(), storage->end()});
    }
    return ranges;
}

void write_record(const std::filesystem::path& path, std::vector<ByteRange> numbers) {
    const hdf5::DiskFile disk(path);
    const ByteRange place = place_of_record(disk.size());
    if (std::erase(numbers, place) == 0)
        throw Failure(ExitCode::internal,
                      fmt::format("{}: the record of its bytes isn't its end", path.string()));
    const ReadBytes read = [&](std::uint64_t offset, std::span<std::byte> bytes) { disk.read(offset, bytes); };
    const std::string record = record_for(disk.size(), std::move(numbers), read);
    disk.write(place.begin, std::as_bytes(std::span(record)));
    if (read_record(disk.size(), read) == record) return;
    throw Failure(ExitCode::output, fmt::format("{}: doesn't hold what was just written to it; its disk may be "
                                                "failing.",
                                                path.string()));
}

std::string fault_in_bytes(const hdf5::Checked& check) {
    const auto sound = look_at(check.path());
    if (!sound) return fault_in_trial(check);
    return *sound ? "" : "is damaged: its bytes are not what was written (wrong checksum)";
}

bool are_broken(const std::filesystem::path& path) {
    return look_at(path) == false;
}

}  // namespace peterka::map_file
