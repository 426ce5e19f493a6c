// A file that a job names and from which it takes numbers: found from the folder of the file that names it, and
// read as TOML. Faults say what is wrong with the name, or with the file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "job/document.hpp"

namespace peterka::job {

// What the file is to be, in words of the messages.
struct NamedFile {
    std::string_view key;      // "rig"
    std::string_view what;     // "a rig"
    std::string_view example;  // "\"rigs/170mm.toml\""
};

class NamedFileReader {
  public:
    // `files` are the names indexed by Location::file; those read are appended.
    NamedFileReader(const NamedFile& kind, std::vector<std::string>& files, std::vector<Fault>& faults)
        : kind_(kind), files_(files), faults_(faults) {}

    // Where the file is that a value, read from the file `from`, names; nothing, and a fault, if it is no name
    // or not there.
    [[nodiscard]] std::optional<std::filesystem::path> find(const Value& named,
                                                            const std::filesystem::path& from) const;
    // Its content; nothing, and a fault, if it cannot be read.
    [[nodiscard]] std::optional<Value> read(const Value& named, const std::filesystem::path& path) const;

    std::nullopt_t fault(const Value& named, const std::string& text) const;

  private:
    NamedFile kind_;
    std::vector<std::string>& files_;
    std::vector<Fault>& faults_;
};

}  // namespace peterka::job
