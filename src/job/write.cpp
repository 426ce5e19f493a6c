#include "job/write.hpp"

#include "job/schema.hpp"
#include "job/table_writer.hpp"

namespace peterka::job {
namespace {

std::string written(Job job, Style style, const Origins* origins = nullptr) {
    std::string text;
    const Job original = job;
    TableWriter writer(text, style, origins == nullptr ? nullptr : &original, origins);
    describe(writer, job);
    return text;
}

}  // namespace

std::string resolved_text(const Job& job) {
    return written(job, Style::for_people);
}

std::string resolved_text(const Job& job, const Origins& origins) {
    return written(job, Style::for_people, &origins);
}

void take_from(const std::string& map_file, const Job& job, Origins& origins) {
    for (const auto& [key, origin] : origins_of(parse_document(resolved_text(job), map_file), {map_file})) {
        const std::string_view table = std::string_view(key).substr(0, key.find('.'));
        const bool is_rig = table == "hammer" || table == "cart" || table == "contact";
        const bool is_setting = table == "start" || table == "solver" || table == "steady_state";
        if (is_rig || table == "operating_point" || (is_setting && job.kind == Kind::trace)) {
            origins[key] = map_file;
        }
    }
}

std::string identity_text(const Job& job) {
    return written(job, Style::for_identity);
}

}  // namespace peterka::job
