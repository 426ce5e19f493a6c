#include "job/read.hpp"

#include <vector>

#include "job/document.hpp"
#include "job/job_source.hpp"
#include "job/overrides.hpp"
#include "job/schema.hpp"
#include "job/table_reader.hpp"

namespace peterka::job {

Job read_job_file(const std::filesystem::path& path, std::span<const std::string> overrides) {
    return read_job_text(read_text(path), path.string(), overrides);
}

Job read_job_text(std::string_view text, const std::string& name, std::span<const std::string> overrides) {
    refuse_what_is_no_text(text, name);
    Value document = parse_document(text, name);
    std::vector<Fault> faults;
    apply_overrides(document, overrides, faults);

    Job job;
    TableReader reader(document, "", faults);
    describe(reader, job);
    reader.finish();

    if (!faults.empty()) throw JobFaults(name, faults);
    return job;
}

}  // namespace peterka::job
