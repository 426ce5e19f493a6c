#include "job/read.hpp"

#include <utility>
#include <vector>

#include "job/covariance_file.hpp"
#include "job/document.hpp"
#include "job/job_source.hpp"
#include "job/misspelt_tables.hpp"
#include "job/overrides.hpp"
#include "job/rig_files.hpp"
#include "job/schema.hpp"
#include "job/table_reader.hpp"

namespace peterka::job {
namespace {

enum class OtherFiles { followed, refused };

// Both are read, so that the faults of both are told.
bool bring_in_files(Value& document, const std::string& name, std::vector<std::string>& files,
                    std::vector<Fault>& faults) {
    const bool has_rig = bring_in_rigs(document, name, files, faults);
    return bring_in_covariance(document, name, files, faults) && has_rig;
}

bool has_no_other_file(const Value& document, std::vector<Fault>& faults) {
    if (const Value* covariance = named_covariance(document)) {
        faults.push_back(
            {covariance->where,
             "uncertainty.file names a file; this text is none, from whose folder it could be "
             "looked for; write the job to a file, or the covariance under [uncertainty.covariance]"});
        return false;
    }
    const Value* rig = document.as<Table>()->find("rig");
    if (rig == nullptr) return true;
    faults.push_back({rig->where,
                      "rig names a file, and this text is none, from whose folder it could be looked "
                      "for; write the job to a file, or its numbers under [hammer], [cart] and "
                      "[contact]"});
    return false;
}

Job read_once(const Value& document, std::vector<Fault>& faults) {
    Job job;
    TableReader reader(document, "", faults);
    describe(reader, job);
    reader.finish();
    return job;
}

// With tables that are misspelt read once more under the names that are meant: what is wrong inside is told,
// too, and none of them is missing.
Job read_tables(Value document, std::vector<Fault>& faults) {
    const std::vector<Fault> of_files = std::exchange(faults, {});
    Job job = read_once(document, faults);
    std::vector<Fault> of_names;
    for (std::vector<Fault> renamed = rename_misspelt_tables(document, faults); !renamed.empty();
         renamed = rename_misspelt_tables(document, faults)) {
        of_names.insert(of_names.end(), renamed.begin(), renamed.end());
        faults.clear();
        job = read_once(document, faults);
    }
    faults.insert(faults.begin(), of_files.begin(), of_files.end());
    faults.insert(faults.end(), of_names.begin(), of_names.end());
    return job;
}

JobWithOrigins read(std::string_view text, const std::string& name, std::span<const std::string> overrides,
                    OtherFiles others) {
    refuse_what_is_no_text(text, name);
    Value document = parse_document(text, name);
    std::vector<Fault> faults;
    apply_overrides(document, overrides, faults);
    std::vector<std::string> files{name};
    const bool are_whole = others == OtherFiles::followed ? bring_in_files(document, name, files, faults)
                                                          : has_no_other_file(document, faults);
    Job job;
    // else numbers that these files give would be reported missing
    if (are_whole) job = read_tables(document, faults);
    if (!faults.empty()) throw JobFaults(files, faults);
    return {job, origins_of(document, files)};
}

}  // namespace

Job read_job_file(const std::filesystem::path& path, std::span<const std::string> overrides) {
    return read_job_with_origins(path, overrides).job;
}

Job read_job_text(std::string_view text, const std::string& name, std::span<const std::string> overrides) {
    return read(text, name, overrides, OtherFiles::refused).job;
}

JobWithOrigins read_job_with_origins(const std::filesystem::path& path,
                                     std::span<const std::string> overrides) {
    return read(read_text(path), path.string(), overrides, OtherFiles::followed);
}

}  // namespace peterka::job
