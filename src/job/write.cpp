#include "job/write.hpp"

#include "job/schema.hpp"
#include "job/table_writer.hpp"

namespace peterka::job {
namespace {

std::string written(Job job, Style style) {
    std::string text;
    TableWriter writer(text, style);
    describe(writer, job);
    return text;
}

}  // namespace

std::string resolved_text(const Job& job) {
    return written(job, Style::for_people);
}

std::string identity_text(const Job& job) {
    return written(job, Style::for_identity);
}

}  // namespace peterka::job
