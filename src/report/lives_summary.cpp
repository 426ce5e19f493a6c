#include "report/summary_parts.hpp"

#include <fmt/format.h>

#include "report/axis_words.hpp"
#include "support/readable.hpp"

namespace peterka {

std::string lives_summary(const scene::Scene& scene, const findings::LifeFindings& lives) {
    if (!scene.job().noise.any()) return "";
    const bool has_starts = scene.job().starts.count > 0;
    const std::string head = "\nHow long settled motions last under [noise]\n";
    std::string text = head;
    if (lives.others > 0) {
        text += fmt::format(
            "  {} {} not followed: the engine could not, the noise is far too strong, or {} more than {:.0f} "
            "forcing cycles to relax, a "
            "twentieth of noise.cycles\n",
            readable_count(lives.others), lives.others == 1 ? "settled motion was" : "settled motions were",
            lives.others == 1 ? "it takes" : "they take", scene.job().noise.most_to_relax());
    }
    if (lives.motions == 0) return text + (lives.others == 0 ? "  there is no settled motion\n" : "");
    text += fmt::format("  {} {} followed\n", readable_count(lives.motions),
                        (has_starts ? "attractor" : "motion") + std::string(lives.motions == 1 ? "" : "s"));
    if (lives.ending > 0) {
        text +=
            fmt::format("  {:>9} of these: seen to end; the shortest mean life is {:.3g} +- {:.1g} s, at {}\n",
                        readable_share(lives.ending, lives.motions), lives.shortest, lives.error,
                        place_in_words(scene, lives.row, lives.column));
    }
    if (lives.ending < lives.motions) {
        text += fmt::format("  {:>9} of these: none was seen to end; each lasts {:.2g} s or longer, roughly\n",
                            readable_share(lives.motions - lives.ending, lives.motions), lives.least_bound);
    }
    return text;
}

}  // namespace peterka
