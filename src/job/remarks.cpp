#include "job/remarks.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>

#include <fmt/format.h>

#include "job/axis_key.hpp"
#include "job/cell_numbers.hpp"
#include "job/doubtful_numbers.hpp"
#include "job/settle.hpp"
#include "job/twins.hpp"

namespace peterka::job {
namespace {

// Where the job's own numbers are not those that were identified with their covariance. What an axis varies, or
// where each cell lies, is not compared.
void add_other_means(const Job& job, std::vector<std::string>& texts) {
    constexpr double rounding = 1e-6;
    const Covariance& covariance = job.uncertainty.covariance;
    for (std::size_t i = 0; i < std::min(covariance.of.size(), covariance.mean.size()); ++i) {
        const std::string_view key = axis_key_of(covariance.of[i]);
        const bool is_axis = says_the_same(key, column_key(job)) ||
                             (job.kind != Kind::sweep && says_the_same(key, row_key(job)));
        const bool is_in_list = is_gap(key) && !job.sweep.gaps().empty();
        if (is_axis || is_in_list) continue;
        const double own = number_of(numbers_in(job), key);
        const double mean = covariance.mean[i];
        if (std::abs(own - mean) <= rounding * std::max(std::abs(own), std::abs(mean))) continue;
        texts.push_back(
            fmt::format("{} is {:.6g} in the job, and {:.6g} where its uncertainty was identified: rigs are "
                        "drawn around {:.6g}",
                        covariance.of[i], own, mean, own));
    }
}

void add_no_rigs(const Job& job, std::vector<std::string>& texts) {
    const Uncertainty& uncertainty = job.uncertainty;
    if (uncertainty.rigs > 0 || (uncertainty.numbers.empty() && uncertainty.covariance.of.empty())) return;
    texts.emplace_back("[uncertainty] names numbers and draws no rigs: set uncertainty.rigs, such as 64");
}

}  // namespace

std::vector<std::string> remarks(const Job& job) {
    std::vector<std::string> texts;
    if (!has_rig(job) || job.kind == Kind::study) return texts;
    add_doubtful_rig(job, texts);
    add_doubtful_place(job, texts);
    add_doubtful_spreads(job, texts);
    add_no_rigs(job, texts);
    if (job.uncertainty.rigs > 0) add_other_means(job, texts);
    return texts;
}

}  // namespace peterka::job
