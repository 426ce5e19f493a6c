#include "job/nearest.hpp"

#include <algorithm>
#include <numeric>

namespace peterka::job {
namespace {

constexpr std::size_t shortest_telling_part = 3;  // "gap" for gap_ratio is telling, "g" is not

bool one_contains_the_other(std::string_view a, std::string_view b) {
    if (std::min(a.size(), b.size()) < shortest_telling_part) return false;
    return a.find(b) != std::string_view::npos || b.find(a) != std::string_view::npos;
}

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
        }
    }
    return row[b.size()];
}

std::string_view nearest(std::string_view word, const std::vector<std::string_view>& known) {
    std::string_view best;
    std::size_t best_distance = std::max<std::size_t>(2, word.size() / 3) + 1;
    for (const std::string_view candidate : known) {
        // A part of a name counts as one mistake, so that it loses only to a single typo.
        const std::size_t distance =
            one_contains_the_other(word, candidate) ? 1 : edit_distance(word, candidate);
        // A word all of whose letters must change is another word.
        if (distance < best_distance && distance < candidate.size()) {
            best = candidate;
            best_distance = distance;
        }
    }
    return best;
}

}  // namespace peterka::job
