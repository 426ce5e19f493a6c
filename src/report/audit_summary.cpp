#include "report/summary_parts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <string_view>
#include <vector>

#include "regime/cell_result.hpp"
#include "support/readable.hpp"

namespace peterka {
namespace {

// Why labels differ.
std::string differing(const map_file::AuditReport& audit) {
    const std::int64_t all = audit.cells - audit.agreeing;
    if (all == 0) return "";
    const std::int64_t filled = audit.filled - audit.agreeing_filled;
    const std::int64_t others = all - filled - audit.decided_by_rounding;
    std::vector<std::string> parts;
    if (filled > 0) {
        const std::string what =
            filled < all ? readable_count(filled) + " in cells" : (all == 1 ? "in a cell" : "all in cells");
        parts.push_back(what + " filled from those around");
    }
    if (audit.decided_by_rounding > 0) {
        const std::string each = all == 1 ? "it" : "each";
        parts.push_back(fmt::format(
            "in {} a perturbation grew by e^{:g} or more (sensitivity), so rounding decides the label",
            audit.decided_by_rounding == all ? each : readable_count(audit.decided_by_rounding),
            regime::rounding_decides));
    }
    if (others > 0) {
        parts.push_back(
            fmt::format("{} for another reason; /audit in the file has the cells", readable_count(others)));
    }
    const std::string text =
        fmt::format("  other label         {}: {}", readable_count(all), fmt::join(parts, "; "));
    return text + "\n";
}

// Where some starts or drawn rigs of the audited cells end, by an integrator.
std::string audited_tries(std::string_view name, const map_file::AuditReport::Tries& tries,
                          std::string_view end) {
    if (tries.solved == 0) return "";
    const std::int64_t same = tries.solved - tries.elsewhere;
    std::string text = fmt::format("  {:<19} {} of {} ({}) {} that the map says", name, readable_count(same),
                                   readable_count(tries.solved), readable_share(same, tries.solved), end);
    if (tries.elsewhere > 0) {
        text += fmt::format("; in {} of the other {} rounding decides",
                            readable_count(tries.decided_by_rounding), readable_count(tries.elsewhere));
    }
    return text + "\n";
}

}  // namespace

std::string audit_summary(const map_file::AuditReport& audit, double seconds_per_cell) {
    std::string text = fmt::format(
        "\nAudit: {} cells, half of them where claims are weakest, solved again with every term by an "
        "integrator\n"
        "  same regime and z   {} of {} ({})\n",
        readable_count(audit.cells), readable_count(audit.agreeing), readable_count(audit.cells),
        readable_share(audit.agreeing, audit.cells));
    if (audit.filled > 0) {
        const std::int64_t computed = audit.cells - audit.filled;
        text += fmt::format(
            "  of these            {} of {} computed cells, {} of {} filled from the cells around ({})\n",
            readable_count(audit.agreeing - audit.agreeing_filled), readable_count(computed),
            readable_count(audit.agreeing_filled), readable_count(audit.filled),
            readable_share(audit.agreeing_filled, audit.filled));
    }
    text += differing(audit);
    if (audit.compared > 0) {
        text += fmt::format(
            "  peak force          off by {:.1e} (median), {:.1e} (99 %), {:.1e} (largest) in {} {}cells\n",
            audit.median_force_error, audit.force_error_99_percent, audit.largest_force_error,
            readable_count(audit.compared), audit.filled > 0 ? "computed " : "");
    }
    if (audit.compared_filled > 0) {
        text += fmt::format(
            "  interpolated forces off by {:.1e} (median), {:.1e} (largest) in {} filled cells\n",
            audit.median_filled_error, audit.largest_filled_error, readable_count(audit.compared_filled));
    }
    text += audited_tries("starts", audit.starts, "end on the attractor");
    text += audited_tries("rigs", audit.rigs, "have the outcome");
    return text + fmt::format("  time per cell       {} by the integrator, {} in the map\n",
                              readable_duration(audit.seconds_per_cell), readable_duration(seconds_per_cell));
}

}  // namespace peterka
