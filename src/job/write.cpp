#include "job/write.hpp"

#include "job/schema.hpp"
#include "job/table_writer.hpp"

namespace peterka::job {
namespace {

std::string written(Job job, Style style, const Origins* origins = nullptr) {
    std::string text;
    TableWriter writer(text, style, origins);
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
        for (const auto* taken :
             {"hammer", "cart", "contact", "operating_point", "start", "solver", "steady_state"}) {
            if (table == taken) origins[key] = map_file;
        }
    }
}

std::string identity_text(const Job& job) {
    return written(job, Style::for_identity);
}

}  // namespace peterka::job
