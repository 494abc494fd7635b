// Step patterns, from how they are written to R's notation, and to the steps of a recurrence.
#include "curvewise/step_pattern.hpp"

#include <iterator>
#include <stdexcept>
#include <string>

namespace curvewise {
namespace {

constexpr const char* types_of_rabiner_juang[] = {
    "10 11 01",
    "1110 11 1101",
    "21 11 12",
    "1110 1210 11 12",
    "111010 1110 11 1101 110101",
    "111110 11 111101",
    "111010 121010 131010 1110 1210 1310 11 12 13",
};

}  // namespace

StepRows step_rows(const StepSet& pattern) {
    StepRows result;
    result.per = pattern.per;
    if (pattern.weights == nullptr && pattern.weight == SlopeWeight::sum) result.per = Per::both;
    if (pattern.weights == nullptr && pattern.weight == SlopeWeight::rows) result.per = Per::rows;
    const ParsedSteps found = parsed(pattern);
    result.rows.assign(found.rows, found.rows + found.count);
    return result;
}

bool StepRows::has_negative_weight() const noexcept {
    for (std::size_t i = 1; i < rows.size(); ++i) {
        if (rows[i].step == rows[i - 1].step && rows[i].weight < 0.0) return true;
    }
    return false;
}

StepRows rabiner_juang(int type, SlopeWeight weight, bool smoothed) {
    if (type < 1 || type > static_cast<int>(std::size(types_of_rabiner_juang))) {
        throw std::invalid_argument("type is " + std::to_string(type) +
                                    "; Rabiner and Juang have types 1 to 7");
    }
    return step_rows({"", types_of_rabiner_juang[type - 1], weight, smoothed});
}

std::vector<Step> steps_of(const StepRows& pattern) {
    std::vector<Step> steps;
    int current = 0;
    for (const StepRow& row : pattern.rows) {
        if (steps.empty() || row.step != current) {
            if (row.weight != -1.0) {
                throw std::invalid_argument("step " + std::to_string(row.step) +
                                            " of the pattern begins with the weight " +
                                            std::to_string(row.weight) +
                                            "; its first row has -1, and says where it begins");
            }
            current = row.step;
            steps.push_back({row.rows, row.columns, 0.0, {}});
            continue;
        }
        steps.back().terms.push_back({row.rows, row.columns, row.weight});
    }
    return steps;
}

}  // namespace curvewise
