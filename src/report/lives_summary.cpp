#include "report/summary_parts.hpp"

#include <fmt/format.h>

#include "job/branches.hpp"
#include "report/axis_words.hpp"
#include "support/readable.hpp"

namespace peterka {

std::string lives_summary(const scene::Scene& scene, const findings::LifeFindings& all) {
    if (!scene.job().noise.any()) return "";
    const bool has_starts = scene.job().starts.count > 0;
    // the branches of a gap store the same attractors
    const std::int64_t times =
        has_starts && scene.job().kind == job::Kind::sweep ? job::branches_of_a_gap(scene.job().sweep) : 1;
    const std::int64_t others = all.others / times;
    const std::int64_t motions = all.motions / times;
    const std::int64_t ending = all.ending / times;
    const std::string head = "\nHow long settled motions last under [noise]\n";
    std::string text = head;
    if (others > 0) {
        text += fmt::format(
            "  {} {} not followed: the engine could not, the noise is far too strong, or {} more than {:.0f} "
            "forcing cycles to relax, a "
            "twentieth of noise.cycles\n",
            readable_count(others), others == 1 ? "settled motion was" : "settled motions were",
            others == 1 ? "it takes" : "they take", scene.job().noise.most_to_relax());
    }
    if (motions == 0) return text + (others == 0 ? "  there is no settled motion\n" : "");
    text += fmt::format("  {} {} followed\n", readable_count(motions),
                        (has_starts ? "attractor" : "motion") + std::string(motions == 1 ? "" : "s"));
    if (ending > 0) {
        text +=
            fmt::format("  {:>9} of these: seen to end; the shortest mean life is {:.3g} +- {:.1g} s, at {}\n",
                        readable_share(ending, motions), all.shortest, all.error,
                        place_in_words(scene, all.row, all.column));
    }
    if (ending < motions) {
        text += fmt::format(
            "  {:>9} of these: fewer than 4 lives seen to end; each lasts {:.2g} s or longer, roughly\n",
            readable_share(motions - ending, motions), all.least_bound);
    }
    return text;
}

}  // namespace peterka
