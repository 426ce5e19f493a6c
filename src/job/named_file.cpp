#include "job/named_file.hpp"

#include <algorithm>
#include <system_error>

#include <fmt/format.h>

#include "job/choose.hpp"
#include "job/job_source.hpp"
#include "job/nearest.hpp"
#include "job/toml_text.hpp"
#include "support/escape_untrusted.hpp"
#include "support/folder.hpp"

namespace peterka::job {
namespace {

namespace fs = std::filesystem;

// Suggests a similar name from the same folder.
std::string did_you_mean(const fs::path& file, const fs::path& as_named) {
    const fs::path folder = file.parent_path();
    std::vector<std::string> names = names_in(folder.empty() ? "." : folder);
    std::erase_if(names, [](const std::string& each) { return !each.ends_with(".toml"); });
    std::ranges::sort(names);
    const std::string name = file.filename().string();
    const std::string_view meant = nearest(name, {names.begin(), names.end()});
    if (meant.empty()) return "check the path";
    return fmt::format("did you mean {}?", toml_text((as_named.parent_path() / meant).string()));
}

}  // namespace

std::nullopt_t NamedFileReader::fault(const Value& named, const std::string& text) const {
    faults_.push_back({named.where, fmt::format("{} = {} {}", kind_.key, named.text(), text)});
    return std::nullopt;
}

std::optional<fs::path> NamedFileReader::find(const Value& named, const fs::path& from) const {
    const auto word = word_of(named);
    if (!word) {
        return fault(named, fmt::format("is {}; it must be text (the file of {}, relative to this one); "
                                        "write it like {} = {}",
                                        named.type_in_words(), kind_.what, kind_.key, kind_.example));
    }
    if (word->empty() || escape_untrusted(*word, word->size()) != *word) {
        return fault(
            named, fmt::format("is no name of a file; it is looked for from the folder of the file that names "
                               "it; write it like {} = {}",
                               kind_.key, kind_.example));
    }
    const fs::path path = (from.parent_path() / *word).lexically_normal();
    std::error_code unknown;
    if (fs::exists(path, unknown)) return path;
    return fault(named, fmt::format("names a file that isn't there; it is looked for from the folder of "
                                    "the file that names it, as {}; {}",
                                    path.string(), did_you_mean(path, *word)));
}

std::optional<Value> NamedFileReader::read(const Value& named, const fs::path& path) const {
    const auto number = static_cast<std::uint32_t>(files_.size());
    std::optional<Value> document;
    try {
        const std::string text = read_text(path);
        if (!text.empty()) refuse_what_is_no_text(text, path.string());
        document = parse_document(text, path.string(), number);
    } catch (const JobFaults& unreadable) {
        return fault(named, fmt::format("can't be read as {}; {}", kind_.what, unreadable.what()));
    }
    files_.push_back(path.string());
    return document;
}

}  // namespace peterka::job
