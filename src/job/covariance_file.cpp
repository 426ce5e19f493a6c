#include "job/covariance_file.hpp"

#include <optional>

#include "job/named_file.hpp"

namespace peterka::job {
namespace {

constexpr NamedFile kind{"uncertainty.file", "uncertain numbers", "\"stop_identified.toml\""};

Table* uncertainty_in(Value& document) {
    auto* all = std::get_if<Table>(&document.content);
    if (all == nullptr || all->find("uncertainty") == nullptr) return nullptr;
    return std::get_if<Table>(&all->entry("uncertainty", {}).value.content);
}

}  // namespace

const Value* named_covariance(const Value& document) {
    const auto* all = document.as<Table>();
    const Value* uncertainty = all == nullptr ? nullptr : all->find("uncertainty");
    const auto* table = uncertainty == nullptr ? nullptr : uncertainty->as<Table>();
    return table == nullptr ? nullptr : table->find("file");
}

bool bring_in_covariance(Value& document, const std::filesystem::path& job_file,
                         std::vector<std::string>& files, std::vector<Fault>& faults) {
    const Value* name = named_covariance(document);
    if (name == nullptr) return true;
    const Value named = *name;
    const NamedFileReader reader(kind, files, faults);
    Table& uncertainty = *uncertainty_in(document);
    if (uncertainty.find("covariance") != nullptr) {
        reader.fault(named,
                     "names a file with a covariance, and [uncertainty.covariance] gives one, too; numbers are "
                     "uncertain in one way; remove one of them");
        return false;
    }
    const auto path = reader.find(named, job_file);
    if (!path) return false;
    const std::optional<Value> file = reader.read(named, *path);
    if (!file) return false;
    const auto& table = *file->as<Table>();
    const Value* covariance = table.find("covariance");
    if (covariance == nullptr || covariance->as<Table>() == nullptr || table.entries.size() > 1) {
        reader.fault(
            named,
            "names no file of uncertain numbers; that has one table, [covariance], with of, mean and matrix, "
            "as identify.py writes it into STEM_identified.toml; name such a file");
        return false;
    }
    uncertainty.entry("covariance", covariance->where).value = *covariance;
    return true;
}

}  // namespace peterka::job
