#include "job/read.hpp"

#include <utility>
#include <vector>

#include "job/document.hpp"
#include "job/job_source.hpp"
#include "job/overrides.hpp"
#include "job/rig_files.hpp"
#include "job/schema.hpp"
#include "job/table_reader.hpp"

namespace peterka::job {
namespace {

enum class RigFiles { followed, refused };

bool has_no_rig_file(const Value& document, std::vector<Fault>& faults) {
    const Value* rig = document.as<Table>()->find("rig");
    if (rig == nullptr) return true;
    faults.push_back({rig->where,
                      "rig names a file, and this text is none, from whose folder it could be looked "
                      "for; write the job to a file, or its numbers under [hammer], [cart] and "
                      "[contact]"});
    return false;
}

JobWithOrigins read(std::string_view text, const std::string& name, std::span<const std::string> overrides,
                    RigFiles rigs) {
    refuse_what_is_no_text(text, name);
    Value document = parse_document(text, name);
    std::vector<Fault> faults;
    apply_overrides(document, overrides, faults);
    std::vector<std::string> files{name};
    const bool has_rig = rigs == RigFiles::followed ? bring_in_rigs(document, name, files, faults)
                                                    : has_no_rig_file(document, faults);
    Job job;
    if (has_rig) {  // else numbers that the rig gives would be reported missing
        TableReader reader(document, "", faults);
        describe(reader, job);
        reader.finish();
    }
    if (!faults.empty()) throw JobFaults(files, faults);
    return {job, origins_of(document, files)};
}

}  // namespace

Job read_job_file(const std::filesystem::path& path, std::span<const std::string> overrides) {
    return read_job_with_origins(path, overrides).job;
}

Job read_job_text(std::string_view text, const std::string& name, std::span<const std::string> overrides) {
    return read(text, name, overrides, RigFiles::refused).job;
}

JobWithOrigins read_job_with_origins(const std::filesystem::path& path,
                                     std::span<const std::string> overrides) {
    return read(read_text(path), path.string(), overrides, RigFiles::followed);
}

}  // namespace peterka::job
