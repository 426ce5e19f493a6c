#include "job/rig_files.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "job/choose.hpp"
#include "job/named_file.hpp"
#include "job/toml_text.hpp"

namespace peterka::job {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_rigs = 16;  // that build on one another

constexpr std::array<std::string_view, 3> rig_tables{"hammer", "cart", "contact"};

// Pairs of keys of which a hammer has one.
constexpr std::pair<std::string_view, std::string_view> alternatives[] = {
    {"natural_frequency_hz", "stiffness_n_per_m"}, {"damping_ns_per_m", "damping_ratio"}};

bool has_alternative_of(const Table& table, std::string_view key) {
    return std::ranges::any_of(alternatives, [&](const auto& pair) {
        return (key == pair.first && table.find(pair.second) != nullptr) ||
               (key == pair.second && table.find(pair.first) != nullptr);
    });
}

std::optional<std::string> law_in(const Table& contact) {
    const Value* law = contact.find("law");
    return law == nullptr ? std::nullopt : word_of(*law);
}

// Adds what the rig's table has and the job's lacks.
void complete(Table& own, const Table& rig, bool is_hammer) {
    const Table given = own;
    for (const Entry& entry : rig.entries) {
        if (given.find(entry.name) != nullptr) continue;
        if (is_hammer && has_alternative_of(given, entry.name)) continue;
        own.entries.push_back(entry);
    }
}

void complete(Table& document, const Table& rig) {
    for (const std::string_view name : rig_tables) {
        const Value* brought = rig.find(name);
        if (brought == nullptr) continue;
        Value& own = document.entry(name, brought->where).value;
        auto* table = std::get_if<Table>(&own.content);
        const bool is_new = table != nullptr && table->entries.empty() && own.where == brought->where;
        const auto* more = brought->as<Table>();
        if (is_new) {
            own = *brought;
        } else if (table != nullptr && more != nullptr) {
            const auto law = law_in(*table);
            if (name == "contact" && law && law != law_in(*more)) continue;
            complete(*table, *more, name == "hammer");
        }
    }
}

constexpr NamedFile rig_kind{"rig", "a rig", "\"rigs/170mm.toml\""};

class Rigs {
  public:
    Rigs(std::vector<std::string>& files, std::vector<Fault>& faults) : reader_(rig_kind, files, faults) {}

    // Adds to `document`, read from `file`, what it takes from the rig that it names.
    void bring_into(Value& document, const fs::path& file) {
        const Value* rig = std::get<Table>(document.content).find("rig");
        if (rig == nullptr) return;
        const Value named = *rig;
        const std::optional<Value> brought = read(named, file);
        if (brought) complete(std::get<Table>(document.content), *brought->as<Table>());
    }

    void begin_with(const fs::path& job_file) { chain_.push_back(job_file.lexically_normal()); }

  private:
    std::optional<Value> read(const Value& named, const fs::path& from) {
        const std::optional<fs::path> found = reader_.find(named, from);
        if (!found) return std::nullopt;
        const fs::path& path = *found;
        if (chain_.size() > most_rigs) {
            return reader_.fault(
                named, fmt::format("is the end of a chain of more than {} rigs, each of which begins from "
                                   "the next; write its tables into one of them",
                                   most_rigs));
        }
        for (std::size_t i = 0; i < chain_.size(); ++i) {
            std::error_code unknown;
            if (fs::equivalent(chain_[i], path, unknown)) return cycle(named, i);
        }
        return read_rig(named, path);
    }

    std::nullopt_t cycle(const Value& named, std::size_t first) {
        std::string way;
        for (std::size_t i = first; i < chain_.size(); ++i) way += chain_[i].string() + " -> ";
        return reader_.fault(
            named, fmt::format("leads back to where it came from ({}{}); a rig may begin from another "
                               "one, but not from itself; remove one of these lines",
                               way, chain_[first].string()));
    }

    std::optional<Value> read_rig(const Value& named, const fs::path& path) {
        std::optional<Value> rig = reader_.read(named, path);
        if (!rig) return std::nullopt;
        if (const std::string why = why_no_rig(*rig->as<Table>()); !why.empty())
            return reader_.fault(named, why);
        chain_.push_back(path);
        bring_into(*rig, path);
        chain_.pop_back();
        return rig;
    }

    static std::string why_no_rig(const Table& table) {
        const auto is_of_rig = [](const Entry& entry) {
            return entry.name == "rig" || std::ranges::find(rig_tables, entry.name) != rig_tables.end();
        };
        std::vector<std::string> others;
        for (const Entry& entry : table.entries) {
            if (!is_of_rig(entry)) others.push_back(toml_key(entry.name));
        }
        constexpr auto what =
            "a rig file has [hammer], [cart] and [contact] or some of them, may name another "
            "rig, and has nothing else";
        if (!others.empty()) {
            return fmt::format(
                "names no rig: that file has {}, too; {}; name the file of a rig, or move these "
                "tables of that file into one",
                fmt::join(others, ", "), what);
        }
        if (table.entries.empty())
            return fmt::format("names no rig: that file has no table; {}; name the file of a rig", what);
        return "";
    }

    NamedFileReader reader_;
    std::vector<fs::path> chain_;  // from the job to the rig being read
};

// A trace of a cell of a map has the rig of that map; its tables are refused, and so is this key.
bool takes_rig_from_a_map(const Table& document) {
    for (const auto* name : {"trace", "basin"}) {
        const Value* table = document.find(name);
        if (table != nullptr && table->as<Table>() != nullptr && table->as<Table>()->find("map") != nullptr)
            return true;
    }
    return false;
}

}  // namespace

bool bring_in_rigs(Value& document, const fs::path& job_file, std::vector<std::string>& files,
                   std::vector<Fault>& faults) {
    if (takes_rig_from_a_map(std::get<Table>(document.content))) return true;
    const std::size_t faults_before = faults.size();
    Rigs rigs(files, faults);
    rigs.begin_with(job_file);
    rigs.bring_into(document, job_file);
    return faults.size() == faults_before;
}

}  // namespace peterka::job
